#pragma once

#include "records/record.hpp"

#include <vector>

namespace damslip::records {

/// Several motions as the events of one, on one grid: steps that share a common part (dt_1/m = dt_2/n with m, n <= 16) are
/// subdivided to it, which changes nothing; else all are interpolated at the finest step, and `notes` says so. A motion
/// without a vertical component beside one with it gets zeros.
/// @param motions  two at least for a sequence  @param pause  at rest between two of them [s]
GroundMotion one_after_the_other(const std::vector<GroundMotion>& motions, double pause);

/// The same motion as it was played: with the zero samples between events. @param starts  of the events [s]
GroundMotion as_played(const GroundMotion& sequence, const std::vector<double>& starts);

} // namespace damslip::records
