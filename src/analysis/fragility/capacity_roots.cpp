#include "analysis/fragility/capacity_roots.hpp"

#include "analysis/sweep/sweep_grid.hpp"
#include "core/parallel.hpp"
#include "core/statistics.hpp"
#include "core/units.hpp"
#include "probability/distribution.hpp"
#include "probability/sampling.hpp"
#include "sliding/block/slide_batch.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <memory>
#include <tuple>

namespace damslip {

namespace {

/// Slip of the one-way block of this yield under k times the motion [m].
double slip_at_factor(const sliding::SkippingMotion& motion, double yield, double factor)
{
    return factor * sliding::slide_constant_yield(motion, {yield / factor}).slip;
}

/// The factor with D = d in (low, high], D(high) > d. Bisection: D is continuous, but flat below the yield.
double factor_with_slip(const sliding::SkippingMotion& motion, double yield, double slip, double low, double high)
{
    while (high - low > 1e-12 * high) {
        const double middle = 0.5 * (low + high);
        if (middle <= low || middle >= high) break;
        (slip_at_factor(motion, yield, middle) > slip ? high : low) = middle;
    }
    return 0.5 * (low + high);
}

/// Yields of all draws. Rows from a store come without: one sample of each such draw is run again.
std::vector<double> yields_of_draws(const FragilityPlan& plan, const FragilityRuns& runs, const SceneText& text,
                                    const SweepMethod& method, int jobs)
{
    std::vector<double> yields = runs.yield;
    std::vector<char> asked(yields.size());
    std::vector<std::size_t> again;
    for (std::size_t id = 0; id < plan.samples.size(); ++id) {
        const std::size_t draw = plan.samples[id].draw;
        if (!std::isnan(yields[draw]) || asked[draw]) continue;
        asked[draw] = 1;
        again.push_back(id);
    }
    if (again.empty()) return yields;
    Watch watch;
    const FragilityRuns repeated = run_fragility(plan, text, method, again, nullptr, jobs, watch);
    for (std::size_t draw = 0; draw < yields.size(); ++draw)
        if (asked[draw]) yields[draw] = repeated.yield[draw];
    return yields;
}

} // namespace

bool capacities_by_roots(FragilityEstimate& estimate, const FragilityPlan& plan, const FragilityRuns& runs,
                         const SceneText& text, const SweepMethod& method, int jobs)
{
    const Scene scene = text.scene();
    if (plan.input.intensity.design != FragilityDesign::ida || method.kind != SweepKind::rigid ||
        scene.sliding.two_way || plan.draws_key("sliding.") || plan.draws_key("motion."))
        return false;
    const std::vector<double> yields = yields_of_draws(plan, runs, text, method, jobs);
    const Ready base = prepare(scene, Method::rigid_block, plan.suite.pairs);
    std::map<std::pair<std::size_t, int>, std::unique_ptr<const sliding::SkippingMotion>> motions;
    for (const FragilitySample& s : plan.samples)
        if (auto& motion = motions[{s.record, s.polarity}]; !motion)
            motion = std::make_unique<const sliding::SkippingMotion>(
                horizontal_only(base.motion((*plan.suite.pairs)[s.record], 1.0, s.polarity)));
    for (LimitEstimate& limit : estimate.limits) {
        if (!is_of_slip(limit.limit)) continue;
        const std::vector<CapacityBracket> brackets = capacity_brackets(plan, runs, limit.limit);
        std::vector<double> capacity(brackets.size());
        std::vector<char> by_root(brackets.size());
        parallel_for(brackets.size(), jobs, [&](std::size_t i) {
            if (!brackets[i].first) return;
            const FragilitySample s = plan.samples[*brackets[i].first];
            const double below = brackets[i].below ? plan.samples[*brackets[i].below].factor : 0.0;
            const double yield = yields[s.draw];
            const sliding::SkippingMotion& motion = *motions.at({s.record, s.polarity});
            capacity[i] = s.x;
            const std::optional<double> ran = runs.rows[*brackets[i].first]->results.slip;
            if (!ran || !(yield > 0.0)) return;
            const double slip = slip_at_factor(motion, yield, s.factor);
            if (!(std::abs(slip - *ran) <= 1e-9 * slip && slip > limit.limit.value)) return;
            const double factor = factor_with_slip(motion, yield, limit.limit.value, below, s.factor);
            capacity[i] = plan.suite.intensity[s.record] * std::pow(factor, plan.suite.power);
            by_root[i] = 1;
        });
        std::vector<double> reached, censored;
        std::size_t roots = 0;
        for (std::size_t i = 0; i < brackets.size(); ++i) {
            roots += static_cast<std::size_t>(by_root[i]);
            if (brackets[i].first)
                reached.push_back(capacity[i]);
            else
                censored.push_back(plan.input.intensity.levels.back());
        }
        limit.capacity_roots = roots;
        limit.capacities = probability::fit_capacities(reached, censored);
    }
    return true;
}

namespace {

/// A plan of given draws at one level, each under the whole suite.
FragilityPlan whole_suite_at(const FragilityPlan& plan, std::size_t level, std::vector<FragilityDraw> draws)
{
    std::map<std::pair<std::size_t, int>, FragilitySample> ways; // of shaking
    for (const FragilitySample& s : plan.samples)
        if (s.level == level) ways.emplace(std::pair(s.record, s.polarity), s);
    FragilityPlan p = plan;
    p.samples.clear();
    for (std::size_t d = 0; d < draws.size(); ++d)
        for (auto [way, sample] : ways) {
            sample.draw = d;
            p.samples.push_back(sample);
        }
    p.draws = std::move(draws);
    return p;
}

/// P of each draw: the share of the suite under which it exceeds the limit, by the records' weights.
std::vector<double> probabilities(const FragilityPlan& p, const FragilityRuns& runs, const LimitInput& limit)
{
    std::vector<double> failing(p.draws.size()), all(p.draws.size());
    for (std::size_t id = 0; id < p.samples.size(); ++id) {
        const LimitAnswer answer = answer_to(limit, runs.rows[id]);
        const FragilitySample s = p.samples[id];
        const double weight = p.suite.weight[s.record];
        all[s.draw] += weight;
        if (answer == LimitAnswer::fails || answer == LimitAnswer::static_failure) failing[s.draw] += weight;
    }
    for (std::size_t d = 0; d < all.size(); ++d) failing[d] = all[d] > 0.0 ? failing[d] / all[d] : 0.0;
    return failing;
}

/// The copula of all variables, of both kinds: correlations are within one.
probability::GaussianCopula copula_of_all(const FragilityPlan& plan)
{
    std::vector<probability::RankCorrelation> pairs;
    const auto place = [&](const std::string& name) {
        std::size_t v = 0;
        while (v < plan.variables().size() && plan.variables()[v].name != name) ++v;
        return v;
    };
    for (const RankCorrelation& c : plan.input.probability.correlations)
        pairs.push_back({place(c.first), place(c.second), c.spearman});
    return {plan.variables().size(), pairs};
}

/// The shares of correlated variables. `answer` is asked for one draw at a time: once to list the draws, and once more, in the same order, with
/// their answers.
class ShapleyDraws {
public:
    ShapleyDraws(const FragilityPlan& plan, std::size_t rows)
        : copula_(copula_of_all(plan)), seed_(plan.input.probability.seed)
    {
        constexpr std::size_t least = 16, plain = 4; // draws of a subset; variables up to which all rows are drawn
        const std::size_t k = copula_.dimension();
        outer_ = static_cast<std::uint32_t>(k > plain ? std::max(least, (rows << plain) >> k) : std::max(least, rows));
    }
    std::vector<std::vector<double>> points() const
    {
        std::vector<std::vector<double>> points;
        effects(
            [&](std::span<const double> u) {
                points.emplace_back(u.begin(), u.end());
                return 0.0;
            },
            0);
        return points;
    }
    probability::ShapleyEffects of(std::span<const double> answers) const
    {
        std::size_t next = 0;
        return effects([&](std::span<const double>) { return answers[next++]; }, 500);
    }

private:
    template <class Answer>
    probability::ShapleyEffects effects(Answer answer, std::uint32_t bootstrap) const
    {
        return probability::shapley_effects(copula_, answer, outer_, 3, 0.0, seed_, bootstrap);
    }

