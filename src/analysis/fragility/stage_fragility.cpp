#include "analysis/fragility/stage_fragility.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace damslip {

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
