#include "analysis/fragility/fragility_estimate.hpp"

#include "analysis/fragility/conditioned_plan.hpp"
#include "analysis/sweep/sweep_grid.hpp"
#include "core/statistics.hpp"
#include "core/status.hpp"
#include "probability/fit.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace damslip {

namespace {

/// Which events there are, and of which one each record is.
struct Events {
    std::vector<std::size_t> of_record;
    std::size_t count = 0;
};

Events events_of(const ShakingSuite& suite)
{
    std::vector<std::string> names;
    Events events;
    for (const std::string& event : suite.event) {
        const auto at = std::find(names.begin(), names.end(), event);
        events.of_record.push_back(static_cast<std::size_t>(at - names.begin()));
        if (at == names.end()) names.push_back(event);
    }
    events.count = names.size();
    return events;
}

LimitCounts count_limit(const FragilityPlan& plan, const FragilityRuns& runs, const LimitInput& limit)
{
    LimitCounts counts(plan);
    for (std::size_t id = 0; id < plan.samples.size(); ++id) {
        const FragilitySample s = plan.samples[id];
        counts.add(s, s.level, s.replicate,
                   count_of(answer_to(limit, runs.rows[id]), plan.input.probability.static_failure, s.weight));
    }
    return counts;
}

/// The one draw of a scene without variables, under the whole suite: P is that of the suite itself.
bool nothing_drawn(const FragilityPlan& plan)
{
    return plan.whole_suite && !plan.epistemic;
}

/// Variance of a share by clusters whose runs hang together, sum (z - p n)^2 / (all n)^2 k / (k - 1): as of a ratio, clusters may differ in size.
template <class Share>
double cluster_variance(const std::vector<RunCount>& clusters, const RunCount& all, Share share)
{
    double sum = 0.0, k = 0.0;
    for (const RunCount& c : clusters) {
        sum += std::pow((share(c) - share(all)) * c.n, 2);
        k += c.n > 0.0;
    }
    return k > 1.0 ? sum / (all.n * all.n) * k / (k - 1.0) : 0.0;
}

/// 95 % of a share whose runs share their epistemic draws (outer) and their inner draws, each with each: two-way clusters, V = V_outer + V_inner -
/// p (1 - p) / n, not below either of both (Cameron, Gelbach & Miller 2011); degrees of freedom of Satterthwaite (1946).
template <class Share>
probability::Interval crossed_interval(const LimitCounts& counts, std::size_t level, double independent, Share share)
{
    const RunCount& all = counts.all[level];
    const double p = std::clamp(share(all), 0.0, 1.0);
    const double outer = cluster_variance(counts.outer[level], all, share),
                 inner = cluster_variance(counts.inner[level], all, share);
    const double variance = std::max({outer + inner - p * (1.0 - p) / all.n, outer, inner});
    if (!(variance > 0.0)) return probability::wilson(p * independent, independent);
    const auto part = [](double v, std::size_t k) { return k > 1 ? v * v / static_cast<double>(k - 1) : 0.0; };
    const double degrees = std::pow(outer + inner, 2) /
                           (part(outer, counts.outer[level].size()) + part(inner, counts.inner[level].size()));
    // A single run that ends otherwise says nothing of the spread: not within what none, or all of them, would say.
    const probability::Interval found = probability::wilson_of_estimate(p, std::sqrt(variance), all.n, degrees);
    return {std::min(found.lower, probability::wilson(independent, independent).lower),
            std::max(found.upper, probability::wilson(0.0, independent).upper)};
}

/// 95 % of a share by independent runs, by replicates whose points hang together, or by clusters of one replicate.
/// @param share  of a count: low() or high()
template <class Share>
probability::Interval sampling_interval(const FragilityPlan& plan, const LimitCounts& counts, std::size_t level,
                                        bool weighted, Share share)
{
    const RunCount& all = counts.all[level];
    const std::vector<RunCount>& replicates = counts.replicate[level];
    const double p = std::clamp(share(all), 0.0, 1.0);
    if (all.n <= 0.0) return {};
    if (nothing_drawn(plan)) return {p, p};
    const bool independent = !weighted && plan.input.probability.sampling == SamplingInput::random && !plan.epistemic;
    double sum = 0.0;
    const auto r = static_cast<double>(replicates.size());
    for (const RunCount& c : replicates) sum += (share(c) - p) * (share(c) - p);
    // All runs of an epistemic draw hang together, and all of an inner draw: where they all agree, they say what the fewer of both say.
    const std::size_t clusters = plan.whole_suite ? plan.outer : std::min(plan.outer, plan.inner);
    const double n = plan.epistemic ? std::min(all.n, static_cast<double>(plan.replicates * clusters)) : all.n;
    if (plan.epistemic && replicates.size() == 1 && !weighted) return crossed_interval(counts, level, n, share);
    if (independent || replicates.size() < 2 || p <= 0.0 || p >= 1.0 || sum == 0.0)
        return probability::wilson(p * n, n);
    return probability::wilson_of_estimate(p, std::sqrt(sum / (r * (r - 1.0))), all.n, r - 1.0);
}

/// Standard error of P by the replicates; of one: 0.
double error_of_replicates(const std::vector<RunCount>& replicates, double p)
{
    const auto r = static_cast<double>(replicates.size());
    if (replicates.size() < 2) return 0.0;
    double sum = 0.0;
    for (const RunCount& c : replicates) sum += (c.middle() - p) * (c.middle() - p);
    return std::sqrt(sum / (r * (r - 1.0)));
}

LevelEstimate estimate_level(const FragilityPlan& plan, const LimitCounts& counts, std::size_t level, double x,
                             bool weighted)
{
    const RunCount& all = counts.all[level];
    LevelEstimate e;
    e.x = x;
    e.n = all.n;
    e.z = all.z;
    e.missing = all.missing;
    e.p_low = std::clamp(all.low(), 0.0, 1.0); // of weighted differences it may lie outside
    e.p_high = std::clamp(all.high(), 0.0, 1.0);
    e.p = 0.5 * (e.p_low + e.p_high);
    e.se = error_of_replicates(counts.replicate[level], all.middle());
    e.sampling = {sampling_interval(plan, counts, level, weighted, [](const RunCount& c) { return c.low(); }).lower,
                  sampling_interval(plan, counts, level, weighted, [](const RunCount& c) { return c.high(); }).upper};
    const std::vector<RunCount>& clusters = counts.cluster[level];
    const auto by_clusters = [&](auto share) {
        return probability::cluster_bootstrap(
            clusters.size(),
            [&](std::span<const std::uint32_t> times) {
                RunCount drawn;
                for (std::size_t c = 0; c < clusters.size(); ++c) drawn.add(clusters[c], times[c]);
                return share(drawn);
            },
            plan.input.probability.seed);
    };
    if (clusters.size() > 1) {
        e.records = by_clusters([](const RunCount& c) { return c.low(); });
        if (all.missing > 0.0) e.records.upper = by_clusters([](const RunCount& c) { return c.high(); }).upper;
        e.records.lower = std::clamp(e.records.lower, 0.0, 1.0);
        e.records.upper = std::clamp(e.records.upper, 0.0, 1.0);
    } else {
        e.records.clusters = 1;
        e.records.few = true;
    }
    if (plan.epistemic) {
        std::vector<double> p, inner;
        for (const RunCount& c : counts.outer[level]) {
            if (c.n <= 0.0) continue; // no draw of it stands
            p.push_back(c.middle());
            inner.push_back(plan.whole_suite ? 0.0 : c.n);
        }
        if (p.size() > 1 && (plan.whole_suite || *std::min_element(inner.begin(), inner.end()) > 1.0))
            e.bands = probability::epistemic_bands(p, inner);
    }
    return e;
}

/// Plain runs with the same standard error, p (1 - p) / se^2, at most twenty for each run there is: the error comes from few replicates. A
/// conditioned stripe is surer than its runs, and a curve that misses it must not pass for one that fits.
double runs_of_same_error(const FragilityPlan& plan, const LevelEstimate& e)
{
    const double variance = e.p * (1.0 - e.p), most = 20.0 * e.n;
    if (!(variance > 0.0)) return e.n;
    if (nothing_drawn(plan)) return most;
    return e.se > 0.0 ? std::min(variance / (e.se * e.se), most) : e.n;
}

/// First level of each draw and record above which D > d.
void find_capacities(const FragilityPlan& plan, const FragilityRuns& runs, LimitEstimate& limit)
{
    std::vector<double> reached, censored;
    for (const CapacityBracket& bracket : capacity_brackets(plan, runs, limit.limit)) {
        if (bracket.first)
            reached.push_back(plan.samples[*bracket.first].x);
        else
            censored.push_back(plan.input.intensity.levels.back());
        limit.came_back += bracket.came_back;
    }
    limit.capacities = probability::fit_capacities(reached, censored);
}

/// P of a cloud at the levels, with the runs that have no answer as survivals and as failures.
void fit_cloud_of(const FragilityPlan& plan, const FragilityRuns& runs, LimitEstimate& limit)
{
    constexpr double least_slip = 1e-4; // [m]
    std::vector<probability::CloudPoint> points, missing;
    double error = 0.0;
    for (std::size_t id = 0; id < plan.samples.size(); ++id) {
        const std::optional<FinishedRow> row = runs.rows[id];
        const LimitAnswer answer = answer_to(limit.limit, row);
        const bool failed =
            answer == LimitAnswer::static_failure || (answer == LimitAnswer::fails && !row->results.slip);
        if (answer == LimitAnswer::missing) {
            missing.push_back({plan.samples[id].x, 0.0, false});
            continue;
        }
        if (answer == LimitAnswer::static_failure &&
            plan.input.probability.static_failure == StaticFailure::given_standing)
            continue;
        const std::optional<double>& slip =
            limit.limit.quantity == LimitQuantity::slip ? row->results.slip : row->results.max_slip;
        points.push_back({plan.samples[id].x, std::abs(slip.value_or(0.0)), failed});
        error = std::max(error, row->results.slip_error.value_or(0.0));
    }
    const double smallest = std::max(least_slip, 2.0 * error);
    limit.cloud = probability::fit_cloud(points, smallest);
    const auto with_missing = [&](bool failed) {
        std::vector<probability::CloudPoint> all = points;
        for (probability::CloudPoint point : missing) {
            point.failed = failed;
            all.push_back(point);
        }
        return probability::fit_cloud(all, smallest);
    };
    const probability::CloudFit low = missing.empty() ? *limit.cloud : with_missing(false),
                                high = missing.empty() ? *limit.cloud : with_missing(true);
    for (const double x : plan.input.intensity.levels) {
        LevelEstimate& level = limit.levels.emplace_back();
        level.x = x;
        level.n = static_cast<double>(points.size() + missing.size());
        level.missing = static_cast<double>(missing.size());
        if (!limit.cloud->found || limit.limit.value < limit.cloud->smallest_slip) continue;
        level.fitted = limit.cloud->probability(x, limit.limit.value);
        level.p_low = low.found ? low.probability(x, limit.limit.value) : 0.0;
        level.p_high = high.found ? high.probability(x, limit.limit.value) : 1.0;
        level.p = 0.5 * (level.p_low + level.p_high);
    }
}

LimitRate rate_of(const FragilityPlan& plan, const LimitEstimate& limit, const LimitCounts& counts,
                  const probability::HazardCurve& hazard, std::optional<double> all_events)
{
    LimitRate rate;
    std::vector<double> x, p, low, high, p_lower, p_upper;
    bool& growing = rate.growing;
    double largest = 0.0;
    for (const LevelEstimate& level : limit.levels) {
        x.push_back(level.x);
        p.push_back(level.p);
        low.push_back(level.p_low);
        high.push_back(level.p_high);
        p_lower.push_back(level.sampling.lower);
        p_upper.push_back(level.sampling.upper);
        growing = growing && level.sampling.upper >= largest;
        largest = std::max(largest, level.sampling.lower);
    }
    rate.raw = probability::annual_rate(hazard, x, p, all_events, growing);
    rate.raw_low = probability::annual_rate(hazard, x, low, all_events, growing);
    rate.raw_high = probability::annual_rate(hazard, x, high, all_events, growing);
    if (limit.fit.lognormal())
        rate.fitted = probability::annual_rate(hazard, limit.fit.curve.median, limit.fit.curve.beta, x.front(),
                                               x.back(), all_events);
    const auto raw_rate = [&](const std::vector<double>& q) { // P outside the stripes is bounded as annual_rate() does
        return probability::annual_rate(hazard, x, q, std::nullopt, growing).lower;
    };
    const auto rate_with = [&](auto count) {
        std::vector<double> q;
        for (std::size_t level = 0; level < x.size(); ++level) q.push_back(std::clamp(count(level).middle(), 0.0, 1.0));
        return raw_rate(q);
    };
    const double whole = raw_rate(p);
    rate.sampling = {raw_rate(p_lower), raw_rate(p_upper)};
    if (plan.replicates > 1 && !nothing_drawn(plan)) {
        std::vector<double> parts;
        for (std::size_t r = 0; r < plan.replicates; ++r)
            parts.push_back(rate_with([&](std::size_t l) { return counts.replicate[l][r]; }));
        double sum = 0.0;
        for (const double part : parts) sum += (part - whole) * (part - whole);
        const auto n = static_cast<double>(parts.size());
        // As a share of the rate of the lowest level, which bounds it, Wilson's interval keeps it above zero.
        const double most = hazard.rate_at(std::max(x.front(), hazard.x().front()));
        if (sum > 0.0 && whole > 0.0 && whole < most) {
            const probability::Interval share = probability::wilson_of_estimate(
                whole / most, std::sqrt(sum / (n * (n - 1.0))) / most, counts.all.front().n, n - 1.0);
            rate.sampling = {share.lower * most, share.upper * most};
        }
    }
    const std::size_t clusters = counts.cluster.front().size();
    if (clusters > 1)
        rate.records = probability::cluster_bootstrap(
            clusters,
            [&](std::span<const std::uint32_t> times) {
                return rate_with([&](std::size_t level) {
                    RunCount drawn;
                    for (std::size_t c = 0; c < clusters; ++c) drawn.add(counts.cluster[level][c], times[c]);
                    return drawn;
                });
            },
            plan.input.probability.seed);
    rate.records.lower = std::max(0.0, rate.records.lower);
    if (plan.epistemic) {
        std::vector<double> rates;
        for (std::size_t e = 0; e < counts.outer.front().size(); ++e)
            rates.push_back(rate_with([&](std::size_t l) { return counts.outer[l][e]; }));
        for (const double q : probability::band_levels) rate.bands.push_back(percentile(rates, q));
    }
    return rate;
}

} // namespace

