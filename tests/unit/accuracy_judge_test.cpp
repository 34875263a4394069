// The ladder's judgement: orders, limits, errors, front and choice from results that are made up, so that each is known.
#include "analysis/accuracy/accuracy.hpp"
#include "analysis/accuracy/ladder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace {

using namespace damslip;

constexpr double exact = 0.05; // [m]

/// Slip of an FE model whose errors are known: 0.01 (dt/2^k)^1.5 + 0.002 h^1.2, and 0.3/penalty, 0.02/modes.
double slip_of(const Rung& r)
{
    double slip = exact + 0.01 * std::exp2(-1.5 * r.halvings) + 0.002 * std::pow(r.mesh, 1.2);
    if (r.water == RungWater::added_mass) slip *= 0.8;
    if (r.tangential_stiffness) slip += 0.3e8 / *r.tangential_stiffness;
    if (r.modes) slip += 0.004 / *r.modes;
    return slip;
}

/// Seconds go with steps, and with the number of elements.
RungResult made_up(const Rung& rung)
{
    RungResult r;
    r.rung = rung;
    r.outcome = RungOutcome::done;
    r.repeats = 1;
    if (rung.family == RungFamily::finite_elements) {
        r.slip = {slip_of(rung)};
        r.set_up_seconds = 0.1;
        r.seconds = 0.1 + 0.2 * std::exp2(rung.halvings) * std::pow(rung.mesh, -2.0);
        if (rung.modes) r.seconds *= 0.2;
        if (!rung.element.empty()) r.seconds *= 3.5;
        r.time_step = 0.01 / std::exp2(rung.halvings);
    } else {
        r.slip = {rung.family == RungFamily::rigid ? 0.03 : 0.02};
        r.seconds = 0.001;
    }
    return r;
}

LadderFacts facts_of_a_dam()
{
    LadderFacts facts;
    facts.regressions = {"jibson-1998", "ensemble"};
    facts.vertical = true;
    facts.waters = {RungWater::added_mass, RungWater::acoustic};
    facts.reducible = true;
    facts.alphas = {0.0, -0.3};
    facts.coarsest = 4.0;
    facts.quadratic = true;
    return facts;
}

std::vector<RungResult> climbed(const ClimbOptions& options = {})
{
    ClimbCalls calls;
    calls.run = made_up;
    return climb(facts_of_a_dam(), options, calls);
}

const RungResult* rung(const std::vector<RungResult>& results, const std::string& id)
{
    const auto at = std::find_if(results.begin(), results.end(), [&](const auto& r) { return rung_id(r.rung) == id; });
    return at == results.end() ? nullptr : &*at;
}

const RungVerdict& verdict(const std::vector<RungResult>& results, const Judgement& j, const std::string& id)
{
    return j.rungs.at(static_cast<std::size_t>(rung(results, id) - results.data()));
}

TEST(AccuracyConvergence, FindsOrderAndLimitOfAPower)
{
    for (const double p : {1.0, 1.4, 2.0}) {
        const std::vector<double> v{3.0 + 0.7, 3.0 + 0.7 * std::exp2(-p), 3.0 + 0.7 * std::exp2(-2 * p)};
        EXPECT_NEAR(*observed_order(v), p, 1e-12);
        EXPECT_NEAR(extrapolated(v)->value, 3.0, 1e-12);
        EXPECT_NEAR(extrapolated(v)->correction, -0.7 * std::exp2(-2 * p), 1e-12);
        const std::vector<double> two(v.begin() + 1, v.end());
        EXPECT_NEAR(extrapolated(two, 2.0, p)->value, 3.0, 1e-12); // the order comes from elsewhere
    }
    const std::vector<double> errors{0.5, 0.05};
    EXPECT_NEAR(*order_of_errors(errors, 10.0), 1.0, 1e-12);
}

