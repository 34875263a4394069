#pragma once

#include "fe2d/run/stages.hpp"
#include "fe2d/run/step_parts.hpp"

namespace damslip::fe2d {

/// A dam that has lost its equilibrium moves under its constant load, with its true mass, stiffness damping b_K and the
/// laws of its joints, until it has not slid for several of its periods or slides away (dynamic relaxation, JOINTS 1).
/// Mass damping is left out: it would hold a sliding dam back.
/// @param structure  of the static stages; kept by reference
/// @param damping  of the run; at least 5 % in a mode of `period`, so that the dam does come to rest
/// @param radiating  the rock of the motion, kept by reference; null: rigid base or massless rock
/// @param period  about that of the dam's first mode [s]
Relaxation relaxation_of(const ContactStructure& structure, const RunDamping& damping, const Scheme& scheme,
                const ReducedRock* radiating, const Contact& joint, const ContactOptions& options, double period);

/// Of a dam, about: 381 s √(N/m²)/m H/√E (Fenves & Chopra 1987, 1.4 H/√E in ft and psi). @param height  [m]
/// @param young_modulus  [Pa] @returns [s]
double first_period(double height, double young_modulus);

} // namespace damslip::fe2d
