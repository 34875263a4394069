#include "analysis/fragility/fragility_causes.hpp"

#include "core/statistics.hpp"
#include "core/units.hpp"
#include "probability/laws/copula.hpp"
#include "probability/laws/distribution.hpp"
#include "probability/sampling/unit_points.hpp"
#include "sliding/block/slide_batch.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace damslip {

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

std::size_t level_near_one_half(const LimitEstimate& limit)
{
    const auto nearest =
        std::min_element(limit.levels.begin(), limit.levels.end(), [](const LevelEstimate& a, const LevelEstimate& b) {
            return std::abs(a.p - 0.5) < std::abs(b.p - 0.5);
        });
    return static_cast<std::size_t>(nearest - limit.levels.begin());
}

} // namespace

std::optional<FragilityCauses> fragility_causes(const FragilityPlan& plan, const FragilityEstimate& estimate,
                                                const SceneText& text, const NumberInFile& written,
                                                const SweepMethod& rigid, std::size_t rows, int jobs, Watch& watch)
{
    const std::size_t k = plan.variables().size();
    if (k == 0 || estimate.limits.empty() || plan.input.intensity.design == FragilityDesign::cloud) return std::nullopt;
    FragilityCauses causes;
    causes.limit = estimate.limits.front().limit;
    causes.level = level_near_one_half(estimate.limits.front());
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
        std::vector<double> k;
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
            }
        if (!k.empty())
            needed.push_back(
                {plan.input.intensity.levels[level], percentile(k, 0.16), percentile(k, 0.5), percentile(k, 0.84)});
    }
    return needed;
}

} // namespace damslip
