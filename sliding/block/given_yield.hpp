#pragma once

#include "sliding/block/slip_stage.hpp"

#include <vector>

/// A block whose yield acceleration is known, without the section that it would follow from.
namespace damslip::sliding {

/// Yield acceleration once the block has slipped a path.
struct YieldPoint {
    double path = 0.0;  ///< sum of |slip| in both directions [m]
    double yield = 0.0; ///< [m/s^2], >= 0
};

/// Stages of a block on a horizontal base, without water, whose yield is `points.front().yield` at rest, follows the straight
/// lines between the points and stays at the last: a block of 1 kg/m under a gravity of 1 m/s^2, whose friction is the
/// yield. Both ways alike; SlidingOptions::two_way says whether it slides upstream.
/// @param points  the first at path 0, paths ascending; two at one path: a jump
/// @throws InputError for no points, a first path other than 0, paths that fall, yields below 0 or not finite
SlipStages stages_of_yield(const std::vector<YieldPoint>& points);

} // namespace damslip::sliding
