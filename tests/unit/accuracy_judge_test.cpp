// The hierarchy's judgement: orders, limits, errors, front and choice from results that are made up, so that each is known.
#include "analysis/accuracy/accuracy.hpp"
#include "analysis/accuracy/hierarchy.hpp"
#include "scene/read.hpp"
#include "scene/rock_mass.hpp"
#include "source_dir.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <random>

namespace {

using namespace damslip;

constexpr double exact = 0.05; // [m]

/// Slip of an FE model whose errors are known: 0.01 (dt/2^k)^1.5 + 0.002 h^1.2, and 0.3/penalty, 0.02/modes.
double slip_of(const ModelLevel& r)
{
    double slip = exact + 0.01 * std::exp2(-1.5 * r.halvings) + 0.002 * std::pow(r.mesh, 1.2);
    if (r.water == ModelLevelWater::added_mass) slip *= 0.8;
    if (r.tangential_stiffness) slip += 0.3e8 / *r.tangential_stiffness;
    if (r.modes) slip += 0.004 / *r.modes;
    return slip;
}

MotionOutcome at_rest(double slip)
{
    MotionOutcome outcome;
    outcome.status = Status::at_rest;
    outcome.slip = slip;
    return outcome;
}

/// Seconds go with steps, and with the number of elements.
ModelLevelResult made_up(const ModelLevel& model_level)
{
    ModelLevelResult r;
    r.model_level = model_level;
    r.status = Status::at_rest;
    r.repeats = 1;
    if (model_level.family == ModelLevelFamily::finite_elements) {
        r.motions = {at_rest(slip_of(model_level))};
        r.set_up_seconds = 0.1;
        r.seconds = 0.1 + 0.2 * std::exp2(model_level.halvings) * std::pow(model_level.mesh, -2.0);
        if (model_level.modes) r.seconds *= 0.2;
        if (!model_level.element.empty()) r.seconds *= 3.5;
        r.time_step = 0.01 / std::exp2(model_level.halvings);
    } else {
        r.motions = {at_rest(model_level.family == ModelLevelFamily::rigid ? 0.03 : 0.02)};
        r.seconds = 0.001;
    }
    return r;
}

HierarchyFacts facts_of_a_dam()
{
    HierarchyFacts facts;
    facts.regressions = {"jibson-1998", "ensemble"};
    facts.vertical = true;
    facts.waters = {ModelLevelWater::added_mass, ModelLevelWater::acoustic};
    facts.reducible = true;
    facts.alphas = {0.0, -0.3};
    facts.coarsest = 4.0;
    facts.quadratic = true;
    return facts;
}

std::vector<ModelLevelResult> levels_run(const HierarchyRunOptions& options = {})
{
    HierarchyCalls calls;
    calls.run = made_up;
    return run_hierarchy(facts_of_a_dam(), options, calls);
}

const ModelLevelResult* model_level(const std::vector<ModelLevelResult>& results, const std::string& id)
{
    const auto at = std::find_if(results.begin(), results.end(), [&](const auto& r) { return model_level_id(r.model_level) == id; });
    return at == results.end() ? nullptr : &*at;
}

const ModelLevelVerdict& verdict(const std::vector<ModelLevelResult>& results, const Judgement& j, const std::string& id)
{
    return j.model_levels.at(static_cast<std::size_t>(model_level(results, id) - results.data()));
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

// One table: what the model spread runs beside a scene is a model level, too, and then no other model any more.
TEST(AccuracyModelLevel, OtherModelsAreLevelsByTheirWords)
{
    Scene scene = read_scene(std::filesystem::path(source_dir()) / "examples/reference_dam.toml");
    ASSERT_TRUE(scene.foundation);
    for (const Scene& start : {with_massless_rock(scene), with_radiating_rock(scene)})
        for (const OtherModel& other : other_models()) {
            if (other.level_word.empty() || !other.concerns(start)) continue;
            const auto level = parse_model_level("fe-added-mass:dt," + std::string(other.level_word));
            ASSERT_TRUE(level) << other.level_word;
            EXPECT_EQ(model_level_id(*level), "fe-added-mass:dt," + std::string(other.level_word));
            EXPECT_NE(rock_kind(scene_of(start, *level)), rock_kind(start)) << other.name;
            EXPECT_FALSE(other.concerns(scene_of(start, *level))) << other.name;
        }
    EXPECT_FALSE(parse_model_level("fe-added-mass:dt,rock=other"));
    EXPECT_EQ(scene_of(scene, *parse_model_level("fe-acoustic:dt")).reservoir->model, ReservoirModel::acoustic);
    EXPECT_EQ(scene_of(scene, *parse_model_level("fe-hydrostatic:dt")).reservoir->model, ReservoirModel::hydrostatic);
}

TEST(AccuracyModelLevel, NamesReadBack)
{
    const std::vector<ModelLevelResult> results = levels_run();
    ASSERT_GT(results.size(), 25u);
    for (const ModelLevelResult& r : results) {
        const auto back = parse_model_level(model_level_id(r.model_level));
        ASSERT_TRUE(back) << model_level_id(r.model_level);
        EXPECT_EQ(*back, r.model_level) << model_level_id(r.model_level);
    }
    for (const char* wrong :
         {"", "rigid", "rigid:v", "fe:dt", "fe-acoustic:dt/3", "fe-acoustic:dt/-2", "fe-acoustic:h/0",
          "fe-acoustic:dt,h", "fe-acoustic:dt,alpha=0.5", "fe-acoustic:dt,modes=1"})
        EXPECT_FALSE(parse_model_level(wrong)) << wrong;
}

TEST(AccuracyHierarchy, QuadraticElementsStandBesideLinearOnesOfTheSameStep)
{
    const std::vector<ModelLevelResult> results = levels_run();
    int found = 0;
    for (const ModelLevelResult& r : results) {
        if (r.model_level.element.empty()) continue;
        ++found;
        EXPECT_EQ(r.model_level.water, ModelLevelWater::acoustic);
        EXPECT_FALSE(r.model_level.plain());
        ModelLevel linear = r.model_level;
        linear.element.clear();
        EXPECT_TRUE(model_level(results, model_level_id(linear))) << model_level_id(linear);
        linear.mesh *= 0.5;
        EXPECT_TRUE(model_level(results, model_level_id(linear))) << model_level_id(linear);
        EXPECT_GT(*expected_seconds(r.model_level, results, true), 0.0);
    }
    EXPECT_EQ(found, 2);
}

TEST(AccuracyHierarchy, CorrectedStepsCostLessThanHalvedOnes)
{
    const std::vector<ModelLevelResult> results = levels_run();
    ModelLevel chosen = fe_model_level(ModelLevelWater::acoustic, 0);
    chosen.step = StepChoice::by_tolerance;
    EXPECT_LT(*expected_seconds(chosen, results, true), *expected_seconds(chosen, results, false));
    ModelLevel quarters = fe_model_level(ModelLevelWater::acoustic, 2);
    EXPECT_GT(*expected_seconds(chosen, results, true), *expected_seconds(quarters, results, true));
}

TEST(AccuracyHierarchy, HasOnlyModelLevelsThatDifferForTheScene)
{
    HierarchyFacts rigid;
    EXPECT_EQ(hierarchy(rigid, {}, {}).size(), 1u); // no vertical record, no regression, no elastic dam
    HierarchyFacts dry = facts_of_a_dam();
    dry.waters = {ModelLevelWater::dry};
    HierarchyCalls calls;
    calls.run = made_up;
    for (const ModelLevelResult& r : run_hierarchy(dry, {}, calls)) EXPECT_EQ(model_level_id(r.model_level).find("acoustic"), std::string::npos);
}

TEST(AccuracyHierarchy, EndsWithTheFinestModelLevelOfTheRichestModel)
{
    const std::vector<ModelLevelResult> results = levels_run();
    EXPECT_EQ(*top_model_level(results), results.size() - 1);
    EXPECT_EQ(results.back().model_level.water, ModelLevelWater::acoustic);
    EXPECT_LT(results.back().model_level.mesh, 1.0);
    HierarchyRunOptions quick;
    quick.hierarchy.effort = Effort::quick;
    EXPECT_LT(levels_run(quick).size(), results.size());
}

TEST(AccuracyHierarchy, HalvesStepsUntilTheSlipIsSettled)
{
    HierarchyRunOptions options;
    options.hierarchy.tolerance = 0.02;
    const std::size_t coarse = step_row(levels_run(options), ModelLevelWater::acoustic).size();
    options.hierarchy.tolerance = 0.001;
    EXPECT_GT(step_row(levels_run(options), ModelLevelWater::acoustic).size(), coarse);
}

// The true errors are known: estimates of all model levels of the model lie within a factor of two, most within 10 %.
TEST(AccuracyJudge, EstimatesErrorsOfStepMeshPenaltyAndModes)
{
    const std::vector<ModelLevelResult> results = levels_run();
    const Judgement j = judge_model_levels(results, 0.02);
    int checked = 0;
    for (std::size_t i = 0; i < results.size(); ++i) {
        const ModelLevel& r = results[i].model_level;
        if (r.family != ModelLevelFamily::finite_elements) continue;
        const double truth = std::abs(results[i].slip(0) - (r.water == ModelLevelWater::added_mass ? 0.8 : 1.0) * exact);
        ASSERT_TRUE(j.model_levels[i].error);
        EXPECT_GT(*j.model_levels[i].error, 0.5 * truth) << model_level_id(r);
        EXPECT_LT(*j.model_levels[i].error, 2.0 * truth) << model_level_id(r);
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
    const std::vector<ModelLevelResult> results = levels_run();
    const Judgement j = judge_model_levels(results, 0.02);
    // Added mass tends to 0.8 of the acoustic slip, whatever the model level; 2 % of that for the extrapolations.
    EXPECT_NEAR(*verdict(results, j, "fe-added-mass:dt").model_difference, -0.2 * exact, 0.02 * exact);
    EXPECT_NEAR(*verdict(results, j, "fe-added-mass:dt/8").model_difference, -0.2 * exact, 0.02 * exact);
    EXPECT_EQ(*verdict(results, j, "rigid:h").error, 0.0);
    EXPECT_FALSE(verdict(results, j, "regression:ensemble").error);
    EXPECT_GT(*verdict(results, j, "regression:ensemble").deviation, 0.5);
}

TEST(AccuracyJudge, DeviationContainsWhatTheTopLeavesOpenAndTheWorstRecordCounts)
{
    std::vector<ModelLevelResult> results = levels_run();
    for (ModelLevelResult& r : results) r.motions.push_back(at_rest(2.0 * r.slip(0) + (r.model_level.modes ? 0.01 : 0.0)));
    const Judgement j = judge_model_levels(results, 0.02);
    EXPECT_EQ(j.motion, 1u); // the larger slip
    EXPECT_GT(*j.top_error, 0.0);
    for (const ModelLevelVerdict& v : j.model_levels) EXPECT_GE(*v.deviation, *j.top_error);
    const ModelLevelResult& reduced =
        *std::find_if(results.begin(), results.end(), [](const ModelLevelResult& r) { return r.model_level.modes.has_value(); });
    const ModelLevelResult& top = results[*j.top];
    EXPECT_GE(*verdict(results, j, model_level_id(reduced.model_level)).deviation,
              std::abs(reduced.slip(1) - top.slip(1)) / top.slip(1));
}

TEST(AccuracyJudge, NamesNoneWhereAFinerModelLevelHasNoSlip)
{
    std::vector<ModelLevelResult> results = levels_run();
    ASSERT_TRUE(judge_model_levels(results, 0.1).choice);
    results.back().status = Status::not_resolved;
    const Judgement j = judge_model_levels(results, 0.1);
    EXPECT_FALSE(j.choice);
    EXPECT_EQ(*j.contradiction, results.size() - 1);
    results.back().skipped = true; // for want of seconds: the next finest is the top
    EXPECT_TRUE(judge_model_levels(results, 0.1).choice);
}

// Over random model levels: a larger tolerance never names a slower one, and what is named is on the front or as fast.
TEST(AccuracyJudge, LargerToleranceNeverNamesASlowerModelLevel)
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

TEST(AccuracyRuns, ListsWhatExceedsTheBudgetAndKeepsWhatFailed)
{
    HierarchyRunOptions options;
    options.budget = 2.0; // made-up model levels take no time, but say what they would
    const std::vector<ModelLevelResult> results = levels_run(options);
    const auto skipped = std::count_if(results.begin(), results.end(),
                                       [](const ModelLevelResult& r) { return r.skipped; });
    EXPECT_GT(skipped, 0);
    for (const ModelLevelResult& r : results)
        EXPECT_TRUE(!r.skipped || r.seconds >= 1.5) << model_level_id(r.model_level);
    HierarchyCalls failing;
    failing.run = [](const ModelLevel& model_level) {
        ModelLevelResult r = made_up(model_level);
        if (model_level.water == ModelLevelWater::acoustic && model_level.family == ModelLevelFamily::finite_elements) {
            r.status = Status::refused;
            r.motions.clear();
        }
        return r;
    };
    const std::vector<ModelLevelResult> poor = run_hierarchy(facts_of_a_dam(), {}, failing);
    EXPECT_EQ(poor[*top_model_level(poor)].model_level.water, ModelLevelWater::added_mass);
    EXPECT_TRUE(model_level(poor, "fe-acoustic:dt"));
}

TEST(AccuracyRuns, AnInterruptKeepsWhatIsFinishedAndDropsTheModelLevelUnderWay)
{
    int runs = 0;
    HierarchyCalls calls;
    calls.run = [&](const ModelLevel& model_level) {
        ModelLevelResult r = made_up(model_level);
        if (++runs == 20) r.status = Status::interrupted;
        return r;
    };
    std::size_t told = 0;
    calls.ends = [&](const std::vector<ModelLevelResult>& results) { told = results.size(); };
    HierarchyRunOptions once;
    once.repeats = 1;
    const std::vector<ModelLevelResult> results = run_hierarchy(facts_of_a_dam(), once, calls);
    EXPECT_EQ(results.size(), 19u);
    EXPECT_EQ(told, 19u);
    EXPECT_TRUE(std::all_of(results.begin(), results.end(), [](const ModelLevelResult& r) { return r.done(); }));
}

TEST(AccuracyRuns, RepeatsShortModelLevelsForTheMedian)
{
    std::vector<double> seconds{0.9, 0.2, 0.4};
    std::size_t next = 0;
    HierarchyCalls calls;
    calls.run = [&](const ModelLevel& model_level) {
        ModelLevelResult r = made_up(model_level);
        r.seconds = seconds[next++ % seconds.size()];
        return r;
    };
    const ModelLevelResult r = run_repeatedly(ModelLevel{}, 3, calls);
    EXPECT_EQ(r.repeats, 3);
    EXPECT_DOUBLE_EQ(r.seconds, 0.4);
    seconds = {2.0};
    EXPECT_EQ(run_repeatedly(ModelLevel{}, 3, calls).repeats, 1);
}

} // namespace