TEST(AccuracyConvergence, PrintsTheOrderItSeesAndReliesOnOneBetweenOneAndTwo)
{
    const std::vector<double> third{1.0 + 0.64, 1.0 + 0.08, 1.0 + 0.01}; // third order: extrapolated with second
    EXPECT_NEAR(*observed_order(third), 3.0, 1e-12);
    EXPECT_NEAR(extrapolated(third)->correction, -0.07 / 3.0, 1e-12);
    const std::vector<double> grows{1.0, 1.1, 1.3};
    EXPECT_NEAR(*observed_order(grows), -1.0, 1e-12);
    EXPECT_NEAR(extrapolated(grows)->correction, 0.2, 1e-12);
    const std::vector<double> still{1.0, 1.1, 1.1}, one{1.0};
    EXPECT_FALSE(observed_order(still));
    EXPECT_EQ(extrapolated(still)->correction, 0.0);
    EXPECT_FALSE(extrapolated(one));
}

TEST(AccuracyRung, NamesReadBack)
{
    const std::vector<RungResult> results = climbed();
    ASSERT_GT(results.size(), 25u);
    for (const RungResult& r : results) {
        const auto back = parse_rung(rung_id(r.rung));
        ASSERT_TRUE(back) << rung_id(r.rung);
        EXPECT_EQ(*back, r.rung) << rung_id(r.rung);
    }
    for (const char* wrong :
         {"", "rigid", "rigid:v", "fe:dt", "fe-acoustic:dt/3", "fe-acoustic:dt/-2", "fe-acoustic:h/0",
          "fe-acoustic:dt,h", "fe-acoustic:dt,alpha=0.5", "fe-acoustic:dt,modes=1"})
        EXPECT_FALSE(parse_rung(wrong)) << wrong;
}

TEST(AccuracyLadder, QuadraticElementsStandBesideLinearOnesOfTheSameStep)
{
    const std::vector<RungResult> results = climbed();
    int found = 0;
    for (const RungResult& r : results) {
        if (r.rung.element.empty()) continue;
        ++found;
        EXPECT_EQ(r.rung.water, RungWater::acoustic);
        EXPECT_FALSE(r.rung.plain());
        Rung linear = r.rung;
        linear.element.clear();
        EXPECT_TRUE(rung(results, rung_id(linear))) << rung_id(linear);
        linear.mesh *= 0.5;
        EXPECT_TRUE(rung(results, rung_id(linear))) << rung_id(linear);
        EXPECT_GT(*expected_seconds(r.rung, results), 0.0);
    }
    EXPECT_EQ(found, 2);
}

TEST(AccuracyLadder, HasOnlyRungsThatDifferForTheScene)
{
    LadderFacts rigid;
    EXPECT_EQ(ladder(rigid, {}, {}).size(), 1u); // no vertical record, no regression, no elastic dam
    LadderFacts dry = facts_of_a_dam();
    dry.waters = {RungWater::dry};
    ClimbCalls calls;
    calls.run = made_up;
    for (const RungResult& r : climb(dry, {}, calls)) EXPECT_EQ(rung_id(r.rung).find("acoustic"), std::string::npos);
}

TEST(AccuracyLadder, EndsWithTheFinestRungOfTheRichestModel)
{
    const std::vector<RungResult> results = climbed();
    EXPECT_EQ(*top_rung(results), results.size() - 1);
    EXPECT_EQ(results.back().rung.water, RungWater::acoustic);
    EXPECT_LT(results.back().rung.mesh, 1.0);
    ClimbOptions quick;
    quick.ladder.effort = Effort::quick;
    EXPECT_LT(climbed(quick).size(), results.size());
}

TEST(AccuracyLadder, HalvesStepsUntilTheSlipIsSettled)
{
    ClimbOptions options;
    options.ladder.tolerance = 0.02;
    const std::size_t coarse = step_row(climbed(options), RungWater::acoustic).size();
    options.ladder.tolerance = 0.001;
    EXPECT_GT(step_row(climbed(options), RungWater::acoustic).size(), coarse);
}

