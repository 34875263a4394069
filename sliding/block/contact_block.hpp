#pragma once

#include "sliding/block/slide.hpp"
#include "sliding/block/slide_batch.hpp"

#include <span>

namespace damslip::sliding {

/// What a block has slipped so far, flat on its base or on a corner.
struct SlipTotals {
    double downstream = 0.0, upstream = 0.0;  ///< sums of the movements, >= 0 [m]
    double largest = 0.0;                     ///< |slip| on the way [m]
    double peak_rate = 0.0;                   ///< |slip rate| [m/s]
    double first_time = 0.0, last_time = 0.0; ///< first start, last stop [s]; meaningful with phases > 0
    double start_path = 0.0;                  ///< accumulated slip before the latest movement [m]
    int phases = 0;                           ///< movements
    int lift_offs = 0;                        ///< times that N' reached zero

    /// A movement begins. @param path  accumulated slip [m]
    void begin(double time, double path)
    {
        start_path = path;
        if (++phases == 1) first_time = time;
    }
    /// The movement ends; one without any slip is not counted.
    void end(double time, double path)
    {
        if (path == start_path)
            --phases;
        else
            last_time = time;
    }

    /// @param now  end of the motion [s] @param moving  the block slides then
    void write(SlideResult& result, double now, bool moving) const
    {
        result.max_slip = largest;
        result.downstream_slip = downstream;
        result.upstream_slip = upstream;
        result.peak_slip_rate = peak_rate;
        result.phases = phases;
        result.lift_offs = lift_offs;
        result.end_time = now;
        if (phases == 0) return;
        result.first_slip_time = first_time;
        result.last_slip_time = moving ? now : last_time;
    }
};

/// A block in permanent contact: what its equations need, and its state. Forms are those of a_h with the polarity in it.
struct ContactBlock {
    /// Sliding one way.
    struct Way {
        GroundLinear excess;   ///< net driving force of the sliding block [N/m]
        double mass = 1.0;     ///< that the slip feels [kg/m]
        GroundLinear normal;   ///< N' of the block at rest [N/m]
        double friction = 0.0; ///< mu [-]
        double bond = 0.0;     ///< cohesion and dowels [N/m]
    };
    GroundLinear drive; ///< driving force of the block at rest, downstream [N/m]
    Way down, up;
    bool two_way = false;       ///< may slide upstream, too
    double plainly_below = 0.0; ///< a net driving force below this is no start, whatever round-off does [N/m]
    double path_limit = never;  ///< the run ends before this accumulated slip, and before any start or stop then [m]

    double time = 0.0; ///< [s]
    bool moving = false;
    bool from_rest = false; ///< the start was located just now: s'' >= 0 whatever round-off does
    SlipDirection direction = SlipDirection::downstream;
    double rate = 0.0; ///< |slip rate| [m/s]
    double path = 0.0; ///< accumulated slip [m]
    SlipTotals slid;
    long changes = 0; ///< starts and stops
    bool unresolved = false;
};

/// Samples that blocks go through.
struct ContactMotion {
    const double* a_h = nullptr;
    const double* a_v = nullptr; ///< null: none
    double dt = 0.0;
    const SkippingMotion* ranges = nullptr; ///< of the same samples, to skip by; null: every sample is looked at
};

/// Intervals k ... last - 1. @param before  intervals so far, for the time  @returns the first one that is left
std::size_t run_in_contact(ContactBlock& block, const ContactMotion& motion, std::size_t k, std::size_t last,
                           std::size_t before);

/// Blocks of a batched run.
inline constexpr std::size_t batch_size = 4;

/// True where the processor computes several numbers at a time.
bool has_batched_runs();

/// A batched run, with the bits of run_in_contact() for each block: `batch_size` blocks go through intervals 0 ... last - 1
/// side by side. Worth it for blocks that move at the same times.
/// @pre has_batched_runs(); no block has a path_limit
/// @returns false where one of the four slips is not resolved; the caller then uses none of them
bool run_in_contact(std::span<ContactBlock, batch_size> blocks, const ContactMotion& motion, std::size_t last);

/// A block of constant yield under samples 0 ... intervals, alone and in a batched run with the same bits: the first of the
/// yields is the least, and has_batched_runs().
SlipSummary run_constant_yield(const ConstantYield& yield, const ContactMotion& motion, std::size_t intervals,
                               const ConstantYieldOptions& options);
void run_constant_yield(std::span<const ConstantYield, batch_size> yields, const ContactMotion& motion,
                        std::size_t intervals, const ConstantYieldOptions& options,
                        std::span<SlipSummary, batch_size> results);

/// Largest value of a form over a range of ground accelerations; largest magnitude of its terms.
double upper(const GroundLinear& form, const AccelRange& range);
double magnitude(const GroundLinear& form, const AccelRange& range);

} // namespace damslip::sliding