bool is_of_slip(const LimitInput& limit)
{
    return limit.quantity == LimitQuantity::slip || limit.quantity == LimitQuantity::largest_slip;
}

LimitAnswer answer_to(const LimitInput& limit, const std::optional<FinishedRow>& row)
{
    const std::optional<Status> status = row ? status_of(*row) : std::nullopt;
    if (!status) return LimitAnswer::missing;
    if (fails_statically(*status)) return LimitAnswer::static_failure;
    const RowResults& r = row->results;
    const bool of_slip = is_of_slip(limit);
    switch (*status) {
    case Status::runs_away:
    case Status::overturned:
    case Status::left_plane:
        return LimitAnswer::fails;
    case Status::sliding_at_end: // the slip so far is a lower bound
        return of_slip && r.max_slip && *r.max_slip > limit.value ? LimitAnswer::fails : LimitAnswer::missing;
    case Status::at_rest: {
        if (!of_slip) {
            const bool factor = limit.quantity == LimitQuantity::post_seismic_fs;
            const std::optional<double>& value = factor ? r.factor_after : r.opening;
            if (!value) return LimitAnswer::missing;
            return (factor ? *value < limit.value : *value > limit.value) ? LimitAnswer::fails : LimitAnswer::survives;
        }
        const std::optional<double>& slip = limit.quantity == LimitQuantity::slip ? r.slip : r.max_slip;
        if (!slip) return LimitAnswer::missing;
        return std::abs(*slip) > limit.value ? LimitAnswer::fails : LimitAnswer::survives;
    }
    default:
        return LimitAnswer::missing;
    }
}

