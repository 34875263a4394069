#include "analysis/fragility/two_level_runs.hpp"

#include "analysis/sweep/sweep_rows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace damslip {

namespace {

/// What the rigid block says of a sample. Of a block that slides without end, or off its base: a slip far beyond the limit.
std::vector<double> features(const FragilityPlan& plan, const FragilityRuns& runs, const LimitInput& limit,
                             std::size_t id)
{
    constexpr double beyond = 1e4; // limits
    const FragilitySample& s = plan.samples[id];
    const LimitAnswer answer = answer_to(limit, runs.rows[id]);
    if (answer == LimitAnswer::missing) return {std::numeric_limits<double>::quiet_NaN(), 0.0};
    const RowResults r = runs.rows[id]->results;
    const double slip =
        std::abs((limit.quantity == LimitQuantity::slip ? r.slip : r.max_slip).value_or(beyond * limit.value));
    return {std::asinh(std::min(slip / limit.value, beyond)), runs.yield[s.draw] / s.factor};
}

/// What samples share: the event of their record. Of few events each sample is taken by itself: folds of them would teach the cheap model
/// nothing, and P is that of this suite alone.
class SampleClusters {
public:
    explicit SampleClusters(const ShakingSuite& suite)
    {
        constexpr std::size_t least_events = 10;
        std::set<std::size_t> events;
        for (const std::string& event : suite.event) {
            of_record_.push_back(static_cast<std::size_t>(std::find(suite.event.begin(), suite.event.end(), event) -
                                                          suite.event.begin()));
            events.insert(of_record_.back());
        }
        by_event_ = events.size() >= least_events;
    }
    /// @param number  of the sample, among all of both models
    std::size_t of(std::size_t record, std::size_t number) const { return by_event_ ? of_record_[record] : number; }

private:
    std::vector<std::size_t> of_record_;
    bool by_event_ = false;
};

double share_of_failures(LimitAnswer answer, bool missing_fails)
{
    return answer == LimitAnswer::fails || answer == LimitAnswer::static_failure ||
                   (missing_fails && answer == LimitAnswer::missing)
               ? 1.0
               : 0.0;
}

} // namespace

TwoLevelFragility estimate_two_level(const FragilityPlan& plan, const FragilityRuns& dear,
                                     const FragilityRuns& dear_rigid, const FragilityPlan& cheap_plan,
                                     const FragilityRuns& cheap)
{
    constexpr double least_of_a_kind = 10.0;
    const bool standing = plan.input.probability.static_failure == StaticFailure::given_standing;
    const SampleClusters clusters(plan.suite);
    TwoLevelFragility result;
    const auto per_run = [](const FragilityRuns& runs) {
        const std::size_t n = runs.finished() - runs.found;
        return n ? runs.seconds / static_cast<double>(n) : 0.0;
    };
    result.dear_seconds = per_run(dear);
    result.cheap_seconds = per_run(cheap);
    const auto answer = [](const LimitInput& limit, const FragilityRuns& runs, std::size_t id) {
        return answer_to(limit, runs.rows[id]);
    };
    for (const LimitInput& limit : plan.input.limits) {
        TwoLevelLimit& of_limit = result.limits.emplace_back();
        of_limit.limit = limit;
        for (std::size_t level = 0; level < plan.levels; ++level) {
            TwoLevelAtLevel& at = of_limit.levels.emplace_back();
            at.x = plan.input.intensity.levels[level];
            std::vector<probability::DearSample> low, high;
            double failures = 0.0;
            for (std::size_t id = 0; id < plan.samples.size(); ++id) {
                if (plan.samples[id].level != level) continue;
                const LimitAnswer fe = answer(limit, dear, id), rigid = answer(limit, dear_rigid, id);
                if (&limit == &plan.input.limits.front())
                    result.disagree += (fe == LimitAnswer::static_failure) != (rigid == LimitAnswer::static_failure);
                if (standing && fe == LimitAnswer::static_failure) continue;
                const std::size_t cluster = clusters.of(plan.samples[id].record, id);
                low.push_back({cluster, share_of_failures(fe, false), features(plan, dear_rigid, limit, id)});
                high.push_back({cluster, share_of_failures(fe, true), low.back().cheap});
                failures += low.back().f;
            }
            std::vector<probability::CheapSample> others;
            for (std::size_t id = 0; id < cheap_plan.samples.size(); ++id) {
                if (cheap_plan.samples[id].level != level) continue;
                if (standing && answer(limit, cheap, id) == LimitAnswer::static_failure) continue;
                others.push_back({clusters.of(cheap_plan.samples[id].record, plan.samples.size() + id),
                                  features(cheap_plan, cheap, limit, id)});
            }
            at.dear = low.size();
            at.cheap = others.size();
            const auto n = static_cast<double>(low.size());
            if (failures < least_of_a_kind || n - failures < least_of_a_kind) {
                at.why_not = "fewer than 10 failures, or 10 survivals, by finite elements";
                continue;
            }
            const std::uint64_t seed = plan.input.probability.seed;
            at.low = probability::two_level(low, others, seed);
            at.high = probability::two_level(high, others, seed);
            at.used = at.low.used || at.high.used;
            if (!at.used) {
                at.why_not = at.low.sentence;
                continue;
            }
            const double p = std::clamp(at.low.p, 1.0 / (2.0 * n), 1.0 - 1.0 / (2.0 * n));
            const double spent =
                n * (result.dear_seconds + result.cheap_seconds) + static_cast<double>(at.cheap) * result.cheap_seconds;
            const double plain_runs = result.dear_seconds > 0.0 ? spent / result.dear_seconds : n;
            at.speed_up = at.low.se > 0.0 ? p * (1.0 - p) / plain_runs / (at.low.se * at.low.se) : 1.0;
        }
    }
    return result;
}

} // namespace damslip
