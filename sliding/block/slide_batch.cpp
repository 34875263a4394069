#include "sliding/block/slide_batch.hpp"

#include "core/parallel.hpp"
#include "sliding/block/constant_yield_run.hpp"
#include "sliding/block/contact_block.hpp"
#include "sliding/block/permanent_contact.hpp"

#include <algorithm>
#include <array>

namespace damslip::sliding {

namespace {

template <bool vertical>
std::size_t run_alone(ContactBlock& block, const ContactMotion& motion, std::size_t k, std::size_t last,
                      std::size_t before)
{
    PermanentContact<double, vertical> run(std::span(&block, 1), motion);
    k = run.run(k, last, before);
    run.write(std::span(&block, 1));
    return k;
}

} // namespace

std::size_t run_in_contact(ContactBlock& block, const ContactMotion& motion, std::size_t k, std::size_t last,
                           std::size_t before)
{
    return motion.a_v ? run_alone<true>(block, motion, k, last, before)
                      : run_alone<false>(block, motion, k, last, before);
}

SlipSummary run_constant_yield(const ConstantYield& yield, const ContactMotion& motion, std::size_t intervals,
                               const ConstantYieldOptions& options)
{
    SlipSummary result;
    ConstantYieldRun<double>(std::span(&yield, 1), motion, intervals, options).run(std::span(&result, 1));
    return result;
}

double upper(const GroundLinear& form, const AccelRange& r)
{
    return form.constant + form.per_a_h * (form.per_a_h > 0.0 ? r.h_max : r.h_min) +
           form.per_a_v * (form.per_a_v > 0.0 ? r.v_max : r.v_min);
}

double magnitude(const GroundLinear& form, const AccelRange& r)
{
    return std::abs(form.constant) + std::abs(form.per_a_h) * std::max(-r.h_min, r.h_max) +
           std::abs(form.per_a_v) * std::max(-r.v_min, r.v_max);
}

namespace {

ContactMotion samples_of(const SkippingMotion& motion, Scan scan)
{
    const GroundMotion& ground = motion.motion();
    return {ground.accel_h.data(), nullptr, ground.dt, scan == Scan::skip_blocks ? &motion : nullptr};
}

/// Runs of one motion, `at` in its results: neighbours in a batched run have one polarity and neighbouring yields, so that
/// they move at the same times.
struct Run {
    std::size_t yield = 0;
    std::size_t at = 0;
    int polarity = 1;
};

std::vector<Run> sorted_runs(std::span<const ConstantYield> yields, std::span<const int> polarities)
{
    std::vector<Run> runs;
    for (std::size_t p = 0; p < polarities.size(); ++p) {
        const std::size_t first = runs.size();
        for (std::size_t y = 0; y < yields.size(); ++y) runs.push_back({y, y * polarities.size() + p, polarities[p]});
        std::stable_sort(runs.begin() + first, runs.end(), [&](const Run& a, const Run& b) {
            return yields[a.yield].acceleration < yields[b.yield].acceleration;
        });
    }
    return runs;
}

/// @param runs  of one polarity, at most as many as a batched run has
void slide_few(const SkippingMotion& motion, std::span<const Run> runs, std::span<const ConstantYield> yields,
               ConstantYieldOptions options, std::span<SlipSummary> results)
{
    options.polarity = runs.front().polarity;
    if (!has_batched_runs() || runs.size() == 1) {
        for (const Run& run : runs) results[run.at] = slide_constant_yield(motion, yields[run.yield], options);
        return;
    }
    std::array<ConstantYield, batch_size> batch; // the last run fills up
    for (std::size_t i = 0; i < batch_size; ++i) batch[i] = yields[runs[std::min(i, runs.size() - 1)].yield];
    std::array<SlipSummary, batch_size> slips;
    run_constant_yield(batch, samples_of(motion, options.scan), motion.intervals(), options, slips);
    for (std::size_t i = 0; i < runs.size(); ++i) results[runs[i].at] = slips[i];
}

} // namespace

SlipSummary slide_constant_yield(const SkippingMotion& motion, const ConstantYield& yield,
                                 const ConstantYieldOptions& options)
{
    return run_constant_yield(yield, samples_of(motion, options.scan), motion.intervals(), options);
}

SlipSummary slide_constant_yield(std::span<const double> accel, double dt, double yield,
                                 const ConstantYieldOptions& options)
{
    if (accel.size() < 2) return {};
    return run_constant_yield({yield}, {accel.data(), nullptr, dt, nullptr}, accel.size() - 1, options);
}

std::vector<SlipSummary> slide_batch(std::span<const SkippingMotion> motions, std::span<const ConstantYield> yields,
                                     std::span<const int> polarities, const ConstantYieldOptions& options, int jobs)
{
    const std::size_t per_motion = yields.size() * polarities.size();
    std::vector<SlipSummary> results(motions.size() * per_motion);
    const std::vector<Run> runs = sorted_runs(yields, polarities);
    // One piece of work is one motion with one polarity: long enough to be worth a thread's while, and its samples stay
    // in the cache.
    parallel_for(motions.size() * polarities.size(), jobs, [&](std::size_t piece) {
        const std::size_t m = piece / polarities.size(), p = piece % polarities.size();
        const std::span<const Run> here = std::span(runs).subspan(p * yields.size(), yields.size());
        for (std::size_t i = 0; i < here.size(); i += batch_size)
            slide_few(motions[m], here.subspan(i, std::min(batch_size, here.size() - i)), yields, options,
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
        SlideOptions of_run = options;
        of_run.polarity = polarities[i % polarities.size()];
        of_run.history = HistoryOutput::none;
        const SlideResult r = slide(motions[i / per_motion], blocks[i % per_motion / polarities.size()], of_run);
        results[i] = {r.status, r.slip, r.max_slip, r.downstream_slip, r.upstream_slip, r.peak_slip_rate, r.phases};
    });
    return results;
}

std::optional<double> yield_for_slip(const SkippingMotion& motion, double slip, int polarity)
{
    const AccelRange& whole = motion.whole();
    const double peak = std::max(0.0, polarity > 0 ? whole.h_max : -whole.h_min);
    if (slip <= 0.0) return peak;
    ConstantYieldOptions options;
    options.polarity = polarity;
    const auto slips_more = [&](double yield) { return slide_constant_yield(motion, {yield}, options).slip > slip; };
    double more = 1e-12 * peak, less = peak;
    if (!slips_more(more)) return std::nullopt;
    while (less - more > 1e-12 * peak) {
        const double middle = 0.5 * (more + less);
        (slips_more(middle) ? more : less) = middle;
    }
    return 0.5 * (more + less);
}

} // namespace damslip::sliding