std::vector<CapacityBracket> capacity_brackets(const FragilityPlan& plan, const FragilityRuns& runs,
                                               const LimitInput& limit)
{
    // Samples of one outer draw, inner draw and replicate, by level.
    std::map<std::pair<std::size_t, std::size_t>, std::vector<std::optional<std::size_t>>> curves;
    for (std::size_t id = 0; id < plan.samples.size(); ++id) {
        const FragilitySample& s = plan.samples[id];
        auto& curve = curves[{s.outer, s.inner}];
        curve.resize(plan.levels);
        curve[s.level] = id;
    }
    std::vector<CapacityBracket> brackets;
    for (const auto& [key, curve] : curves) {
        std::vector<LimitAnswer> answers;
        for (const auto& id : curve) answers.push_back(id ? answer_to(limit, runs.rows[*id]) : LimitAnswer::missing);
        if (answers.front() == LimitAnswer::static_failure) continue; // no capacity of an earthquake
        CapacityBracket& bracket = brackets.emplace_back();
        const auto first = std::find(answers.begin(), answers.end(), LimitAnswer::fails);
        if (first == answers.end()) continue;
        const auto place = static_cast<std::size_t>(first - answers.begin());
        bracket.first = curve[place];
        if (place > 0) bracket.below = curve[place - 1];
        bracket.came_back = std::find(first, answers.end(), LimitAnswer::survives) != answers.end();
    }
    return brackets;
}