// The true errors are known: estimates of all rungs of the model lie within a factor of two, most within 10 %.
TEST(AccuracyJudge, EstimatesErrorsOfStepMeshPenaltyAndModes)
{
    const std::vector<RungResult> results = climbed();
    const Judgement j = judge_rungs(results, 0.02);
    int checked = 0;
    for (std::size_t i = 0; i < results.size(); ++i) {
        const Rung& r = results[i].rung;
        if (r.family != RungFamily::finite_elements) continue;
        const double truth = std::abs(results[i].slip[0] - (r.water == RungWater::added_mass ? 0.8 : 1.0) * exact);
        ASSERT_TRUE(j.rungs[i].error);
        EXPECT_GT(*j.rungs[i].error, 0.5 * truth) << rung_id(r);
        EXPECT_LT(*j.rungs[i].error, 2.0 * truth) << rung_id(r);
        ++checked;
    }
    EXPECT_GT(checked, 20);
    for (const ModelLimit& m : j.models) {
        if (!m.model.starts_with("fe-")) continue;
        EXPECT_NEAR(*m.order_step, 1.5, 0.01);
        EXPECT_NEAR(*m.order_mesh, 1.2, 0.01);
        if (m.model == "fe-acoustic") continue;
        EXPECT_NEAR(*m.order_penalty, 1.0, 1e-6);
        EXPECT_NEAR(*m.order_modes, 1.0, 1e-6);
    }
}

TEST(AccuracyJudge, TellsModelsApartFromDiscretisation)
{
    const std::vector<RungResult> results = climbed();
    const Judgement j = judge_rungs(results, 0.02);
    // Added mass tends to 0.8 of the acoustic slip, whatever the rung; 2 % of that for the extrapolations.
    EXPECT_NEAR(*verdict(results, j, "fe-added-mass:dt").model_difference, -0.2 * exact, 0.02 * exact);
    EXPECT_NEAR(*verdict(results, j, "fe-added-mass:dt/8").model_difference, -0.2 * exact, 0.02 * exact);
    EXPECT_EQ(*verdict(results, j, "rigid:h").error, 0.0);
    EXPECT_FALSE(verdict(results, j, "regression:ensemble").error);
    EXPECT_GT(*verdict(results, j, "regression:ensemble").deviation, 0.5);
}

TEST(AccuracyJudge, DeviationContainsWhatTheTopLeavesOpenAndTheWorstRecordCounts)
{
    std::vector<RungResult> results = climbed();
    for (RungResult& r : results) r.slip.push_back(2.0 * r.slip[0] + (r.rung.modes ? 0.01 : 0.0));
    const Judgement j = judge_rungs(results, 0.02);
    EXPECT_EQ(j.motion, 1u); // the larger slip
    EXPECT_GT(*j.top_error, 0.0);
    for (const RungVerdict& v : j.rungs) EXPECT_GE(*v.deviation, *j.top_error);
    const RungResult& reduced =
        *std::find_if(results.begin(), results.end(), [](const RungResult& r) { return r.rung.modes.has_value(); });
    const RungResult& top = results[*j.top];
    EXPECT_GE(*verdict(results, j, rung_id(reduced.rung)).deviation,
              std::abs(reduced.slip[1] - top.slip[1]) / top.slip[1]);
}

TEST(AccuracyJudge, NamesNoneWhereAFinerRungHasNoSlip)
{
    std::vector<RungResult> results = climbed();
    ASSERT_TRUE(judge_rungs(results, 0.1).choice);
    results.back().outcome = RungOutcome::failed;
    const Judgement j = judge_rungs(results, 0.1);
    EXPECT_FALSE(j.choice);
    EXPECT_EQ(*j.contradiction, results.size() - 1);
    results.back().outcome = RungOutcome::skipped; // for want of seconds: the next finest is the top
    EXPECT_TRUE(judge_rungs(results, 0.1).choice);
}

