// Further answers of a fragility: shares of correlated variables, capacities by roots, P over the water level, curves as files.
//
// Ground: the pulse of fragility_test.cpp with flanks of length 0 but for one sample, A = 4 m/s^2. The block slides one way; its density does nothing,
// as a_y = mu g of a dry horizontal base.
#include "pulse_scene.hpp"

#include "analysis/fragility/capacity_roots.hpp"
#include "analysis/fragility/fragility_study.hpp"

#include "core/file.hpp"
#include "core/status.hpp"

#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <numbers>

namespace damslip {
namespace {

double number_of_the_file(const std::string&)
{
    return 1.0;
}

FragilityInput input_under_pulse(double limit, FragilityDesign design)
{
    FragilityInput input;
    input.probability.sampling = SamplingInput::latin_hypercube;
    input.probability.replicates = 4;
    input.suite = SuiteInput{};
    input.suite->polarity = SuitePolarity::as_recorded;
    input.intensity.design = design;
    input.intensity.levels = {pulse::accel};
    input.limits = {{LimitQuantity::slip, limit, "slip"}};
    return input;
}

FragilityRuns rigid_runs(const FragilityPlan& plan, const SceneText& text)
{
    Watch watch;
    return run_fragility(plan, text, sweep_method("rigid"), wanted_samples(plan), nullptr, 1, watch);
}

// Y = 1[mu < mu*], mu* the median of mu; the density does nothing, but hangs together with mu by r = 2 sin(pi 0.8 / 6). Var E[Y | density] =
// Phi_2(0, 0; r^2) - 1/4 = asin(r^2) / (2 pi) (Sheppard 1899), V = 1/4, so that the density takes half of 2 asin(r^2) / pi = 0.230 and mu the rest.
// Within twice the printed 95 % intervals; without correlation the density takes none.
TEST(FragilityAnswers, ShapleySharesOfCorrelatedVariables)
{
    const SceneText text = pulse::scene("", 0.3);
    FragilityInput input = input_under_pulse(pulse::slip(0.3, pulse::accel), FragilityDesign::stripes);
    input.probability.variables = {
        pulse::lognormal("mu", "contact.friction", 0.3, 0.2, VariableKind::aleatory),
        pulse::lognormal("density", "dam.density_kg_m3", 2400.0, 0.05, VariableKind::aleatory)};
    input.probability.correlations = {{"mu", "density", 0.8, {}}};
    const auto causes_of = [&](const FragilityInput& given) {
        const FragilityPlan plan = plan_fragility(given, pulse::suite(text), {256}, text.file(), number_of_the_file);
        const FragilityEstimate estimate = estimate_fragility(plan, rigid_runs(plan, text), nullptr, {});
        Watch watch;
        return fragility_causes(plan, estimate, text, number_of_the_file, sweep_method("rigid"), 256, 1, watch);
    };
    const std::optional<FragilityCauses> causes = causes_of(input);
    ASSERT_TRUE(causes && causes->shapley);
    EXPECT_FALSE(causes->shares.has_value());
    const std::vector<probability::Estimated>& shares = causes->shapley->shares;
    ASSERT_EQ(shares.size(), 2u);
    const double r = 2.0 * std::sin(std::numbers::pi * 0.8 / 6.0), of_density = std::asin(r * r) / std::numbers::pi;
    EXPECT_NEAR(shares[1].value, of_density, shares[1].upper - shares[1].lower);
    EXPECT_NEAR(shares[0].value, 1.0 - of_density, shares[0].upper - shares[0].lower);
    EXPECT_NEAR(shares[0].value + shares[1].value, 1.0, 1e-12);
    EXPECT_LT(shares[1].upper - shares[1].lower, 0.2); // or the comparison would say nothing
    EXPECT_GT(shares[1].lower, 0.05);
    input.probability.correlations.clear();
    const std::optional<FragilityCauses> independent = causes_of(input);
    ASSERT_TRUE(independent && independent->shares);
    EXPECT_FALSE(independent->shapley.has_value());
}

// One friction mu, levels 3, 4, 5 m/s^2: the capacity is the A with D(A) = d. D by hand is not homogeneous in A alone, but its root over A is a root
// by bisection here, too: 1e-9 relative. Two-way blocks keep the level.
TEST(FragilityAnswers, CapacitiesByRoots)
{
    const double slip = pulse::slip(0.3, 4.37);
    FragilityInput input = input_under_pulse(slip, FragilityDesign::ida);
    input.intensity.levels = {3.0, 4.0, 5.0};
    input.probability.variables = {pulse::lognormal("mu", "contact.friction", 0.3, 0.1, VariableKind::aleatory)};
    for (const bool one_way : {true, false}) {
        const SceneText text = pulse::scene("", 0.3, !one_way);
        const FragilityPlan plan = plan_fragility(input, pulse::suite(text), {64}, text.file(), number_of_the_file);
        const FragilityRuns runs = rigid_runs(plan, text);
        FragilityEstimate estimate = estimate_fragility(plan, runs, nullptr, {});
        const probability::CapacityFit by_levels = *estimate.limits[0].capacities;
        EXPECT_EQ(capacities_by_roots(estimate, plan, runs, text, sweep_method("rigid"), 1), one_way);
        if (!one_way) {
            EXPECT_EQ(estimate.limits[0].capacities->curve.median, by_levels.curve.median);
            continue;
        }
        std::vector<double> reached, censored; // by hand
        for (const CapacityBracket& bracket : capacity_brackets(plan, runs, input.limits[0])) {
            if (!bracket.first) {
                censored.push_back(5.0);
                continue;
            }
            const double mu = std::get<double>(plan.draws[plan.samples[*bracket.first].draw].changes.front().value);
            double low = 0.5, high = 5.0;
            for (int i = 0; i < 100; ++i)
                (pulse::slip(mu, 0.5 * (low + high)) > slip ? high : low) = 0.5 * (low + high);
            reached.push_back(high);
        }
        ASSERT_GT(reached.size(), 20u);
        EXPECT_EQ(*estimate.limits[0].capacity_roots, reached.size());
        const probability::CapacityFit exact = probability::fit_capacities(reached, censored);
        EXPECT_NEAR(estimate.limits[0].capacities->curve.median / exact.curve.median, 1.0, 1e-9);
        EXPECT_NEAR(estimate.limits[0].capacities->curve.beta / exact.curve.beta, 1.0, 1e-9);
        EXPECT_GT(by_levels.curve.median, 1.02 * exact.curve.median); // levels lie above
        FragilityRuns resumed = runs; // rows of a store come without yields: the same bits
        resumed.yield.assign(resumed.yield.size(), std::nan(""));
        FragilityEstimate again = estimate_fragility(plan, resumed, nullptr, {});
        ASSERT_TRUE(capacities_by_roots(again, plan, resumed, text, sweep_method("rigid"), 1));
        EXPECT_EQ(again.limits[0].capacities->curve.median, estimate.limits[0].capacities->curve.median);
    }
}

TEST(FragilityAnswers, NonDecreasing)
{
    const std::vector<double> pooled = non_decreasing({0.1, 0.4, 0.2, 0.6, 0.0}, {1.0, 1.0, 3.0, 1.0, 1.0});
    const std::vector<double> by_hand{0.1, 0.25, 0.25, 0.3, 0.3};
    for (std::size_t i = 0; i < by_hand.size(); ++i) EXPECT_NEAR(pooled[i], by_hand[i], 1e-15);
}

// The water level from a list: higher water, more sliding; each triangle holds its most likely stage, and probabilities rise.
TEST(FragilityAnswers, StagesOfTheWaterLevel)
{
    const SceneText text =
        pulse::scene("[reservoir]\nlevel_m = 20\ndensity_kg_m3 = 1000\n[uplift]\nmodel = \"none\"\n", 0.3);
    FragilityInput input = input_under_pulse(0.2, FragilityDesign::stripes);
    RandomVariable level;
    level.name = "level";
    level.keys = {"reservoir.level_m"};
    level.kind = VariableKind::aleatory;
    level.law = {"discrete", {}, {10.0, 20.0, 30.0}, {1.0, 1.0, 1.0}, {"probability.variable", 7}};
    input.probability.variables = {pulse::lognormal("mu", "contact.friction", 0.45, 0.2, VariableKind::aleatory),
                                   level};
    const FragilityPlan plan = plan_fragility(input, pulse::suite(text), {240}, text.file(), number_of_the_file);
    const std::vector<probability::UsaceLocation> places = stage_fragility(plan, rigid_runs(plan, text));
    ASSERT_EQ(places.size(), 1u);
    ASSERT_EQ(places[0].stages.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
        const probability::StageTriangle& s = places[0].stages[i];
        EXPECT_NEAR(s.most_likely, 10.0 * (static_cast<double>(i) + 1.0), 1e-9);
        EXPECT_LE(s.min, s.most_likely);
        EXPECT_GE(s.max, s.most_likely);
        if (i > 0) {
            EXPECT_GT(s.probability, places[0].stages[i - 1].probability);
        }
    }
    EXPECT_LT(places[0].stages[1].min, 20.0); // an interval, not a point
    EXPECT_GT(places[0].stages[1].max, 20.0);
    input.probability.variables.pop_back();
    const FragilityPlan without = plan_fragility(input, pulse::suite(text), {64}, text.file(), number_of_the_file);
    EXPECT_TRUE(stage_fragility(without, rigid_runs(without, text)).empty());
}

// Opening and factor after the earthquake: above and below their limits, unknown where the method does not give them, failed where the dam slides
// without end; a slip still growing says nothing of them.
TEST(FragilityAnswers, LimitsThatAreNotOfSlip)
{
    const LimitInput opening{LimitQuantity::lift_off, 0.01, "opening"},
        factor{LimitQuantity::post_seismic_fs, 1.1, "factor"};
    FinishedRow row;
    row.results.status = word(Status::at_rest);
    row.results.slip = row.results.max_slip = 5.0; // m: no limit of these
    EXPECT_EQ(answer_to(opening, row), LimitAnswer::missing);
    EXPECT_EQ(answer_to(factor, row), LimitAnswer::missing);
    row.results.opening = 0.02;
    row.results.factor_after = 1.2;
    EXPECT_EQ(answer_to(opening, row), LimitAnswer::fails);
    EXPECT_EQ(answer_to(factor, row), LimitAnswer::survives);
    row.results.opening = 0.005;
    row.results.factor_after = 1.0;
    EXPECT_EQ(answer_to(opening, row), LimitAnswer::survives);
    EXPECT_EQ(answer_to(factor, row), LimitAnswer::fails);
    row.results.status = word(Status::sliding_at_end);
    EXPECT_EQ(answer_to(opening, row), LimitAnswer::missing);
    row.results.status = word(Status::runs_away);
    EXPECT_EQ(answer_to(factor, row), LimitAnswer::fails);
}

// Finite elements on a rigid base: with friction 0.5 the dam at rest after a pulse holds T = W_s by mu N', so that the factor after is mu over the critical
// friction of the same run; without uplift the base opens at the heel while it is shaken.
TEST(FragilityAnswers, FiniteElementsGiveOpeningAndFactor)
{
    const SceneText text = pulse::scene("[mesh]\nsize_m = 10\ncontact_size_m = 8\n[time]\ndt_s = 0.01\n"
                                        "[reservoir]\nlevel_m = 35\ndensity_kg_m3 = 1000\n[uplift]\nmodel = "
                                        "\"none\"\n",
                                        0.3);
    FragilityInput input = input_under_pulse(0.02, FragilityDesign::stripes);
    input.probability.replicates = 1;
    input.intensity.levels = {0.6 * pulse::accel};
    RandomVariable mu;
    mu.name = "mu";
    mu.keys = {"contact.friction"};
    mu.law = {"uniform", {{"min", 0.7}, {"max", 0.9}}, {}, {}, {"probability.variable", 7}};
    input.probability.variables = {mu};
    const FragilityPlan plan = plan_fragility(input, pulse::suite(text), {2}, text.file(), number_of_the_file);
    Watch watch;
    const FragilityRuns runs =
        run_fragility(plan, text, sweep_method("fe-whole-steps"), wanted_samples(plan), nullptr, 1, watch);
    for (std::size_t id = 0; id < plan.samples.size(); ++id) {
        const FragilitySample s = plan.samples[id];
        const RowResults r = runs.rows[id]->results;
        ASSERT_TRUE(r.factor_after && r.opening && r.critical_friction) << r.status;
        const double friction = std::get<double>(plan.draws[s.draw].changes.front().value);
        EXPECT_NEAR(*r.factor_after * *r.critical_friction / friction, 1.0, 1e-6);
        EXPECT_GT(*r.opening, 0.0);
        EXPECT_LT(*r.opening, 0.1);
    }
}

// The block that rocks and slides gives what rock_model() gives of the same draw and motion; a block this wide only slides under the pulse, as the
// block that cannot rock: the same slip to 1e-9.
TEST(FragilityAnswers, Rocking)
{
    const SceneText text = pulse::scene("", 0.3);
    FragilityInput input = input_under_pulse(0.2, FragilityDesign::stripes);
    input.probability.replicates = 1;
    input.probability.variables = {pulse::lognormal("mu", "contact.friction", 0.3, 0.1, VariableKind::aleatory)};
    const FragilityPlan plan = plan_fragility(input, pulse::suite(text), {16}, text.file(), number_of_the_file);
    Watch watch;
    const FragilityRuns rocking =
        run_fragility(plan, text, sweep_method("rocking"), wanted_samples(plan), nullptr, 1, watch);
    const FragilityRuns sliding = rigid_runs(plan, text);
    std::size_t slid = 0;
    for (std::size_t id = 0; id < plan.samples.size(); ++id) {
        const FragilitySample& s = plan.samples[id];
        const Ready ready = prepare(text.with(plan.draws[s.draw].changes), Method::rigid_block, plan.suite.pairs);
        const double own =
            rock_model(ready.scene, ready.rigid_model(), ready.motion(plan.suite.pairs->front(), s.factor), s.polarity)
                .slide.slip;
        ASSERT_TRUE(rocking.rows[id]->results.slip) << rocking.rows[id]->results.status;
        EXPECT_EQ(*rocking.rows[id]->results.slip, own);
        EXPECT_NEAR(own, *sliding.rows[id]->results.slip, 1e-9);
        slid += own > 0.01;
    }
    EXPECT_GT(slid, 8u);
}

} // namespace
} // namespace damslip