double LimitEstimate::missing_share() const
{
    double n = 0.0, missing = 0.0;
    for (const LevelEstimate& level : levels) {
        n += level.n;
        missing += level.missing;
    }
    return n > 0.0 ? missing / n : 0.0;
}

std::size_t level_nearest(const std::vector<LevelEstimate>& levels, double p)
{
    const auto far = [p](const LevelEstimate& level) { return std::abs(level.p - p); };
    return static_cast<std::size_t>(std::ranges::min_element(levels, {}, far) - levels.begin());
}

RunCount count_of(bool stands, double fails, StaticFailure rule, double times)
{
    RunCount c;
    const bool counted = stands || rule == StaticFailure::infinite;
    c.n = counted ? times : 0.0;
    c.z = times * (stands ? fails : rule == StaticFailure::infinite ? 1.0 : 0.0);
    return c;
}

RunCount count_of(LimitAnswer answer, StaticFailure rule, double weight)
{
    RunCount c =
        count_of(answer != LimitAnswer::static_failure, answer == LimitAnswer::fails ? 1.0 : 0.0, rule, weight);
    if (answer == LimitAnswer::missing) c.missing = weight;
    return c;
}

LimitCounts::LimitCounts(const FragilityPlan& plan, std::size_t levels, std::size_t replicates)
    : inner_each_(plan.inner)
{
    Events events = events_of(plan.suite);
    const std::size_t inners = plan.epistemic && !plan.whole_suite ? replicates * plan.inner : 0;
    all.resize(levels);
    replicate.assign(levels, std::vector<RunCount>(replicates));
    cluster.assign(levels, std::vector<RunCount>(events.count));
    outer.assign(levels, std::vector<RunCount>(replicates * plan.outer));
    inner.assign(levels, std::vector<RunCount>(inners));
    event_of_ = std::move(events.of_record);
}

