#include "scene/joint_bond.hpp"

#include "scene/uplift_models.hpp"
#include "scene/water.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace damslip {

namespace {

std::optional<double> plane_strain_modulus(const Material& m)
{
    if (!m.young_modulus) return std::nullopt;
    return *m.young_modulus / (1.0 - m.poisson_ratio * m.poisson_ratio);
}

} // namespace

BondLoss bond_loss(const Contact& strength)
{
    const Bond& bond = strength.bond;
    const bool energy = bond.shear_energy || bond.tension_energy;
    return bond.loss.value_or(energy ? BondLoss::fracture : BondLoss::together);
}

bool breaks_by_energy(const Contact& strength)
{
    return bond_loss(strength) == BondLoss::fracture &&
           (strength.cohesion > 0.0 || strength.bond.tensile_strength > 0.0);
}

double characteristic_length(double modulus, double energy, double strength)
{
    return modulus * energy / (strength * strength);
}

double bond_element_length(const Contact& strength, double modulus)
{
    double length = HUGE_VAL;
    const Bond& bond = strength.bond;
    if (bond.tensile_strength > 0.0 && bond.tension_energy)
        length = characteristic_length(modulus, *bond.tension_energy, bond.tensile_strength) / (4.0 * bond.dynamic_increase);
    if (strength.cohesion > 0.0 && bond.shear_energy)
        length = std::min(length, characteristic_length(modulus, *bond.shear_energy, strength.cohesion) /
                                      (4.0 * bond.dynamic_increase));
    return length;
}

CarriedBond carried_bond(const Contact& strength, double modulus, double element_length)
{
    const Bond& bond = strength.bond;
    CarriedBond carried{bond.tensile_strength, strength.cohesion, false};
    const auto lower = [&](double& stress, const std::optional<double>& energy) {
        if (!(stress > 0.0) || !energy) return;
        const double most = std::sqrt(modulus * *energy / (4.0 * bond.dynamic_increase * element_length));
        if (stress <= most * (1.0 + 1e-9)) return;
        stress = most;
        carried.lowered = true;
    };
    lower(carried.tensile_strength, bond.tension_energy);
    lower(carried.cohesion, bond.shear_energy);
    return carried;
}

std::optional<double> joint_modulus(const Scene& scene, bool base)
{
    const auto dam = plane_strain_modulus(scene.dam);
    if (!dam || !base || !scene.foundation) return dam;
    const auto rock = plane_strain_modulus(scene.foundation->material);
    return rock ? std::optional(2.0 / (1.0 / *dam + 1.0 / *rock)) : dam;
}

const std::vector<std::pair<std::string, OpeningWater>>& opening_waters()
{
    static const std::vector<std::pair<std::string, OpeningWater>> words{{"unchanged", OpeningWater::unchanged},
                                                                         {"zero", OpeningWater::zero},
                                                                         {"full", OpeningWater::full},
                                                                         {"mouth", OpeningWater::mouth},
                                                                         {"reynolds", OpeningWater::reynolds}};
    return words;
}

const std::string& word(OpeningWater rule)
{
    return std::find_if(opening_waters().begin(), opening_waters().end(),
                        [rule](const auto& entry) { return entry.second == rule; })
        ->first;
}

bool drains_shear_off(const Scene& scene)
{
    if (!scene.uplift || !scene.drains || !scene.drains->lost_at_slip) return false;
    return reads_drains(scene.uplift->model);
}

bool base_water_changes(const Scene& scene)
{
    return (scene.uplift && scene.uplift->water.follows()) || drains_shear_off(scene);
}

std::string first_joint_law(const Scene& s)
{
    if (breaks_by_energy(s.contact)) return "contact.bond = \"fracture\"";
    for (std::size_t i = 0; i < s.lift_joints.size(); ++i)
        if (breaks_by_energy(s.lift_joints[i].strength))
            return fmt::format("lift_joint[{}].bond = \"fracture\"", i + 1);
    if (s.contact.rate.active()) return "contact.kinetic_friction_ratio";
    for (std::size_t i = 0; i < s.lift_joints.size(); ++i)
        if (s.lift_joints[i].strength.rate.active()) return fmt::format("lift_joint[{}].kinetic_friction_ratio", i + 1);
    if (!s.anchors.empty()) return "[[anchor]]";
    if (s.uplift && s.uplift->water.follows())
        return s.uplift->water.opening != OpeningWater::unchanged ? "uplift.opening" : "uplift.after";
    if (drains_shear_off(s)) return "drains.lost_at_slip_m";
    return {};
}

std::optional<Scene> with_exact_contact(const Scene& scene)
{
    if (scene.contact.enforcement == ContactEnforcement::exact && scene.contact.normal == NormalContact::hard)
        return std::nullopt;
    Scene exact = scene;
    exact.contact.normal = NormalContact::hard;
    exact.contact.enforcement = ContactEnforcement::exact;
    exact.contact.tangential_stiffness.reset();
    return exact;
}

FrictionOverSlip::FrictionOverSlip(const Contact& contact)
    : points_(contact.friction_table), path_(contact.residual_path),
      constant_(contact.friction_table.empty() && !contact.residual_friction)
{
    if (!points_.empty()) return;
    points_.push_back({0.0, contact.friction});
    if (contact.residual_friction) points_.push_back({contact.residual_slip, *contact.residual_friction});
}

double FrictionOverSlip::at(double slip) const
{
    if (slip <= points_.front().x) return points_.front().y;
    for (std::size_t k = 0; k + 1 < points_.size(); ++k) {
        const Point &a = points_[k], &b = points_[k + 1];
        if (slip >= b.x) continue;
        return path_ == Interpolation::steps ? a.y : a.y + (slip - a.x) / (b.x - a.x) * (b.y - a.y);
    }
    return points_.back().y;
}

std::vector<FrictionOverSlip::Piece> FrictionOverSlip::pieces() const
{
    std::vector<Piece> pieces;
    for (std::size_t i = 0; i < points_.size(); ++i) {
        Piece piece{i == 0 ? 0.0 : points_[i].x, points_[i].y, 0.0};
        const bool last = i + 1 == points_.size();
        if (path_ == Interpolation::linear && !last && points_[i + 1].x > points_[i].x)
            piece.slope = (points_[i + 1].y - points_[i].y) / (points_[i + 1].x - points_[i].x);
        pieces.push_back(piece);
    }
    return pieces;
}

} // namespace damslip
