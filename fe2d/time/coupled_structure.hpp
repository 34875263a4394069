#pragma once

#include "fe2d/fluid/coupled_modes.hpp"
#include "fe2d/time/structure_system.hpp"

namespace damslip::fe2d {

/// Undamped dam on its tied base and water for real modes: the far end closed, the bottom rigid and still, the surface p = 0 (sloshing modes
/// lie far below the dam's). The modes of water that radiates are complex; real modes ignore that.
CoupledPencil coupled_pencil(const Model& model, const FluidModel& water);

/// Frequencies [rad/s] and horizontal effective masses of the `count` leading modes (leading_modes), lowest first.
std::vector<ModalMass> leading_modal_masses(const CoupledModes& modes, int count);

/// Damping of a scene with acoustic water. "Mode n" of damping.rayleigh_modes is the n-th of the leading modes: modes of the water alone
/// would shift the count with the length of the reservoir.
DampingChoice damping_of(const Scene& scene, const Model& model, const FluidModel& water, const GroundMotion& motion);

} // namespace damslip::fe2d
