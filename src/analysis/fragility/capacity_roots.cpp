#include "analysis/fragility/capacity_roots.hpp"

#include "analysis/sweep/sweep_rows.hpp"
#include "core/parallel.hpp"
#include "sliding/block/slide_batch.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

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

bool draws_the_way_of_sliding(const FragilityPlan& plan)
{
    for (const RandomVariable& v : plan.variables())
        for (const std::string& key : v.keys)
            if (key.starts_with("sliding.") || key.starts_with("motion.")) return true;
    return false;
}

} // namespace

bool capacities_by_roots(FragilityEstimate& estimate, const FragilityPlan& plan, const FragilityRuns& runs,
                         const SceneText& text, const SweepMethod& method, int jobs)
{
    const Scene scene = text.scene();
    if (plan.input.intensity.design != FragilityDesign::ida || method.kind != SweepKind::rigid ||
        scene.sliding.two_way || draws_the_way_of_sliding(plan))
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

} // namespace damslip
