#include "analysis/fragility/mfmc_runs.hpp"

#include "analysis/sweep/sweep_rows.hpp"
#include "probability/estimate/allocation.hpp"
#include "probability/estimate/calibration.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace damslip {

namespace {

constexpr std::uint32_t further_stream = 3, mfmc_pilot_stream = 4; // of FragilitySizes

/// Samples that hang together: one run, or all runs of an epistemic draw at one level.
using SampleUnit = std::vector<std::size_t>;

std::vector<SampleUnit> units_at(const FragilityPlan& plan, std::size_t level)
{
    std::vector<SampleUnit> units;
    std::map<std::size_t, std::size_t> place; // of the epistemic draw
    for (std::size_t id = 0; id < plan.samples.size(); ++id) {
        const FragilitySample& s = plan.samples[id];
        if (s.level != level) continue;
        const auto [at, fresh] = place.emplace(plan.epistemic ? s.outer : id, units.size());
        if (fresh) units.emplace_back();
        units[at->second].push_back(id);
    }
    return units;
}

/// Answers of one model to the samples of one plan; none where it was not run.
struct ModelRuns {
    const FragilityPlan* plan = nullptr;
    const FragilityRuns* runs = nullptr;

    LimitAnswer answer(const LimitInput& limit, std::size_t id) const
    {
        return answer_to(limit, runs->rows[id]);
    }
    bool stands(const LimitInput& limit, std::size_t id) const
    {
        return answer(limit, id) != LimitAnswer::static_failure;
    }
    /// What a cheap model says of a sample: its slip over the limit, of a rigid block its yield over the factor on the record, too. A NaN: nothing.
    std::vector<double> words(const LimitInput& limit, std::size_t id) const
    {
        constexpr double beyond = 1e4; // limits: a slip without end, or off the base
        const FragilitySample& s = plan->samples[id];
        const double yield = runs->yield[s.draw];
        const bool has_yield = std::any_of(runs->yield.begin(), runs->yield.end(), [](double y) { return y == y; });
        std::vector<double> words{std::numeric_limits<double>::quiet_NaN()};
        if (has_yield) words.push_back(yield / s.factor);
        if (answer(limit, id) == LimitAnswer::missing) return words;
        const RowResults r = runs->rows[id]->results;
        const double slip =
            std::abs((limit.quantity == LimitQuantity::slip ? r.slip : r.max_slip).value_or(beyond * limit.value));
        words.front() = std::asinh(std::min(slip / limit.value, beyond));
        return words;
    }
};

/// Runs of a unit that count.
SampleUnit counted(const SampleUnit& unit, const ModelRuns& judge, const LimitInput& limit, StaticFailure rule)
{
    SampleUnit kept;
    for (const std::size_t id : unit)
        if (rule == StaticFailure::infinite || judge.stands(limit, id)) kept.push_back(id);
    return kept;
}

double failures_of(const SampleUnit& unit, const ModelRuns& dear, const LimitInput& limit, bool missing_fails)
{
    double sum = 0.0;
    for (const std::size_t id : unit) {
        const LimitAnswer a = dear.answer(limit, id);
        sum +=
            a == LimitAnswer::fails || a == LimitAnswer::static_failure || (missing_fails && a == LimitAnswer::missing);
    }
    return sum / static_cast<double>(unit.size());
}

double prediction_of(const SampleUnit& unit, const ModelRuns& cheap, const LimitInput& limit,
                     const probability::Calibration& h)
{
    double sum = 0.0;
    for (const std::size_t id : unit) sum += h(cheap.words(limit, id));
    return sum / static_cast<double>(unit.size());
}

/// What the pilot says of one limit at one level.
struct PilotOfLevel {
    std::vector<probability::Calibration> calibrations;   ///< of the cheap models
    std::vector<probability::ModelStatistics> statistics; ///< the dear model first
    probability::MfmcPlan plan;                           ///< models and weights; sizes are ratios
    double seconds = 0.0;                                 ///< of its runs by all models, at this level
    std::string why_not;                                  ///< empty: it can be used
};

constexpr double ratio_scale = 1e7; // budget of the plan in dear runs, so that whole sizes give ratios

PilotOfLevel learn(const ModelRuns& dear, const std::vector<ModelRuns>& cheap, const std::vector<double>& seconds,
                   const LimitInput& limit, std::size_t level)
{
    constexpr double least_of_a_kind = 3.0;
    const StaticFailure rule = dear.plan->input.probability.static_failure;
    PilotOfLevel pilot;
    std::vector<SampleUnit> units;
    for (const SampleUnit& unit : units_at(*dear.plan, level))
        if (SampleUnit kept = counted(unit, dear, limit, rule); !kept.empty()) units.push_back(std::move(kept));
    std::vector<double> f, by_run;
    for (const SampleUnit& unit : units) {
        f.push_back(failures_of(unit, dear, limit, false));
        for (const std::size_t id : unit) by_run.push_back(failures_of({id}, dear, limit, false));
    }
    for (const double s : seconds) pilot.seconds += s * static_cast<double>(by_run.size());
    double failures = 0.0;
    for (const double v : by_run) failures += v;
    if (failures < least_of_a_kind || static_cast<double>(by_run.size()) - failures < least_of_a_kind) {
        pilot.why_not = "fewer than 3 failures, or 3 survivals, in the pilot";
        return pilot;
    }
    const double per_unit = static_cast<double>(by_run.size()) / static_cast<double>(units.size());
    pilot.statistics = {{seconds[0] * per_unit, std::sqrt(probability::variance_of(f)), 1.0}};
    for (std::size_t m = 0; m < cheap.size(); ++m) {
        std::vector<std::vector<double>> words;
        for (const SampleUnit& unit : units)
            for (const std::size_t id : unit) words.push_back(cheap[m].words(limit, id));
        std::vector<const std::vector<double>*> places;
        for (const std::vector<double>& w : words) places.push_back(&w);
        const probability::Calibration& h = pilot.calibrations.emplace_back(probability::calibrate(places, by_run));
        std::vector<double> g;
        for (const SampleUnit& unit : units) g.push_back(prediction_of(unit, cheap[m], limit, h));
        const double rho = probability::less_chance(probability::correlation(f, g), f.size(), words.front().size()),
                     sigma = std::sqrt(probability::variance_of(g));
        // A model that tells nothing has no correlation: it is kept in its place with one that no plan takes.
        const bool tells = std::isfinite(rho) && rho > 0.0 && sigma > 0.0;
        pilot.statistics.push_back(
            {seconds[m + 1] * per_unit, tells ? sigma : 1.0, tells ? std::min(rho, 1.0 - 1e-6) : 0.0});
    }
    if (!(pilot.statistics[0].sigma > 0.0)) {
        pilot.why_not = "the draws of the pilot do not differ";
        return pilot;
    }
    pilot.plan = probability::plan_mfmc(pilot.statistics, ratio_scale * pilot.statistics[0].cost);
    // The chain is believed where one of its cheap models alone is sure to pay; else it is off, and the best of all cheap models says why.
    std::optional<probability::PilotDecision> best;
    bool sure = false;
    for (std::size_t m = 1; m < pilot.statistics.size(); ++m) {
        const auto gain = [&](double rho) {
            return probability::two_level_speed_up(rho, pilot.statistics[0].cost, pilot.statistics[m].cost);
        };
        probability::PilotDecision decision = probability::decide_on_pilot(units.size(), pilot.statistics[m].rho, gain);
        const auto& used = pilot.plan.models;
        sure = sure || (decision.use && std::find(used.begin(), used.end(), m) != used.end());
        if (!best || decision.speed_up_lower > best->speed_up_lower) best = std::move(decision);
    }
    if (!sure && best) pilot.why_not = best->use ? "off: no chain of these models pays" : best->sentence;
    return pilot;
}

FragilityRuns run_all_of(const FragilityPlan& plan, const SampleIds& wanted, const std::string& method,
                         const SceneText& text, int jobs, Watch& watch)
{
    return run_fragility(plan, text, sweep_method(method), wanted, nullptr, jobs, watch);
}

double seconds_per_run(const FragilityRuns& runs)
{
    const std::size_t n = runs.finished() - runs.found;
    return n ? runs.seconds / static_cast<double>(n) : 0.0;
}

/// The units of all levels that come first in their level, as ids.
std::vector<std::size_t> first_units(const FragilityPlan& plan, std::size_t count)
{
    std::vector<std::size_t> ids;
    for (std::size_t level = 0; level < plan.levels; ++level) {
        const std::vector<SampleUnit> units = units_at(plan, level);
        for (std::size_t u = 0; u < std::min(count, units.size()); ++u)
            ids.insert(ids.end(), units[u].begin(), units[u].end());
    }
    std::sort(ids.begin(), ids.end());
    return ids;
}

/// The answers of the chain to one limit at one level, sample by sample and nested.
MfmcAtLevel estimate_level_by_mfmc(const PilotOfLevel& pilot, const ModelRuns& dear,
                                   const std::vector<ModelRuns>& beside, const std::vector<ModelRuns>& further,
                                   const std::vector<std::size_t>& further_units, const LimitInput& limit,
                                   std::size_t level)
{
    const StaticFailure rule = dear.plan->input.probability.static_failure;
    MfmcAtLevel at;
    probability::MfmcPlan plan = pilot.plan;
    plan.sizes.assign(plan.models.size(), 0);
    std::vector<std::vector<double>> low(plan.models.size()); // by model, nested
    double missing = 0.0;
    for (const SampleUnit& unit : units_at(*dear.plan, level)) {
        const SampleUnit kept = counted(unit, dear, limit, rule);
        if (kept.empty()) continue;
        low[0].push_back(failures_of(kept, dear, limit, false));
        for (std::size_t j = 1; j < plan.models.size(); ++j) {
            const std::size_t m = plan.models[j] - 1;
            low[j].push_back(prediction_of(kept, beside[m], limit, pilot.calibrations[m]));
        }
        missing += failures_of(kept, dear, limit, true) - low[0].back();
    }
    const std::vector<SampleUnit> others = units_at(*further.back().plan, level);
    for (std::size_t u = 0; u < others.size(); ++u) {
        const SampleUnit kept = counted(others[u], further.back(), limit, rule); // the cheapest model has them all
        if (kept.empty()) continue;
        for (std::size_t j = 1; j < plan.models.size(); ++j) {
            const std::size_t m = plan.models[j] - 1;
            if (u < further_units[m]) low[j].push_back(prediction_of(kept, further[m], limit, pilot.calibrations[m]));
        }
    }
    for (std::size_t j = 0; j < plan.models.size(); ++j) plan.sizes[j] = low[j].size();
    if (plan.sizes[0] < 2) {
        at.why_not = "fewer than two draws stand";
        return at;
    }
    at.low = at.high = probability::mfmc_with_error(plan, low);
    if (missing > 0.0) {
        std::vector<std::vector<double>> high = low;
        high[0].clear();
        for (const SampleUnit& unit : units_at(*dear.plan, level))
            if (const SampleUnit kept = counted(unit, dear, limit, rule); !kept.empty())
                high[0].push_back(failures_of(kept, dear, limit, true));
        at.high = probability::mfmc_with_error(plan, high);
    }
    at.used = true;
    for (std::size_t j = 0; j < plan.models.size(); ++j) {
        MfmcModel& model = at.models.emplace_back();
        model.rho = pilot.statistics[plan.models[j]].rho;
        model.weight = plan.weights[j];
        model.runs = plan.sizes[j];
    }
    const double plain = probability::variance_of(low[0]);
    const double dear_cost = pilot.statistics[0].cost;
    for (std::size_t j = 0; j < plan.models.size(); ++j)
        at.spent += static_cast<double>(plan.sizes[j]) * pilot.statistics[plan.models[j]].cost;
    at.spent += pilot.seconds;
    at.speed_up = at.low.se > 0.0 ? plain / (at.spent / dear_cost) / (at.low.se * at.low.se) : 1.0;
    return at;
}

/// How many further units each cheap model gets: the most that any limit and level needs.
std::vector<std::size_t> further_units_of(const std::vector<std::vector<PilotOfLevel>>& pilots,
                                          std::size_t cheap_models, double dear_units, std::size_t most)
{
    std::vector<std::size_t> further(cheap_models, 0);
    for (const std::vector<PilotOfLevel>& of_limit : pilots)
        for (const PilotOfLevel& pilot : of_limit) {
            if (!pilot.why_not.empty()) continue;
            for (std::size_t j = 1; j < pilot.plan.models.size(); ++j) {
                const double ratio =
                    static_cast<double>(pilot.plan.sizes[j]) / static_cast<double>(pilot.plan.sizes[0]);
                const double wanted = std::min(std::ceil((ratio - 1.0) * dear_units), static_cast<double>(most));
                std::size_t& size = further[pilot.plan.models[j] - 1];
                size = std::max(size, static_cast<std::size_t>(wanted));
            }
        }
    for (std::size_t m = 1; m < cheap_models; ++m) further[m] = std::max(further[m], further[m - 1]); // nested
    return further;
}

} // namespace

