#pragma once

#include "sliding/block/skipping_motion.hpp"
#include "sliding/block/slide.hpp"
#include "sliding/block/yield.hpp"

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

} // namespace damslip::sliding
