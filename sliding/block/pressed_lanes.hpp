#pragma once

#include "sliding/block/pressed_slip.hpp"

#include <array>

/// Four blocks of one motion side by side, for sweeps: the samples are gone through once for all four.
namespace damslip::sliding {

inline constexpr std::size_t pressed_lanes = 4;

using FourPressed = std::array<PressedSlip<false>, pressed_lanes>;

/// True where the processor has lanes.
bool has_pressed_lanes();

/// PressedSlip::run() over a whole motion of four blocks that slide downstream only and rest at its begin, with the same
/// bits. What happens within an interval, a start or a stop, is left to the block's own cross().
/// @param motion  that of the blocks; horizontal
/// @pre has_pressed_lanes() @returns false where one of them is not resolved: none of the four is to be used
bool run_in_lanes(const SkippingMotion& motion, FourPressed& blocks);

} // namespace damslip::sliding
