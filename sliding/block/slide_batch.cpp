#include "sliding/block/slide_batch.hpp"

#include "core/parallel.hpp"
#include "sliding/block/yield_lanes.hpp"

#include <algorithm>
#include <array>

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

/// Runs of one motion, `at` in its results: neighbours in the lanes have one polarity and neighbouring yields, so that
/// they move at the same times.
struct Run {
    std::size_t yield = 0;
    std::size_t at = 0;
    int polarity = 1;
};

std::vector<Run> sorted_runs(std::span<const FixedYield> yields, std::span<const int> polarities)
{
    std::vector<Run> runs;
    for (std::size_t p = 0; p < polarities.size(); ++p) {
        const std::size_t first = runs.size();
        for (std::size_t y = 0; y < yields.size(); ++y) runs.push_back({y, y * polarities.size() + p, polarities[p]});
        std::stable_sort(runs.begin() + first, runs.end(), [&](const Run& a, const Run& b) {
            return yields[a.yield].downstream.law.constant < yields[b.yield].downstream.law.constant;
        });
    }
    return runs;
}

/// `runs` of one polarity, at most as many as there are lanes; what the lanes do not know goes one by one.
void slide_few(const SkippingMotion& motion, std::span<const Run> runs, std::span<const FixedYield> yields,
               FixedYieldOptions options, std::span<SlipSummary> results)
{
    options.polarity = runs.front().polarity;
    const bool fit = options.scan == Scan::skip_blocks && std::ranges::all_of(runs, [&](const Run& run) {
                         return fits_lanes(motion, yields[run.yield], run.polarity);
                     });
    if (!fit) {
        for (const Run& run : runs) results[run.at] = slide_fixed_yield(motion, yields[run.yield], options);
        return;
    }
    std::array<FixedYield, yield_lanes> lanes;
    for (std::size_t i = 0; i < yield_lanes; ++i) lanes[i] = yields[runs[std::min(i, runs.size() - 1)].yield];
    const std::array<SlipSummary, yield_lanes> slips = slide_in_lanes(motion, lanes, options);
    for (std::size_t i = 0; i < runs.size(); ++i) results[runs[i].at] = slips[i];
}

} // namespace

std::vector<SlipSummary> slide_batch(std::span<const SkippingMotion> motions, std::span<const FixedYield> yields,
                                     std::span<const int> polarities, const FixedYieldOptions& options, int jobs)
{
    const std::size_t per_motion = yields.size() * polarities.size();
    std::vector<SlipSummary> results(motions.size() * per_motion);
    const std::vector<Run> runs = sorted_runs(yields, polarities);
    // One piece of work is one motion with one polarity: long enough to be worth a thread's while, and its samples stay
    // in the cache.
    parallel_for(motions.size() * polarities.size(), jobs, [&](std::size_t piece) {
        const std::size_t m = piece / polarities.size(), p = piece % polarities.size();
        const std::span<const Run> here = std::span(runs).subspan(p * yields.size(), yields.size());
        for (std::size_t i = 0; i < here.size(); i += yield_lanes)
            slide_few(motions[m], here.subspan(i, std::min(yield_lanes, here.size() - i)), yields, options,
                      std::span(results).subspan(m * per_motion, per_motion));
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
