// Fragility of the rigid block, from the plan to the estimate.
//
// Ground: a pulse of A = 4 m/s^2 over T = 0.5 s with linear flanks of dt before and after. One way, dry, horizontal base: a_y = mu g. By hand:
//   flank up      v = (A - a_y)^2 dt / (2A),  s = (A - a_y)^3 dt^2 / (6 A^2)
//   plateau       v += (A - a_y) T,           s += v T + (A - a_y) T^2 / 2
//   flank down    v += (A/2 - a_y) dt,        s += v dt + (A - a_y) dt^2 / 2 - A dt^2 / 6
//   after         s += v^2 / (2 a_y)
// which tends to D = (A - a_y) A T^2 / (2 a_y), D > d <=> mu < A^2 T^2 / (g (2d + A T^2)), as dt goes to 0. D falls with mu, so that P(D > d) is F_mu at the
// mu with D = d. Latin hypercubes of m points meet F_mu(mu*) to 1/m.
#include "pulse_scene.hpp"

#include "analysis/fragility/capacity_roots.hpp"
#include "analysis/fragility/fragility_study.hpp"

#include "core/file.hpp"
#include "core/input_error.hpp"
#include "probability/distribution.hpp"

#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace damslip {
namespace {

FragilityInput pulse_input(double limit)
{
    FragilityInput input;
    input.probability.sampling = SamplingInput::latin_hypercube;
    input.probability.replicates = 4;
    input.probability.variables = {pulse::mu()};
    input.intensity.levels = {pulse::accel};
    input.limits = {{LimitQuantity::slip, limit, "slip"}};
    input.suite = SuiteInput{};
    input.suite->polarity = SuitePolarity::as_recorded;
    return input;
}

double written(const std::string&)
{
    return 1.0;
}

struct Done {
    FragilityPlan plan;
    FragilityRuns runs;
    FragilityEstimate estimate;
};
Done fragility(const SceneText& text, const FragilityInput& input, std::size_t samples, int jobs = 1)
{
    Done d;
    d.plan = plan_fragility(input, pulse::suite(text), {samples}, text.file(), written);
    Watch watch;
    d.runs = run_fragility(d.plan, text, sweep_method("rigid"), wanted_samples(d.plan), nullptr, jobs, watch);
    d.estimate = estimate_fragility(d.plan, d.runs, nullptr, {});
    return d;
}

double lognormal_cdf(double x, double median, double beta)
{
    return probability::normal_cdf(std::log(x / median) / beta);
}

// F at critical mu to the width of a stratum, 1/m; lognormal, truncated, uniform.
TEST(Fragility, PulseAndRandomFriction)
{
    const SceneText text = pulse::scene();
    for (const double limit : {0.05, 0.2}) {
        const double mu = pulse::friction(limit);
        FragilityInput input = pulse_input(limit);
        EXPECT_NEAR(fragility(text, input, 1024).estimate.limits[0].levels[0].p, lognormal_cdf(mu, 0.30, 0.2),
                    1.0 / 256);
        input.probability.variables[0].law.parameters["min"] = 0.25;
        const double below = lognormal_cdf(0.25, 0.30, 0.2);
        EXPECT_NEAR(fragility(text, input, 1024).estimate.limits[0].levels[0].p,
                    (lognormal_cdf(mu, 0.30, 0.2) - below) / (1.0 - below), 1.0 / 256);
        input.probability.variables[0].law = {"uniform", {{"min", 0.2}, {"max", 0.5}}, {}, {}, {}};
        EXPECT_NEAR(fragility(text, input, 1024).estimate.limits[0].levels[0].p, (mu - 0.2) / 0.3, 1.0 / 256);
    }
}

// Without [suite] a record shakes both ways round, half of the runs each: reversed, this pulse moves no block that slides one way; as recorded every
// run slides farther than the limit whose friction is below mu*.
TEST(Fragility, WithoutASuiteBothPolaritiesCountAlike)
{
    const SceneText text = pulse::scene();
    FragilityInput input = pulse_input(0.2);
    input.suite.reset();
    const Done both = fragility(text, input, 1024);
    double reversed = 0.0, fails = 0.0;
    for (std::size_t id = 0; id < both.plan.samples.size(); ++id) {
        const FragilitySample sample = both.plan.samples[id];
        const double mu = std::get<double>(both.plan.draws[sample.draw].values[0]);
        const bool far = sample.polarity > 0 && mu < pulse::friction(0.2);
        EXPECT_EQ(both.runs.rows[id]->results.slip.value_or(NAN) > 0.2, far) << mu << " " << sample.polarity;
        reversed += sample.polarity < 0;
        fails += far;
    }
    EXPECT_EQ(reversed, 512.0);
    EXPECT_GT(fails, 100.0);
    EXPECT_NEAR(both.estimate.limits[0].levels[0].p, fails / 1024.0, 1e-12);
    input.suite = SuiteInput{};
    input.suite->polarity = SuitePolarity::reversed;
    EXPECT_EQ(fragility(text, input, 1024).estimate.limits[0].levels[0].p, 0.0);
}

// Slip of a one-way block, D(k a; a_y) = k D(a; a_y / k): mu random and levels k A0 with thresholds k d give the same P as mu / k.
TEST(Fragility, LevelsScaleTheRecord)
{
    FragilityInput input = pulse_input(0.1);
    input.intensity.levels = {2.0, 4.0};
    const Done d = fragility(pulse::scene(), input, 1024);
    for (const LevelEstimate& level : d.estimate.limits[0].levels) {
        const double k = level.x / pulse::accel;
        double low = 0.01, high = 1.0; // D(k a; mu g) = k D(a; mu g / k)
        for (int i = 0; i < 100; ++i) {
            const double mu = 0.5 * (low + high);
            (k * pulse::slip(mu / k) > 0.1 ? low : high) = mu;
        }
        EXPECT_NEAR(level.p, lognormal_cdf(low, 0.30, 0.2), 1.0 / 256);
    }
}

TEST(Fragility, RefusesRecordsScaledTooFar)
{
    FragilityInput input = pulse_input(0.1);
    input.intensity.levels = {4.1 * pulse::accel};
    const SceneText text = pulse::scene();
    EXPECT_THROW(plan_fragility(input, pulse::suite(text), {64}, text.file(), written), InputError);
    input.suite->allow_scaling = true;
    EXPECT_EQ(plan_fragility(input, pulse::suite(text), {64}, text.file(), written).scaled_far.size(), 1u);
}

TEST(Fragility, ScalesOfAListCountForTheLargestOne)
{
    FragilityInput input = pulse_input(0.1);
    input.intensity.levels = {3.0 * pulse::accel};
    const SceneText text = pulse::scene();
    ShakingSuite suite = pulse::suite(text);
    EXPECT_TRUE(plan_fragility(input, suite, {64}, text.file(), written).scaled_far.empty());
    std::vector<RecordPair> twice = *suite.pairs;
    twice.front().files.scale = 2.0; // its intensity is that of the scaled record
    suite.pairs = std::make_shared<const std::vector<RecordPair>>(twice);
    EXPECT_THROW(plan_fragility(input, suite, {64}, text.file(), written), InputError);
}

// One-way block under the pulse: D(k g) = d at k = mu*, whatever the dam.
TEST(Fragility, YieldThatALimitNeeds)
{
    const SceneText text = pulse::scene();
    const FragilityPlan plan = plan_fragility(pulse_input(0.2), pulse::suite(text), {64}, text.file(), written);
    const std::vector<NeededYield> needed = needed_yield(plan, text, 0.2);
    ASSERT_EQ(needed.size(), 1u);
    EXPECT_NEAR(needed[0].k50, pulse::friction(0.2) * pulse::gravity / 9.80665, 1e-9);
}

std::string refusal(const std::string& tables)
{
    const std::filesystem::path file = pulse::folder() / "read.toml";
    pulse::scene();
    write_file(
        file,
        "[section]\nheight_m = 50\nbase_m = 40\ncrest_m = 5\n[dam]\ndensity_kg_m3 = 2400\n[contact]\nfriction = 0.7\n"
        "[[motion.record]]\nname = \"pulse\"\nhorizontal = \"pulse.csv\"\nunit = \"m/s2\"\n" +
            tables);
    try {
        read_fragility_input(file);
    } catch (const InputError& e) {
        return e.what();
    }
    return "";
}

// The tables of a scene file: what they say, and what is said of what is wrong.
TEST(Fragility, TablesAreRead)
{
    const std::string good = "[probability]\nseed = 3\nsampling = \"lhs\"\nstatic_failure = "
                             "\"given-standing\"\n[[probability.variable]]\nname = \"mu\"\n"
                             "key = \"contact.friction\"\nkind = \"epistemic\"\nlognormal = { median = 0.7, beta = "
                             "0.1, min = 0.4 }\n[intensity]\n"
                             "measure = \"SA(0.3)\"\nlevels_g = [0.1, 0.2]\n[[limit]]\nabove_mm = 50\n";
    EXPECT_EQ(refusal(good), "");
    const FragilityInput input = read_fragility_input(pulse::folder() / "read.toml");
    EXPECT_EQ(input.probability.seed, 3u);
    EXPECT_EQ(input.probability.variables.at(0).law.parameters.at("min"), 0.4);
    EXPECT_EQ(input.probability.variables.at(0).kind, VariableKind::epistemic);
    EXPECT_EQ(input.intensity.levels, (std::vector<double>{0.1 * 9.80665, 0.2 * 9.80665}));
    EXPECT_EQ(input.limits.at(0).value, 0.05);
    EXPECT_EQ(SceneText::read(pulse::folder() / "read.toml").written("contact.friction"), 0.7);
    for (const auto& [from, to, words] : {std::tuple{"beta = 0.1", "bta = 0.1", "Did you mean beta?"},
                                          {"beta = 0.1", "beta = -0.1", "beta is not allowed"},
                                          {"contact.friction", "contact.fricton", "Did you mean contact.friction?"},
                                          {"SA(0.3)", "SA", "intensity.measure"},
                                          {"[0.1, 0.2]", "[0.2, 0.1]", "ascending"},
                                          {"above_mm = 50", "above_mm = -1", "limit.above_mm"},
                                          {"\"lhs\"", "\"lsh\"", "probability.sampling"}}) {
        std::string bad = good;
        bad.replace(bad.find(from), std::string(from).size(), to);
        EXPECT_NE(refusal(bad).find(words), std::string::npos) << refusal(bad);
    }
}

// A law that reaches values its key does not allow is refused before the first run, with its line.
TEST(Fragility, LawsStayWithinTheirKeys)
{
    const std::string head = "[probability]\n[[probability.variable]]\nname = \"nu\"\nkey = \"dam.poisson_ratio\"\n";
    const std::string tail = "\n[intensity]\nmeasure = \"PGA\"\nlevels_g = [0.1]\n[[limit]]\nabove_mm = 50\n";
    const auto refused = [&](const std::string& law) -> std::string {
        EXPECT_EQ(refusal(head + law + tail), ""); // the tables themselves are right
        const auto file = pulse::folder() / "read.toml";
        const SceneText text = SceneText::read(file);
        try {
            check_fragility(read_fragility_input(file), text);
        } catch (const InputError& e) {
            EXPECT_GT(e.diagnostics().front().line, 0);
            return e.what();
        }
        return "";
    };
    EXPECT_EQ(refused("uniform = { min = 0.15, max = 0.25 }"), "");
    const std::string unbounded = refused("lognormal = { median = 0.2, beta = 0.3 }");
    EXPECT_NE(unbounded.find("probability.variable[nu].lognormal reaches"), std::string::npos) << unbounded;
    EXPECT_NE(unbounded.find("dam.poisson_ratio"), std::string::npos) << unbounded;
    EXPECT_EQ(refused("lognormal = { median = 0.2, beta = 0.3, max = 0.45 }"), "");
}

// A list of records: events and weights are taken, what is no number or no file is refused with its line.
TEST(Fragility, SuiteOfAList)
{
    const SceneText text = pulse::scene();
    FragilityInput input = pulse_input(0.2);
    input.suite = SuiteInput{};
    input.suite->files = (pulse::folder() / "suite.csv").string();
    write_file(input.suite->files, "horizontal,event,weight,scale\npulse.csv,first,2.5,0.5\n");
    const ShakingSuite suite = suite_of_input(text.scene(), input);
    EXPECT_EQ(suite.event, std::vector<std::string>{"first"});
    EXPECT_EQ(suite.weight, std::vector<double>{2.5});
    EXPECT_EQ(suite.intensity, std::vector<double>{0.5 * pulse::accel});
    for (const char* bad :
         {"pulse.csv,first,-1,1\n", "nothing.csv,first,1,1\n", "pulse.csv,a,1,1\npulse.csv,b,1,1\n"}) {
        write_file(input.suite->files, std::string("horizontal,event,weight,scale\n") + bad);
        EXPECT_THROW(suite_of_input(text.scene(), input), InputError) << bad;
    }
}

// The geometric mean of both horizontal components, with the scene's factor on both; of a record that has no other the measure of the one.
TEST(Fragility, IntensityOfBothComponents)
{
    const SceneText text = pulse::scene("[motion]\nscale = 0.5\n");
    const auto pulse_of = [](double accel) {
        return fmt::format("# units: m/s2\nt,a\n0,0\n0.01,{}\n0.02,{}\n0.03,0\n0.04,0\n", accel, -accel / 3);
    };
    write_file(pulse::folder() / "one.csv", pulse_of(4.0));
    write_file(pulse::folder() / "two.csv", pulse_of(1.0));
    FragilityInput input = pulse_input(0.2);
    input.suite = SuiteInput{};
    input.suite->files = (pulse::folder() / "both.csv").string();
    write_file(input.suite->files, "horizontal,other_horizontal,event\none.csv,two.csv,a\ntwo.csv,,b\n");
    EXPECT_EQ(suite_of_input(text.scene(), input).intensity, (std::vector<double>{2.0, 0.5}));
    input.intensity.component = IntensityComponent::geomean;
    const ShakingSuite suite = suite_of_input(text.scene(), input);
    EXPECT_DOUBLE_EQ(suite.intensity[0], 1.0); // sqrt(2 * 0.5)
    EXPECT_DOUBLE_EQ(suite.intensity[1], 0.5);
    ASSERT_EQ(suite.notes.size(), 1u);
    EXPECT_NE(suite.notes[0].find("of 1 of 2 records"), std::string::npos) << suite.notes[0];

    input.intensity.measure = IntensityMeasure::arias; // grows with the square of the factor, of each component
    const double both = suite_of_input(text.scene(), input).intensity[0];
    input.intensity.component = IntensityComponent::as_used;
    const double one = suite_of_input(text.scene(), input).intensity[0];
    EXPECT_NEAR(both, one / 4.0,
                1e-12 * one); // the other has a quarter of its samples: a sixteenth of its Arias intensity

    EXPECT_EQ(suite_of_input(text.scene(), input).intensity[0], one); // of the index
    EXPECT_TRUE(std::filesystem::exists(pulse::folder() / ".damslip-index.csv"));
}

} // namespace
} // namespace damslip
