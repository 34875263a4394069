#pragma once

#include "sliding/block/slide.hpp"

#include <optional>
#include <span>
#include <vector>

/// Blocks of constant yield acceleration, and many sliding runs in parallel.
namespace damslip::sliding {

/// A block in permanent contact that slides downstream only, under the horizontal motion.
struct ConstantYield {
    double acceleration = 0.0; ///< a_y [m/s^2]; negative: it slides without any earthquake
    double factor = 1.0;       ///< slip acceleration per excess ground acceleration [-]; 1 on a horizontal base
};

enum class Scan {
    skip_blocks, ///< a block at rest skips whole stretches of the motion
    every_sample ///< plain loop; gives the same bits, for tests and the bench
};

struct ConstantYieldOptions {
    int polarity = 1;          ///< +1 or -1: multiplies a_h [-]
    double run_out_max = 60.0; ///< after the record's end at most [s]; 0: none
    Scan scan = Scan::skip_blocks;
};

/// What a sweep keeps of each run; meanings as in SlideResult.
struct SlipSummary {
    Status status = Status::at_rest;
    double slip = 0.0;            ///< [m]
    double max_slip = 0.0;        ///< [m]
    double downstream_slip = 0.0; ///< [m]
    double upstream_slip = 0.0;   ///< [m]
    double peak_slip_rate = 0.0;  ///< [m/s]
    int phases = 0;

    friend bool operator==(const SlipSummary&, const SlipSummary&) = default;
};

/// Exact in the same sense as slide(), which it reproduces to round-off where both apply. Run-out in closed form.
SlipSummary slide_constant_yield(const SkippingMotion& motion, const ConstantYield& yield,
                                 const ConstantYieldOptions& options = {});

/// The same for plain samples (every one is looked at).
SlipSummary slide_constant_yield(std::span<const double> accel, double dt, double yield,
                                 const ConstantYieldOptions& options = {});

// Batches: the results do not depend on the number of threads. `jobs` 0: all cores.

/// Every motion x yield x polarity, one after the other in that order: result[(m n_yields + y) n_polarities + p].
/// `options.polarity` is not used.
std::vector<SlipSummary> slide_batch(std::span<const SkippingMotion> motions, std::span<const ConstantYield> yields,
                                     std::span<const int> polarities, const ConstantYieldOptions& options = {},
                                     int jobs = 0);

/// slide() of blocks in general, motion x block x polarity. `options.polarity` and `options.history` are not used.
std::vector<SlipSummary> slide_batch(std::span<const SkippingMotion> motions, std::span<const SlipStages> blocks,
                                     std::span<const int> polarities, const SlideOptions& options = {}, int jobs = 0);

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
