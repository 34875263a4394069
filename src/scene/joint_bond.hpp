#pragma once

#include "scene/scene.hpp"

namespace damslip {

/// How a joint loses its cohesion: as the scene says, else by fracture energy where it has one, else all together.
BondLoss bond_loss(const Contact& strength);
/// Has the joint a bond whose fracture takes work? (FE)
bool breaks_by_energy(const Contact& strength);

/// Characteristic length ℓ_ch = E' G/f² of a bond between two bodies [m]: the process zone at a crack's tip is about
/// 0.9 ℓ_ch long (Bažant & Oh 1983).
/// @param modulus  harmonic mean of E/(1 - nu²) of both sides [Pa] @param energy  [N/m] @param strength  [Pa], > 0
double characteristic_length(double modulus, double energy, double strength);

/// Longest element on a bonded joint: ℓ_ch/4 of its more brittle mode [m].
double bond_element_length(const Contact& strength, double modulus);

/// Strengths that elements of some length can carry: f and c, at most √(E' G/(4h)) with the energies kept (Bažant & Oh 1983).
struct CarriedBond {
    double tensile_strength = 0.0; ///< [Pa]
    double cohesion = 0.0;         ///< [Pa]
    bool lowered = false;
};
CarriedBond carried_bond(const Contact& strength, double modulus, double element_length);

/// E' of the joint: harmonic mean of both sides' E/(1 - nu²); a rigid side counts as the other [Pa]. None: no modulus known.
std::optional<double> joint_modulus(const Scene& scene, bool base);

} // namespace damslip
