#include "analysis/fragility/interval_cost.hpp"

#include "analysis/fragility/fragility_estimate.hpp"
#include "core/input_error.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace damslip {

namespace {

bool all_kept(const FragilitySample&, std::size_t)
{
    return true;
}

/// The estimate of one level from its first samples, as long as they are kept.
IntervalPoint point_of(const FragilityPlan& plan, const FragilityRuns& runs, const LimitInput& limit, std::size_t level,
                       std::size_t replicates, const std::string& estimator,
                       const std::function<bool(const FragilitySample&, std::size_t place)>& kept)
{
    IntervalPoint point;
    point.estimator = estimator;
    const LevelEstimate e =
        estimate_first(plan, runs, limit, level, replicates, [&](const FragilitySample& s, std::size_t place) {
            const bool counts = kept(s, place);
            point.runs += counts;
            return counts;
        });
    point.seconds = runs.seconds * (static_cast<double>(point.runs) / static_cast<double>(plan.samples.size()));
    point.p = e.p;
    point.interval = e.sampling;
    if (e.n <= 0.0) point.remark = "no draw stands without an earthquake";
    return point;
}

/// The estimates of one scene at one level.
class IntervalCosts {
public:
    IntervalCosts(FragilityInput input, const ShakingSuite& suite, const SceneText& text, const NumberInFile& written,
                  const IntervalCostOptions& options, Watch& watch)
        : input_(std::move(input)), suite_(suite), text_(text), written_(written), options_(options), watch_(watch)
    {
    }

    std::vector<IntervalPoint> all()
    {
        plain();
        for (const auto& [sampling, name] :
             {std::pair{SamplingInput::latin_hypercube, "Latin hypercube"}, {SamplingInput::sobol, "Sobol'"}})
            for (const std::size_t n : sizes()) points_.push_back(replicated(sampling, name, n));
        compare_with_plain(points_);
        return std::move(points_);
    }

private:
    std::vector<std::size_t> sizes() const
    {
        std::vector<std::size_t> sizes;
        std::size_t n = options_.runs;
        for (std::size_t i = 0; i < options_.sizes && n >= 8; ++i, n /= options_.step) sizes.push_back(n);
        std::reverse(sizes.begin(), sizes.end());
        return sizes;
    }
    FragilityPlan plan_of(SamplingInput sampling, std::size_t samples, std::uint32_t stream) const
    {
        FragilityInput input = input_;
        input.probability.sampling = sampling;
        input.probability.replicates =
            sampling == SamplingInput::random ? 1 : static_cast<int>(std::min(options_.replicates, samples / 2));
        return plan_fragility(input, suite_, {samples, stream}, text_.file(), written_);
    }
    /// Processor time is read by the process' own clock, so that set-ups count. Short ones are run three times, the fastest counts.
    FragilityRuns run(const FragilityPlan& plan, const std::string& method)
    {
        constexpr double short_run = 0.3; // [s]
        FragilityRuns best;
        for (int repeat = 0; repeat < 3; ++repeat) {
            FragilityRuns runs =
                run_fragility(plan, text_, sweep_method(method), wanted_samples(plan), nullptr, options_.jobs, watch_);
            spent_ += runs.seconds;
            if (repeat == 0 || runs.seconds < best.seconds) best = std::move(runs);
            if (best.seconds > short_run) break;
        }
        return best;
    }
    bool stopped(IntervalPoint& point)
    {
        if (watch_.stop_asked()) point.remark = "interrupted";
        return watch_.stop_asked();
    }
    /// Whether so many runs still fit into the budget.
    bool too_dear(std::size_t runs, IntervalPoint& point)
    {
        point.runs = runs;
        const double expected = per_run_ * static_cast<double>(runs);
        if (spent_ + expected <= options_.budget) return false;
        point.remark = fmt::format("left out: {:.3g} s expected, {:.3g} s of the budget are left", expected,
                                   std::max(0.0, options_.budget - spent_));
        return true;
    }

