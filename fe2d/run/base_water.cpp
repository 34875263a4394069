#include "fe2d/run/base_water.hpp"

#include "core/input_error.hpp"
#include "fe2d/run/contact_structure.hpp"
#include "scene/section.hpp"
#include "scene/water.hpp"

#include <algorithm>
#include <cmath>

namespace damslip::fe2d {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

Index nearest_pair(const VectorXd& distance, double at)
{
    Index pair = 0;
    (distance.array() - at).abs().minCoeff(&pair);
    return pair;
}

} // namespace

std::unique_ptr<CrackWater> base_water(const Scene& scene, const Plane& base, const PressureProfile& uplift,
                                       const CrackedUplift& cracked, const std::optional<DrainLoss>& drain_loss)
{
    if (!scene.uplift || uplift.empty()) return nullptr;
    const JointWaterLaw& law = scene.uplift->water;
    if (base.share != 1.0 && law.opening != OpeningWater::unchanged)
        throw InputError(Diagnostic{scene.file.string(), 0, 0,
                                    "section.thickness leaves the base a part of its width, with uplift.opening.",
                                    "opening = \"unchanged\" by finite elements on such a base, or a base of share 1",
                                    "write  opening = \"unchanged\" , or give the dam a foot of share 1"});
    const double weight = water_unit_weight(scene);
    const auto under = [&](const auto& level, const Point& end) {
        return level ? std::max(0.0, weight * (level->level - end.y)) : 0.0;
    };
    auto joint = std::make_shared<WetJoint>();
    joint->distance = base.distance;
    joint->area = base.area;
    joint->before = uplift;
    joint->upstream_pressure = under(scene.reservoir, heel(scene.section));
    joint->downstream_pressure = under(scene.tailwater, toe(scene.section));
    joint->fall = std::sin(base_inclination(scene.section));
    joint->cracked = cracked;
    joint->drain_loss = drain_loss;
    if (scene.drains) joint->drain = nearest_pair(base.distance, scene.drains->distance);
    joint->fluid = {law.viscosity, scene.reservoir ? scene.reservoir->bulk_modulus : Reservoir().bulk_modulus,
                    water_density(scene), weight, law.cavitation};
    return make_joint_water(law, std::move(joint));
}

HeelWaves::HeelWaves(const Scene& scene, const ContactStructure& structure, const WaterBody* water,
                     const std::function<double(Point, double)>& added_mass)
{
    const NodeOrder& order = structure.order();
    if (water) {
        const ReservoirMesh& mesh = water->water.reservoir;
        const int node = mesh.face.front();
        const Index place = water->place[static_cast<std::size_t>(water->water.dofs(node))];
        potential_ = 2 * order.new_node[static_cast<std::size_t>(place / 2)] + place % 2;
        scale_ = water->scale;
        return;
    }
    if (!added_mass || !scene.reservoir) return;
    const Polyline face = upstream_face(scene.section);
    const double angle = std::atan2(face[1].x - face[0].x, face[1].y - face[0].y);
    mass_ = added_mass(face[0], angle);
    into_water_ = {-std::cos(angle), std::sin(angle)};
    heel_ = 2 * order.new_node[static_cast<std::size_t>(structure.model().mesh.contact.dam_nodes.front())];
}

/// Acoustic: p = s φ̇. Added mass: its inertia against the total acceleration along the face's normal.
double HeelWaves::pressure(const DynamicState& state) const
{
    if (potential_ >= 0) return scale_ * state.v[potential_];
    if (heel_ < 0) return 0.0;
    const Eigen::Vector2d total(state.a[heel_] - state.ground.h, state.a[heel_ + 1] + state.ground.v);
    return mass_ * into_water_.dot(total);
}

} // namespace damslip::fe2d
