#include "scene/joint_bond.hpp"

#include <algorithm>
#include <cmath>

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
        length = characteristic_length(modulus, *bond.tension_energy, bond.tensile_strength) / 4.0;
    if (strength.cohesion > 0.0 && bond.shear_energy)
        length = std::min(length, characteristic_length(modulus, *bond.shear_energy, strength.cohesion) / 4.0);
    return length;
}

CarriedBond carried_bond(const Contact& strength, double modulus, double element_length)
{
    const Bond& bond = strength.bond;
    CarriedBond carried{bond.tensile_strength, strength.cohesion, false};
    const auto lower = [&](double& stress, const std::optional<double>& energy) {
        if (!(stress > 0.0) || !energy) return;
        const double most = std::sqrt(modulus * *energy / (4.0 * element_length));
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

} // namespace damslip
