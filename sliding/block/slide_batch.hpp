#pragma once

#include "sliding/block/slide.hpp"
#include "sliding/block/yield.hpp"

#include <optional>
#include <span>

/// The quick exact integrator for a block whose yields do not change with slip and whose base never opens.
namespace damslip::sliding {

/// Both yields of a block, constant or linear in a_v; infinite upstream: one-way.
struct FixedYield {
    Yield downstream;
    Yield upstream{{never_slides, 0.0}, 0.0};

    static constexpr double never_slides = std::numeric_limits<double>::infinity();
};

/// Both ways, or downstream only.
FixedYield fixed_yield(const RigidBlock& block, bool two_way);

/// Yields that are plain numbers [m/s^2], horizontal base.
FixedYield fixed_yield(double downstream, double upstream = FixedYield::never_slides);

enum class Scan {
    skip_blocks, ///< a block at rest skips whole stretches of the motion
    every_sample ///< plain loop; gives the same bits, for tests and the bench
};

struct FixedYieldOptions {
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

/// Slip of a block with fixed yields; exact in the same sense as slide(), which it reproduces to round-off where both
/// apply. Yields linear in a_v are followed without lift-off: see never_opens.
SlipSummary slide_fixed_yield(const SkippingMotion& motion, const FixedYield& yield,
                              const FixedYieldOptions& options = {});

/// The same for plain samples of one component and constant yields (every sample is looked at).
SlipSummary slide_constant_yield(std::span<const double> accel, double dt, double yield_down,
                                 double yield_up = FixedYield::never_slides, const FixedYieldOptions& options = {});

/// True when N' surely stays positive under the motion, at rest and while sliding without resistance: the base never
/// opens.
bool never_opens(const RigidBlock& block, const SkippingMotion& motion);

// Many sliding runs in parallel; the results do not depend on the number of threads. `jobs` 0: all cores.

/// Every motion x yield x polarity, one after the other in that order: result[(m n_yields + y) n_polarities + p].
/// `options.polarity` is not used.
std::vector<SlipSummary> slide_batch(std::span<const SkippingMotion> motions, std::span<const FixedYield> yields,
                                     std::span<const int> polarities, const FixedYieldOptions& options = {},
                                     int jobs = 0);

/// The same for blocks in general, motion x block x polarity: by fixed yields where the block does not change with slip
/// and its base never opens, else by slide(). `options.polarity` and `options.history` are not used.
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
