// Friction that is not drawn for each run.
//
// Ground: a pulse of A = 4 m/s^2 over T = 0.5 s with linear flanks of dt before and after; one way, dry, horizontal base, a_y = mu g. By hand:
//   flank up      v = (A - a_y)^2 dt / (2A),  s = (A - a_y)^3 dt^2 / (6 A^2)
//   plateau       v += (A - a_y) T,           s += v T + (A - a_y) T^2 / 2
//   flank down    v += (A/2 - a_y) dt,        s += v dt + (A - a_y) dt^2 / 2 - A dt^2 / 6
//   after         s += v^2 / (2 a_y)
// (a_y < A/2 is not needed: the block decelerates on the flank all the same.) D falls with mu, so that P(D > d) = F(mu*) with D(mu*) = d, exactly.
#include "pulse_scene.hpp"

#include "analysis/fragility/fragility_study.hpp"
#include "core/input_error.hpp"

#include "analysis/fragility/conditioned_plan.hpp"
#include "analysis/fragility/fragility_estimate.hpp"

#include "core/file.hpp"
#include "probability/distribution.hpp"

#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <utility>

namespace damslip {
namespace {

FragilityInput input_of_pulse(double limit)
{
    FragilityInput input;
    input.probability.sampling = SamplingInput::latin_hypercube;
    input.probability.replicates = 8;
    input.probability.variables = {pulse::mu()};
    input.intensity.levels = {pulse::accel};
    input.limits = {{LimitQuantity::slip, limit, "slip"}};
    input.suite = SuiteInput{};
    input.suite->polarity = SuitePolarity::as_recorded;
    return input;
}

double number_in_file(const std::string&)
{
    return 1.0;
}

double lognormal_share(double x, double median, double beta)
{
    return probability::normal_cdf(std::log(x / median) / beta);
}

LevelEstimate level_of(const ConditionedPlan& plan, const FragilityRuns& runs, std::size_t level = 0)
{
    return estimate_fragility(plan.plan, runs, nullptr, {}, &plan).limits[0].levels.at(level);
}

ConditionedPlan rigid_plan(const FragilityInput& input, const SceneText& text)
{
    Watch watch;
    return condition_rigid(input, pulse::suite(text), text, number_in_file, sweep_method("rigid"), {}, watch);
}

FragilityRuns runs_of(const ConditionedPlan& plan, const SceneText& text)
{
    Watch watch;
    return run_fragility(plan.plan, text, sweep_method("rigid"), wanted_samples(plan.plan), nullptr, 1, watch);
}

// Lognormal, truncated, uniform; two levels. No friction is drawn: the digits of F(mu*).
TEST(ConditionedPlan, RigidBlockIsExact)
{
    const SceneText text = pulse::scene();
    FragilityInput input = input_of_pulse(0.2);
    input.intensity.levels = {3.0, pulse::accel};
    const auto p = [&](std::size_t level) {
        const ConditionedPlan plan = rigid_plan(input, text);
        EXPECT_TRUE(plan.exact());
        EXPECT_TRUE(plan.notes.empty());
        return level_of(plan, runs_of(plan, text), level).p;
    };
    for (const std::size_t level : {0, 1}) {
        input.probability.variables[0].law = {"lognormal", {{"median", 0.30}, {"beta", 0.2}}, {}, {}, {}};
        const double mu = pulse::friction(0.2, input.intensity.levels[level]);
        EXPECT_NEAR(p(level) / lognormal_share(mu, 0.30, 0.2), 1.0, 1e-9);
        input.probability.variables[0].law.parameters["min"] = 0.2;
        const double below = lognormal_share(0.2, 0.30, 0.2);
        EXPECT_NEAR(p(level) / ((lognormal_share(mu, 0.30, 0.2) - below) / (1.0 - below)), 1.0, 1e-9);
        input.probability.variables[0].law = {"uniform", {{"min", 0.15}, {"max", 0.5}}, {}, {}, {}};
        EXPECT_NEAR(p(level) / ((mu - 0.15) / 0.35), 1.0, 1e-9);
        const std::optional<SuiteInput> as_recorded = std::exchange(input.suite, {});
        EXPECT_NEAR(p(level) / (0.5 * (mu - 0.15) / 0.35), 1.0, 1e-9); // both polarities: reversed, nothing slides
        input.suite = as_recorded;
    }
}

// p_static = F(mu_c) to the digits, whatever the limit; given that the dam stands nothing fails.
TEST(ConditionedPlan, StaticFailureIsToldApart)
{
    const SceneText text = pulse::scene("[reservoir]\nlevel_m = 45\n[uplift]\nmodel = \"none\"\n");
    FragilityInput input = input_of_pulse(1e3);
    input.intensity.levels = {0.01}; // moves no dam that stands
    const double critical = prepare(text.scene(), Method::rigid_block).rigid_model().critical_friction;
    input.probability.variables[0].law.parameters["median"] = critical * 1.2;
    const double p = lognormal_share(critical, critical * 1.2, 0.2);
    for (const StaticFailure rule : {StaticFailure::infinite, StaticFailure::given_standing}) {
        input.probability.static_failure = rule;
        const ConditionedPlan plan = rigid_plan(input, text);
        EXPECT_NEAR(plan.p_static / p, 1.0, 1e-9);
        EXPECT_NEAR(level_of(plan, runs_of(plan, text)).p, rule == StaticFailure::infinite ? p : 0.0, 1e-9);
    }
}

// The design for finite elements with the rigid block in their place, at a slip limit of a pulse 1.2 times as strong as the one that tells where to look:
// the prediction is off, the estimate is not. P = 1e-3 by 160 runs; mean over 40 seeds within four of its standard errors, and these
// are what the replicates say they are (chi^2 of 40 x 7 degrees of freedom, within four deviations; 160 plain runs would have 80 %).
TEST(ConditionedPlan, UnbiasedWithAPredictionThatIsOff)
{
    const SceneText text = pulse::scene(), stronger = pulse::scene("[motion]\nscale = 1.2\n");
    FragilityInput input = input_of_pulse(0.2);
    const double mu = pulse::friction(0.2, 1.2 * pulse::accel), median = mu * std::exp(3.0902 * 0.2);
    input.probability.variables[0].law.parameters["median"] = median;
    const double p = lognormal_share(mu, median, 0.2);
    Watch watch;
    double sum = 0.0, squares = 0.0, stated = 0.0;
    constexpr int seeds = 40;
    for (int seed = 1; seed <= seeds; ++seed) {
        input.probability.seed = static_cast<std::uint64_t>(seed);
        ConditioningSizes sizes;
        sizes.runs = 160;
        sizes.pilot = 48;
        sizes.motions = 1;
        const ConditionedPlan plan =
            condition_finite_elements(input, pulse::suite(text), text, number_in_file, sweep_method("rigid"),
                                      sweep_method("rigid"), sizes, watch);
        ASSERT_EQ(plan.plan.samples.size(), 160u);
        const FragilityRuns runs = runs_of(plan, stronger);
        const LevelEstimate level = level_of(plan, runs);
        sum += level.p;
        squares += level.p * level.p;
        stated += level.se * level.se;
    }
    const double mean = sum / seeds, variance = (squares - seeds * mean * mean) / (seeds - 1);
    EXPECT_NEAR(mean, p, 4.0 * std::sqrt(variance / seeds));
    EXPECT_LT(std::sqrt(variance), 0.4 * p);
    EXPECT_NEAR(stated / seeds / variance, 1.0, 4.0 * std::sqrt(2.0 / (seeds - 1)));
}

// What cannot be conditioned on is said.
TEST(ConditionedPlan, WhatCannotBeConditionedOn)
{
    FragilityInput input = input_of_pulse(0.2);
    EXPECT_EQ(why_not_conditioned(input), "");
    RandomVariable other = input.probability.variables[0];
    other.name = "density";
    other.keys = {"dam.density_kg_m3"};
    input.probability.variables.push_back(other);
    EXPECT_EQ(why_not_conditioned(input), "");
    input.probability.correlations = {{"density", "mu", 0.3, {}}};
    EXPECT_NE(why_not_conditioned(input), "");
    input.probability.correlations.clear();
    input.probability.variables[0].law.name = "discrete";
    EXPECT_NE(why_not_conditioned(input), "");
    input.probability.variables.erase(input.probability.variables.begin());
    EXPECT_NE(why_not_conditioned(input), "");
}

// Where no runs are shared out among levels, a probability to aim at is refused, not passed over.
TEST(ConditionedPlan, AnAimWithoutConditioningIsRefused)
{
    const SceneText text = pulse::scene();
    FragilityInput input = input_of_pulse(0.2);
    Watch watch;
    const FragilityStudy rigid = open_fragility(text, text.scene(), input, "rigid");
    for (const Conditioning asked : {Conditioning::automatic, Conditioning::on, Conditioning::off})
        EXPECT_THROW(condition_on_friction(rigid, asked, 16, 1, watch, 0.01), UsageError);
    EXPECT_FALSE(condition_on_friction(rigid, Conditioning::off, 16, 1, watch));
    input.probability.variables.front().kind = VariableKind::epistemic;
    const FragilityStudy fe = open_fragility(text, text.scene(), input, "fe");
    EXPECT_THROW(condition_on_friction(fe, Conditioning::automatic, 16, 1, watch, 0.01), UsageError);
    EXPECT_FALSE(condition_on_friction(fe, Conditioning::automatic, 16, 1, watch));
}

} // namespace
} // namespace damslip
