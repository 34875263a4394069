#include "fe2d/run/stages.hpp"

#include "fe2d/model/lift_water.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace damslip::fe2d {

using Eigen::Index;
using Eigen::VectorXd;

BaseResultant base_resultant(const ContactStructure& structure, const VectorXd& ordered_load)
{
    const Mesh& mesh = structure.model().mesh;
    const VectorXd dam_load = structure.order().to_old(ordered_load);
    const Plane& plane = structure.plane();
    const Point heel = mesh.nodes[mesh.contact.dam_nodes.front()];
    Eigen::Vector2d force = Eigen::Vector2d::Zero();
    double moment = 0.0; // about the heel, counter-clockwise
    for (int node = 0; node < mesh.dam_node_count; ++node) {
        const double fx = dam_load[2 * node], fy = dam_load[2 * node + 1];
        force += Eigen::Vector2d(fx, fy);
        moment += (mesh.nodes[node].x - heel.x) * fy - (mesh.nodes[node].y - heel.y) * fx;
    }
    // N' acts upwards on the dam at `position` and balances the moment of the loads: position N' = -moment.
    const double normal = -plane.normal.dot(force);
    return {normal, plane.tangent.dot(force), normal != 0.0 ? -moment / normal : 0.0};
}

LoadStages load_stages(const Scene& scene, const Model& model, const Polyline& uplift)
{
    const StaticLoads loads = static_loads(scene, model);
    LoadStages stages;
    VectorXd sum = sum_of(loads.gravity, model.dofs.count);
    stages.names.push_back("gravity");
    stages.loads.push_back(sum);
    if (!loads.impounding.empty()) {
        sum += sum_of(loads.impounding, model.dofs.count);
        stages.names.push_back("water");
        stages.loads.push_back(sum);
    }
    const VectorXd in_joints = lift_water(scene, model);
    if (!uplift.empty() || in_joints.size() > 0) {
        sum += uplift_load(model.mesh, model.dofs, uplift, ContactSide::dam);
        sum += uplift_load(model.mesh, model.dofs, uplift, ContactSide::rock);
        if (in_joints.size() > 0) sum += in_joints;
        stages.names.push_back("uplift");
        stages.loads.push_back(sum);
    }
    return stages;
}

void let_water_ride(const ContactStructure& structure, const Polyline& uplift, SplitLoad& load)
{
    if (!structure.slides_far() || uplift.empty()) return;
    const Model& model = structure.model();
    const VectorXd on_dam = uplift_load(model.mesh, model.dofs, uplift, ContactSide::dam);
    const VectorXd on_rock = uplift_load(model.mesh, model.dofs, uplift, ContactSide::rock);
    const VectorXd dam = structure.order().to_new(VectorXd(on_dam.head(structure.dam_unknowns())));
    load.joint = -structure.plane().to_plane(VectorXd(dam.tail(2 * structure.plane().pairs())));
    load.rock -= structure.split(on_rock).rock;
}

namespace {

StageStatus judge(const BaseResultant& r, double resistance, double length)
{
    if (!(r.normal_force > 0.0)) return StageStatus::floats;
    if (std::abs(r.shear_force) > resistance) return StageStatus::slides;
    if (r.position < 0.0 || r.position > length) return StageStatus::overturns;
    return StageStatus::ok;
}

/// Strength of the whole base: cohesion on all of it, the weakest friction.
double whole_friction(const ContactLaw& law)
{
    return law.friction.minCoeff();
}

} // namespace

StageResult solve_stage(StaticContact& statics, const ContactStructure& structure, const std::string& name,
                        const SplitLoad& load, Strength& strength, ContactMemory& memory)
{
    const Plane& plane = structure.plane();
    const ContactLaw& law = strength.law();
    StageResult result;
    result.name = name;
    result.resultant = base_resultant(structure, load.dam);
    const double normal = result.resultant.normal_force, shear = std::abs(result.resultant.shear_force);
    const double cohesion = law.cohesion.sum(), resistance = whole_friction(law) * normal + cohesion;
    result.friction_needed = std::max(0.0, shear - cohesion) / normal;
    // A balance of the loads on the dam alone: round-off of sums of order N' is not a shear force.
    result.sliding_factor =
        shear > 1e-12 * std::abs(normal) ? resistance / shear : std::numeric_limits<double>::infinity();
    result.status = judge(result.resultant, resistance, plane.length());
    if (result.status != StageStatus::ok) return result;

    ContactMemory trial = memory;
    result.contact = statics.solve(load, law, trial);
    if (!result.contact.resolved()) {
        result.status = StageStatus::not_resolved;
        return result;
    }
    memory = std::move(trial);
    strength.follow(memory);
    result.slip = plane.weights().dot(memory.slip);
    for (Index i = 0; i < plane.pairs(); ++i) {
        const ContactState state = memory.states[static_cast<std::size_t>(i)];
        if (state == ContactState::open) result.open_length += plane.area[i];
        if (is_slip(state)) result.slipping_length += plane.area[i];
    }
    return result;
}

std::string StageResult::text() const
{
    const std::string forces =
        fmt::format("N' = {:.5g} MN/m, T = {:.5g} MN/m", 1e-6 * resultant.normal_force, 1e-6 * resultant.shear_force);
    switch (status) {
    case StageStatus::ok:
        return fmt::format("{}: in equilibrium, {}, mean slip {:.3g} mm, open length {:.3g} m, mu needed {:.5f}.", name,
                           forces, 1e3 * slip, open_length, friction_needed);
    case StageStatus::slides:
        return fmt::format("{}: the dam slides without any earthquake, {}: it holds with mu >= {:.5f}.", name, forces,
                           friction_needed);
    case StageStatus::floats:
        return fmt::format("{}: the dam floats, {}: uplift exceeds all weight.", name, forces);
    case StageStatus::overturns:
        return fmt::format("{}: the dam overturns, {}: the resultant acts {:.5g} m from the heel, outside the base.",
                           name, forces, resultant.position);
    case StageStatus::not_resolved:
        return fmt::format("{}: no contact state in equilibrium found, {}, mu needed {:.5f}, {} iterations.", name,
                           forces, friction_needed, contact.iterations);
    }
    return {};
}

} // namespace damslip::fe2d