void LimitCounts::add(const FragilitySample& s, std::size_t level, std::size_t replicate_of_run, const RunCount& c)
{
    all[level].add(c);
    replicate[level][replicate_of_run].add(c);
    cluster[level][event_of_[s.record]].add(c);
    outer[level][s.outer].add(c);
    if (!inner[level].empty()) inner[level][replicate_of_run * inner_each_ + s.inner].add(c);
}

LevelEstimate estimate_first(const FragilityPlan& plan, const FragilityRuns& runs, const LimitInput& limit,
                             std::size_t level, std::size_t replicates,
                             const std::function<bool(const FragilitySample&, std::size_t place)>& kept)
{
    LimitCounts counts(plan, 1, replicates);
    std::size_t place = 0;
    for (std::size_t id = 0; id < plan.samples.size(); ++id) {
        const FragilitySample s = plan.samples[id];
        if (s.level != level) continue;
        if (!kept(s, place++)) break;
        counts.add(s, 0, s.replicate,
                   count_of(answer_to(limit, runs.rows[id]), plan.input.probability.static_failure, s.weight));
    }
    return estimate_level(plan, counts, 0, plan.input.intensity.levels[level], false);
}

FragilityEstimate estimate_fragility(const FragilityPlan& plan, const FragilityRuns& runs,
                                     const probability::HazardCurve* hazard, std::optional<double> all_events,
                                     const ConditionedPlan* conditioned)
{
    FragilityEstimate estimate;
    estimate.clusters = events_of(plan.suite).count;
    std::vector<char> draw_counted(plan.draws.size());
    std::size_t draws = 0, fallen = 0;
    for (std::size_t id = 0; id < plan.samples.size(); ++id) {
        const std::optional<FinishedRow> row = runs.rows[id];
        ++estimate.statuses[row ? row->results.status : word(Status::interrupted)];
        const std::optional<Status> status = row ? status_of(*row) : std::nullopt;
        if (!status || draw_counted[plan.samples[id].draw]++) continue;
        ++draws;
        fallen += fails_statically(*status);
    }
    estimate.p_static = conditioned ? static_share(*conditioned, runs)
                        : draws     ? static_cast<double>(fallen) / static_cast<double>(draws)
                                    : 0.0;
    const FragilityDesign design = plan.input.intensity.design;
    for (const LimitInput& wanted : plan.input.limits) {
        LimitEstimate& limit = estimate.limits.emplace_back();
        limit.limit = wanted;
        const LimitCounts counts =
            conditioned ? counts_of(*conditioned, runs, estimate.limits.size() - 1) : count_limit(plan, runs, wanted);
        if (design == FragilityDesign::cloud) {
            fit_cloud_of(plan, runs, limit);
            continue;
        }
        std::vector<probability::StripeCount> stripes;
        for (std::size_t level = 0; level < plan.levels; ++level) {
            limit.levels.push_back(
                estimate_level(plan, counts, level, plan.input.intensity.levels[level], conditioned != nullptr));
            const LevelEstimate& e = limit.levels.back();
            const double n = conditioned ? runs_of_same_error(plan, e) : e.n;
            // All runs of one epistemic draw hang together: they count as one.
            const double counted = plan.epistemic ? std::min(n, static_cast<double>(plan.replicates * plan.outer)) : n;
            stripes.push_back({e.x, counted, e.p * counted});
        }
        limit.fit = probability::fit_lognormal(stripes);
        if (limit.fit.method != probability::FitMethod::none)
            for (LevelEstimate& level : limit.levels) level.fitted = limit.fit.curve.probability(level.x);
        if (design == FragilityDesign::ida) find_capacities(plan, runs, limit);
        if (hazard) limit.rate = rate_of(plan, limit, counts, *hazard, all_events);
    }
    return estimate;
}

} // namespace damslip
