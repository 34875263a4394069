#pragma once

#include "sliding/block/skipping_motion.hpp"

#include <optional>

namespace damslip::sliding {

/// Constant yield acceleration a_y [m/s^2] under which a block on a horizontal base that slides one way, downstream, slips
/// exactly `slip`. Over standard gravity it is the seismic coefficient for that allowable slip, k(d*).
///
/// D falls with a_y and is continuous: v(t) = max over s of the integral of a - a_y from s to t. So the root is the only one;
/// it is found to 1e-12 of the largest acceleration. slip = 0: the largest acceleration downstream.
/// @param slip      [m], >= 0
/// @param polarity  +1 or -1: multiplies a_h [-]
/// @returns nothing where even a_y -> 0 slips less, run-out of 60 s included
std::optional<double> yield_for_slip(const SkippingMotion& motion, double slip, int polarity = 1);

} // namespace damslip::sliding