    void plain()
    {
        std::vector<std::size_t> wanted = sizes();
        // A small run first where its price is not known, so that the budget holds.
        IntervalPoint none;
        none.estimator = "plain";
        {
            const FragilityPlan few = plan_of(SamplingInput::random, wanted.front(), 5);
            const FragilityRuns runs = run_fragility(few, text_, sweep_method(options_.method), wanted_samples(few),
                                                     nullptr, options_.jobs, watch_);
            spent_ += runs.seconds;
            per_run_ = runs.seconds / static_cast<double>(few.samples.size());
        }
        while (!wanted.empty() && too_dear(wanted.back(), none)) {
            left_out_.insert(left_out_.begin(), none);
            wanted.pop_back();
        }
        if (!wanted.empty()) {
            const FragilityPlan longest = plan_of(SamplingInput::random, wanted.back(), 0);
            const FragilityRuns runs = run(longest, options_.method);
            if (runs.complete()) per_run_ = runs.seconds / static_cast<double>(longest.samples.size());
            for (const std::size_t n : wanted) {
                if (options_.method == options_.rigid && n < wanted.back()) { // cheap enough to be run by itself
                    points_.push_back(replicated(SamplingInput::random, "plain", n));
                    continue;
                }
                IntervalPoint point =
                    point_of(longest, runs, longest.input.limits.front(), 0, longest.replicates, "plain",
                             [n](const FragilitySample&, std::size_t place) { return place < n; });
                if (!runs.complete()) point.remark = "interrupted";
                points_.push_back(std::move(point));
            }
        }
        points_.insert(points_.end(), left_out_.begin(), left_out_.end());
    }
    IntervalPoint replicated(SamplingInput sampling, const std::string& name, std::size_t n)
    {
        IntervalPoint point;
        point.estimator = name;
        if (stopped(point) || too_dear(n, point)) return point;
        const FragilityPlan plan = plan_of(sampling, n, 0);
        const FragilityRuns runs = run(plan, options_.method);
        if (stopped(point)) return point;
        return point_of(plan, runs, plan.input.limits.front(), 0, plan.replicates, name, all_kept);
    }

    FragilityInput input_;
    const ShakingSuite& suite_;
    const SceneText& text_;
    const NumberInFile& written_;
    const IntervalCostOptions& options_;
    Watch& watch_;
    double spent_ = 0.0, per_run_ = 0.0; ///< processor time so far; of a run
    std::vector<IntervalPoint> points_, left_out_;
};

/// Where P is nearest to 0.1 by the rigid block, 256 random draws a level.
double level_near_a_tenth(const FragilityInput& input, const ShakingSuite& suite, const SceneText& text,
                          const NumberInFile& written, const IntervalCostOptions& options, Watch& watch)
{
    constexpr std::size_t draws = 256;
    FragilityInput random = input;
    random.probability.sampling = SamplingInput::random;
    random.probability.replicates = 1;
    const FragilityPlan plan = plan_fragility(random, suite, {draws, 6}, text.file(), written);
    const FragilityRuns runs =
        run_fragility(plan, text, sweep_method(options.rigid), wanted_samples(plan), nullptr, options.jobs, watch);
    const FragilityEstimate estimate = estimate_fragility(plan, runs, nullptr, {});
    const std::vector<LevelEstimate>& levels = estimate.limits.front().levels;
    return levels[level_nearest(levels, 0.1)].x;
}

} // namespace

void compare_with_plain(std::vector<IntervalPoint>& points)
{
    const IntervalPoint* plain = nullptr;
    for (const IntervalPoint& point : points)
        if (point.estimator == "plain" && point.done() && (!plain || point.runs > plain->runs)) plain = &point;
    if (!plain) return;
    const double price = plain->seconds * std::pow(plain->interval.half_width(), 2); // of half-width 1 [s]
    for (IntervalPoint& point : points) {
        const double half = point.interval.half_width();
        if (point.estimator != "plain" && point.done() && half > 0.0 && point.seconds > 0.0)
            point.gain = price / (point.seconds * half * half);
    }
}

IntervalCost interval_cost(const FragilityInput& given, const ShakingSuite& suite, const SceneText& text,
                           const NumberInFile& written, const IntervalCostOptions& options, Watch& watch)
{
    if (given.probability.variables.empty())
        refuse(text.file(), "nothing is drawn: the scene has no [[probability.variable]].",
               "a variable at least: of records alone P is exact", "add a [[probability.variable]]");
    FragilityInput input = given;
    input.limits.resize(1);
    input.intensity.design = FragilityDesign::stripes;
    input.probability.samples.reset();
    for (RandomVariable& v : input.probability.variables) v.kind = VariableKind::aleatory;
    IntervalCost cost;
    cost.limit = input.limits.front();
    cost.method = options.method;
    cost.level = options.level ? *options.level : level_near_a_tenth(input, suite, text, written, options, watch);
    input.intensity.levels = {cost.level};
    cost.points = IntervalCosts(input, suite, text, written, options, watch).all();
    return cost;
}

std::vector<IntervalPoint> own_prefixes(const FragilityPlan& plan, const FragilityRuns& runs, const LimitInput& limit,
                                        std::size_t level)
{
    std::vector<IntervalPoint> points;
    if (plan.input.intensity.design == FragilityDesign::cloud || (plan.whole_suite && !plan.epistemic)) return points;
    const bool independent = plan.input.probability.sampling == SamplingInput::random && !plan.epistemic;
    const std::size_t at_level = plan.samples.size() / plan.levels;
    const std::size_t all = independent ? at_level : plan.replicates, least = independent ? 16 : 2;
    for (std::size_t n = all; n >= least; n /= 2)
        points.push_back(point_of(
            plan, runs, limit, level, independent ? plan.replicates : n, limit.text,
            [&](const FragilitySample& s, std::size_t place) { return independent ? place < n : s.replicate < n; }));
    std::reverse(points.begin(), points.end());
    return points;
}

} // namespace damslip
