#include "sliding/block/slide_batch.hpp"

#include "core/parallel.hpp"

#include <algorithm>

namespace damslip::sliding {
namespace {

SlipSummary summary_of(const SlideResult& r)
{
    return {r.status, r.slip, r.max_slip, r.downstream_slip, r.upstream_slip, r.peak_slip_rate, r.phases};
}

SlipSummary run_one(const SkippingMotion& motion, const SlipStages& stages, int polarity, SlideOptions options)
{
    options.polarity = polarity;
    options.history = HistoryOutput::none;
    const bool quick = options.sliding.scheme == SlidingScheme::exact && stages.size() == 1 &&
                       options.anchors.empty() && !motion.motion().is_sequence() && !stages.front().rate.active() &&
                       never_opens(stages.front().block, motion);
    if (!quick) return summary_of(slide(motion, stages, options));
    check_stages(stages);
    return slide_fixed_yield(motion, fixed_yield(stages.front().block, options.sliding.two_way),
                             {polarity, options.sliding.run_out_max, Scan::skip_blocks});
}

} // namespace

std::vector<SlipSummary> slide_batch(std::span<const SkippingMotion> motions, std::span<const FixedYield> yields,
                                     std::span<const int> polarities, const FixedYieldOptions& options, int jobs)
{
    const std::size_t per_motion = yields.size() * polarities.size();
    std::vector<SlipSummary> results(motions.size() * per_motion);
    // One piece of work is one motion with a few yields: long enough to be worth a thread's while, and its samples stay
    // in the cache.
    const std::size_t chunk = 8, chunks = (per_motion + chunk - 1) / chunk;
    parallel_for(motions.size() * chunks, jobs, [&](std::size_t piece) {
        const std::size_t m = piece / chunks, first = piece % chunks * chunk;
        for (std::size_t i = first; i < std::min(first + chunk, per_motion); ++i) {
            FixedYieldOptions run = options;
            run.polarity = polarities[i % polarities.size()];
            results[m * per_motion + i] = slide_fixed_yield(motions[m], yields[i / polarities.size()], run);
        }
    });
    return results;
}

std::vector<SlipSummary> slide_batch(std::span<const SkippingMotion> motions, std::span<const SlipStages> blocks,
                                     std::span<const int> polarities, const SlideOptions& options, int jobs)
{
    const std::size_t per_motion = blocks.size() * polarities.size();
    std::vector<SlipSummary> results(motions.size() * per_motion);
    parallel_for(results.size(), jobs, [&](std::size_t i) {
        const std::size_t m = i / per_motion, b = i % per_motion / polarities.size(), p = i % polarities.size();
        results[i] = run_one(motions[m], blocks[b], polarities[p], options);
    });
    return results;
}

} // namespace damslip::sliding