    probability::GaussianCopula copula_;
    std::uint64_t seed_;
    std::uint32_t outer_ = 16;
};

} // namespace

std::optional<FragilityCauses> fragility_causes(const FragilityPlan& plan, const FragilityEstimate& estimate,
                                                const SceneText& text, const NumberInFile& written,
                                                const SweepMethod& rigid, std::size_t rows, int jobs, Watch& watch)
{
    const std::size_t k = plan.variables().size();
    if (k == 0 || estimate.limits.empty() || plan.input.intensity.design == FragilityDesign::cloud) return std::nullopt;
    FragilityCauses causes;
    causes.limit = estimate.limits.front().limit;
    causes.level = level_nearest(estimate.limits.front().levels, 0.5);
    const auto draw_at = [&](std::span<const double> u) { return draw_of(plan.input, u, text.file(), written); };
    std::vector<FragilityDraw> draws;

    // Bars first: medians, and one variable at its ends or at each of its words.
    std::vector<std::pair<std::size_t, std::string>> bar_draws;
    for (std::size_t v = 0; v < k; ++v) {
        const LawInput& law = plan.variables()[v].law;
        std::vector<double> u(k, 0.5);
        const auto put = [&](double at, const std::string& name) {
            u[v] = at;
            draws.push_back(draw_at(u));
            bar_draws.emplace_back(v, name);
        };
        if (law.name != "discrete") {
            put(0.05, "5 %");
            put(0.95, "95 %");
            continue;
        }
        double sum = 0.0, below = 0.0;
        for (const double w : law.weights) sum += w;
        for (std::size_t i = 0; i < law.values.size(); ++i) {
            put((below + 0.5 * law.weights[i]) / sum, text_of(law.values[i]));
            below += law.weights[i];
        }
    }

    // Two samples A and B, and A with one column of B each.
    const bool independent = plan.input.probability.correlations.empty();
    if (independent) {
        std::vector<std::string> names;
        for (const char* sample : {"A ", "B "})
            for (const RandomVariable& v : plan.variables()) names.push_back(sample + v.name);
        const probability::UnitPoints points(probability::Sampling::random, plan.input.probability.seed, names,
                                             static_cast<std::uint32_t>(rows));
        for (std::size_t column = 0; column < k + 2; ++column) // A, B, AB_1, ...
            for (std::size_t i = 0; i < rows; ++i) {
                std::vector<double> u;
                for (std::size_t v = 0; v < k; ++v)
                    u.push_back(points(static_cast<std::uint32_t>(i), column == 1 || column == v + 2 ? k + v : v));
                draws.push_back(draw_at(u));
            }
    }
    std::optional<ShapleyDraws> shapley;
    if (!independent && k <= most_shapley)
        for (const std::vector<double>& u : shapley.emplace(plan, rows).points()) draws.push_back(draw_at(u));
    const FragilityPlan p = whole_suite_at(plan, causes.level, std::move(draws));
    const FragilityRuns runs = run_fragility(p, text, rigid, wanted_samples(p), nullptr, jobs, watch);
    if (!runs.complete()) return std::nullopt;
    causes.runs = p.samples.size();
    const std::vector<double> y = probabilities(p, runs, causes.limit);
    for (std::size_t b = 0; b < bar_draws.size(); ++b) {
        if (b == 0 || bar_draws[b].first != bar_draws[b - 1].first)
            causes.bars.push_back({plan.variables()[bar_draws[b].first].name, {}, {}});
        causes.bars.back().at.push_back(bar_draws[b].second);
        causes.bars.back().y.push_back(y[b]);
    }
    probability::order_tornado(causes.bars);
    if (shapley) {
        probability::ShapleyEffects effects = shapley->of(std::span(y).subspan(bar_draws.size()));
        if (effects.variance > 0.0) causes.shapley = std::move(effects);
    }
    if (independent) {
        const auto part = [&](std::size_t column) {
            const auto first = y.begin() + static_cast<std::ptrdiff_t>(bar_draws.size() + column * rows);
            return std::vector<double>(first, first + static_cast<std::ptrdiff_t>(rows));
        };
        std::vector<std::vector<double>> f_ab;
        for (std::size_t v = 0; v < k; ++v) f_ab.push_back(part(v + 2));
        const std::vector<double> f_a = part(0), f_b = part(1);
        if (*std::min_element(f_a.begin(), f_a.end()) < *std::max_element(f_a.begin(), f_a.end()))
            causes.shares = probability::sobol_indices(f_a, f_b, f_ab, 0.0, plan.input.probability.seed);
    }
    return causes;
}

std::vector<NeededYield> needed_yield(const FragilityPlan& plan, const SceneText& text, double slip)
{
    std::vector<NeededYield> needed;
    if (plan.input.intensity.design == FragilityDesign::cloud) return needed;
    const Ready base = prepare(text.scene(), Method::rigid_block, plan.suite.pairs);
    std::map<std::tuple<std::size_t, std::size_t, int>, double> factors; // of level, record, polarity
    for (const FragilitySample& s : plan.samples) factors.emplace(std::tuple(s.level, s.record, s.polarity), s.factor);
    for (std::size_t level = 0; level < plan.levels; ++level) {
        std::vector<double> k, weights;
        for (std::size_t r = 0; r < plan.suite.pairs->size(); ++r)
            for (const int polarity : {1, -1}) {
                const auto used = factors.find({level, r, polarity});
                if (used == factors.end()) continue;
                GroundMotion motion = horizontal_only(base.motion((*plan.suite.pairs)[r], used->second, polarity));
                double low = 0.0, high = 0.0;
                for (const double a : motion.accel_h) high = std::max(high, a);
                const sliding::SkippingMotion shaking(std::move(motion));
                for (int i = 0; i < 50; ++i) {
                    const double yield = 0.5 * (low + high);
                    (sliding::slide_constant_yield(shaking, {yield}).slip > slip ? low : high) = yield;
                }
                k.push_back(0.5 * (low + high) / units::standard_gravity);
                weights.push_back(plan.suite.weight[r]);
            }
        if (!k.empty())
            needed.push_back({plan.input.intensity.levels[level], percentile(k, weights, 0.16), percentile(k, weights, 0.5),
                              percentile(k, weights, 0.84)});
    }
    return needed;
}

namespace {

/// Runs at one water level.
struct StageCount {
    double n = 0.0, z = 0.0;
};

using StageCounts = std::map<double, StageCount>; // by level of the water

/// Of each limit and level.
std::vector<std::vector<StageCounts>> stage_counts(const FragilityPlan& plan, const FragilityRuns& runs,
                                                   std::size_t variable)
{
    const std::vector<LimitInput>& limits = plan.input.limits;
    std::vector<std::vector<StageCounts>> counts(limits.size(), std::vector<StageCounts>(plan.levels));
    for (std::size_t id = 0; id < plan.samples.size(); ++id) {
        const FragilitySample s = plan.samples[id];
        const KeyValue value = plan.draws[s.draw].values[variable];
        const auto* stage = std::get_if<double>(&value);
        if (!stage) continue;
        for (std::size_t l = 0; l < limits.size(); ++l) {
            const LimitAnswer answer = answer_to(limits[l], runs.rows[id]);
            const bool fallen = answer == LimitAnswer::static_failure;
            if (answer == LimitAnswer::missing ||
                (fallen && plan.input.probability.static_failure == StaticFailure::given_standing))
                continue;
            StageCount& count = counts[l][s.level][*stage];
            count.n += s.weight;
            if (fallen || answer == LimitAnswer::fails) count.z += s.weight;
        }
    }
    return counts;
}

std::optional<std::size_t> variable_of_the_level(const FragilityPlan& plan)
{
    for (std::size_t v = 0; v < plan.variables().size(); ++v) {
        const RandomVariable& variable = plan.variables()[v];
        if (variable.law.name == "discrete" && !variable.factor && variable.keys.front() == "reservoir.level_m")
            return v;
    }
    return std::nullopt;
}

/// Where a non-decreasing curve over rising stages reaches p: within the first and the last stage.
double stage_at(const std::vector<double>& stage, const std::vector<double>& curve, double p)
{
    if (p <= curve.front()) return stage.front();
    for (std::size_t i = 1; i < stage.size(); ++i)
        if (curve[i] >= p)
            return stage[i - 1] + (stage[i] - stage[i - 1]) * (p - curve[i - 1]) / (curve[i] - curve[i - 1]);
    return stage.back();
}

} // namespace

std::vector<double> non_decreasing(std::vector<double> y, const std::vector<double>& weight)
{
    struct Pool {
        double value, weight;
        std::size_t count;
    };
    std::vector<Pool> pools;
    for (std::size_t i = 0; i < y.size(); ++i) {
        pools.push_back({y[i], weight[i], 1});
        while (pools.size() > 1 && pools[pools.size() - 2].value > pools.back().value) {
            const Pool last = pools.back();
            pools.pop_back();
            Pool& before = pools.back();
            before.value = (before.value * before.weight + last.value * last.weight) / (before.weight + last.weight);
            before.weight += last.weight;
            before.count += last.count;
        }
    }
    y.clear();
    for (const Pool& pool : pools) y.insert(y.end(), pool.count, pool.value);
    return y;
}

std::vector<probability::UsaceLocation> stage_fragility(const FragilityPlan& plan, const FragilityRuns& runs)
{
    std::vector<probability::UsaceLocation> locations;
    const std::optional<std::size_t> variable = variable_of_the_level(plan);
    if (!variable || plan.input.intensity.design == FragilityDesign::cloud) return locations;
    const std::vector<std::vector<StageCounts>> counts_of = stage_counts(plan, runs, *variable);
    for (std::size_t l = 0; l < plan.input.limits.size(); ++l)
        for (std::size_t level = 0; level < plan.levels; ++level) {
            const LimitInput& limit = plan.input.limits[l];
            const StageCounts& counts = counts_of[l][level];
            if (counts.size() < 2) continue;
            std::vector<double> stage, p, lower, upper, n;
            for (const auto& [at, count] : counts) {
                const probability::Interval interval = probability::wilson(count.z, count.n);
                stage.push_back(at);
                p.push_back(count.z / count.n);
                lower.push_back(interval.lower);
                upper.push_back(interval.upper);
                n.push_back(count.n);
            }
            p = non_decreasing(p, n);
            lower = non_decreasing(lower, n);
            upper = non_decreasing(upper, n);
            probability::UsaceLocation place;
            place.location = fmt::format("{}, {} = {:.4g} {}", limit.text, plan.input.intensity.text,
                                         plan.input.intensity.levels[level] / plan.input.intensity.level_unit,
                                         plan.input.intensity.level_unit_text);
            double last = 0.0; // where nothing fails there is no stage of failure
            for (const double reached : p) {
                if (!(reached > last)) continue;
                last = reached;
                const double most_likely = stage_at(stage, p, reached);
                place.stages.push_back({reached, std::min(most_likely, stage_at(stage, upper, reached)), most_likely,
                                        std::max(most_likely, stage_at(stage, lower, reached))});
            }
            if (place.stages.size() > 1) locations.push_back(std::move(place));
        }
    return locations;
}

} // namespace damslip