// Over random rungs: a larger tolerance never names a slower one, and what is named is on the front or as fast.
TEST(AccuracyJudge, LargerToleranceNeverNamesASlowerRung)
{
    std::mt19937 random(11);
    const auto uniform = [&] { return static_cast<double>(random()) / 4294967296.0; };
    for (int trial = 0; trial < 500; ++trial) {
        std::vector<double> seconds;
        std::vector<std::optional<double>> deviation;
        const int n = 1 + static_cast<int>(12 * uniform());
        for (int i = 0; i < n; ++i) {
            seconds.push_back(std::floor(10.0 * uniform())); // ties happen
            deviation.push_back(uniform() < 0.15 ? std::nullopt : std::optional(std::floor(20.0 * uniform()) / 20.0));
        }
        const std::vector<bool> front = pareto_front(seconds, deviation);
        double before = std::numeric_limits<double>::infinity();
        for (double tolerance = 0.0; tolerance <= 1.0; tolerance += 0.05) {
            const auto choice = cheapest_within(seconds, deviation, tolerance);
            if (!choice) {
                EXPECT_TRUE(std::isinf(before)); // none once there was one would be slower than any
                continue;
            }
            EXPECT_LE(seconds[*choice], before);
            EXPECT_LE(*deviation[*choice], tolerance);
            before = seconds[*choice];
            bool as_fast = false;
            for (int i = 0; i < n; ++i) as_fast = as_fast || (front[i] && seconds[i] == before);
            EXPECT_TRUE(as_fast);
        }
    }
}

TEST(AccuracyClimb, ListsWhatExceedsTheBudgetAndKeepsWhatFailed)
{
    ClimbOptions options;
    options.budget = 2.0; // made-up rungs take no time, but say what they would
    const std::vector<RungResult> results = climbed(options);
    const auto skipped = std::count_if(results.begin(), results.end(),
                                       [](const RungResult& r) { return r.outcome == RungOutcome::skipped; });
    EXPECT_GT(skipped, 0);
    for (const RungResult& r : results)
        EXPECT_TRUE(r.outcome != RungOutcome::skipped || r.seconds >= 1.5) << rung_id(r.rung);
    ClimbCalls failing;
    failing.run = [](const Rung& rung) {
        RungResult r = made_up(rung);
        if (rung.water == RungWater::acoustic && rung.family == RungFamily::finite_elements) {
            r.outcome = RungOutcome::refused;
            r.slip.clear();
        }
        return r;
    };
    const std::vector<RungResult> poor = climb(facts_of_a_dam(), {}, failing);
    EXPECT_EQ(poor[*top_rung(poor)].rung.water, RungWater::added_mass);
    EXPECT_TRUE(rung(poor, "fe-acoustic:dt"));
}

TEST(AccuracyClimb, AnInterruptKeepsWhatIsFinishedAndDropsTheRungUnderWay)
{
    int runs = 0;
    ClimbCalls calls;
    calls.run = [&](const Rung& rung) {
        RungResult r = made_up(rung);
        if (++runs == 20) r.outcome = RungOutcome::stopped;
        return r;
    };
    std::size_t told = 0;
    calls.ends = [&](const std::vector<RungResult>& results) { told = results.size(); };
    ClimbOptions once;
    once.repeats = 1;
    const std::vector<RungResult> results = climb(facts_of_a_dam(), once, calls);
    EXPECT_EQ(results.size(), 19u);
    EXPECT_EQ(told, 19u);
    EXPECT_TRUE(std::all_of(results.begin(), results.end(), [](const RungResult& r) { return r.done(); }));
}

TEST(AccuracyClimb, RepeatsShortRungsForTheMedian)
{
    std::vector<double> seconds{0.9, 0.2, 0.4};
    std::size_t next = 0;
    ClimbCalls calls;
    calls.run = [&](const Rung& rung) {
        RungResult r = made_up(rung);
        r.seconds = seconds[next++ % seconds.size()];
        return r;
    };
    const RungResult r = run_repeatedly(Rung{}, 3, calls);
    EXPECT_EQ(r.repeats, 3);
    EXPECT_DOUBLE_EQ(r.seconds, 0.4);
    seconds = {2.0};
    EXPECT_EQ(run_repeatedly(Rung{}, 3, calls).repeats, 1);
}

} // namespace
