#pragma once

#include "fe2d/rock/reduced_rock.hpp"
#include "fe2d/time/moving_base.hpp"
#include "fe2d/time/scheme.hpp"

#include <memory>

namespace damslip::fe2d {

/// Reduced rock that a dam is tied to (RockMotion), at rest.
/// @param rock  kept by reference; rows (x, y) by node
/// @param stiffness_damping  b_K >= 0 [s]
std::unique_ptr<MovingBase> rock_base(const ReducedRock& rock, const StepConstants& constants,
                                      double stiffness_damping);

} // namespace damslip::fe2d