MfmcFragility run_mfmc(const FragilityPlan& plan, const FragilityRuns& dear, const PlanOfStream& plan_of,
                       const SceneText& text, const MfmcOptions& options, Watch& watch)
{
    MfmcFragility result;
    const FragilityPlan pilot_plan = plan_of(options.pilot, mfmc_pilot_stream);
    result.pilot = pilot_plan.samples.size() / std::max<std::size_t>(1, pilot_plan.levels);
    std::vector<FragilityRuns> pilot_runs, beside_runs, further_runs;
    const auto told = [](const FragilityPlan& p, const std::vector<FragilityRuns>& runs) {
        std::vector<ModelRuns> models;
        for (const FragilityRuns& r : runs) models.push_back({&p, &r});
        return models;
    };
    const auto run = [&](const FragilityPlan& p, const SampleIds& wanted, const std::string& method) {
        FragilityRuns runs = run_all_of(p, wanted, method, text, options.jobs, watch);
        result.seconds += runs.seconds;
        return runs;
    };
    const FragilityRuns pilot_dear = run(pilot_plan, wanted_samples(pilot_plan), options.dear);
    std::vector<double> seconds{seconds_per_run(pilot_dear)};
    constexpr std::size_t few = 4;
    constexpr double dearest_middle = 0.5; // of a dear run
    std::vector<std::string> cheap;
    for (const std::string& method : options.cheap) {
        if (&method != &options.cheap.back() && !options.cheap_price) {
            const double price = seconds_per_run(run(pilot_plan, first_units(pilot_plan, few), method));
            if (price > dearest_middle * seconds.front()) {
                result.left_out.push_back(fmt::format("{} was left out: {:.2g} s a run beside {:.2g} s of {}", method,
                                                      price, seconds.front(), options.dear));
                continue;
            }
        }
        cheap.push_back(method);
    }
    for (const std::string& method : cheap) {
        pilot_runs.push_back(run(pilot_plan, wanted_samples(pilot_plan), method));
        seconds.push_back(options.cheap_price ? *options.cheap_price * seconds.front()
                                              : seconds_per_run(pilot_runs.back()));
    }
    std::vector<std::vector<PilotOfLevel>> pilots;
    for (const LimitInput& limit : plan.input.limits) {
        std::vector<PilotOfLevel>& of_limit = pilots.emplace_back();
        for (std::size_t level = 0; level < plan.levels; ++level)
            of_limit.push_back(learn({&pilot_plan, &pilot_dear}, told(pilot_plan, pilot_runs), seconds, limit, level));
    }
    const std::size_t dear_units = units_at(plan, 0).size(), runs_of_unit = units_at(plan, 0).front().size();
    const std::vector<std::size_t> further =
        further_units_of(pilots, cheap.size(), static_cast<double>(dear_units), options.most_cheap);
    const FragilityPlan further_plan = plan_of(std::max<std::size_t>(1, further.back() * runs_of_unit), further_stream);
    for (std::size_t m = 0; m < cheap.size(); ++m) {
        const bool asked = further[m] > 0; // by some level; else no answer of it is needed
        beside_runs.push_back(run(plan, asked ? wanted_samples(plan) : SampleIds(), cheap[m]));
        further_runs.push_back(run(further_plan, first_units(further_plan, further[m]), cheap[m]));
    }
    for (std::size_t l = 0; l < plan.input.limits.size(); ++l) {
        MfmcLimit& of_limit = result.limits.emplace_back();
        of_limit.limit = plan.input.limits[l];
        for (std::size_t level = 0; level < plan.levels; ++level) {
            MfmcAtLevel at;
            if (pilots[l][level].why_not.empty())
                at = estimate_level_by_mfmc(pilots[l][level], {&plan, &dear}, told(plan, beside_runs),
                                            told(further_plan, further_runs), further, of_limit.limit, level);
            else
                at.why_not = pilots[l][level].why_not;
            for (std::size_t j = 0; j < at.models.size(); ++j) {
                const std::size_t model = pilots[l][level].plan.models[j];
                at.models[j].method = model == 0 ? options.dear : cheap[model - 1];
                at.models[j].seconds = seconds[model];
            }
            at.x = plan.input.intensity.levels[level];
            of_limit.levels.push_back(std::move(at));
        }
    }
    return result;
}

} // namespace damslip
