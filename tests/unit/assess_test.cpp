#include "analysis/assess/assess.hpp"
#include "pages/assess/assess_pages.hpp"
#include "program_answer.hpp"
#include "scene/read.hpp"
#include "source_dir.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

// What is said of numbers that are there: screening is run, finite elements are put in by hand.
namespace {

using namespace damslip;

constexpr double one_mm = 1e-3;

ContactRun fe_run_of(const std::string& record, int polarity, double slip_mm)
{
    ContactRun r;
    r.record = record;
    r.polarity = polarity;
    r.both = true;
    r.fe.status = Status::at_rest;
    r.fe.slip = r.fe.max_slip = slip_mm * one_mm;
    r.fe.slip_error = 0.2 * one_mm;
    r.mesh.check = MeshCheck::done;
    r.mesh.base = 0.3 * one_mm;
    return r;
}

MotionOutcome finite_elements(const std::string& what, double slip_mm, std::optional<Effect> without = {})
{
    MotionOutcome outcome;
    outcome.what = what;
    outcome.status = Status::at_rest;
    outcome.largest_slip = slip_mm * one_mm;
    outcome.without = without;
    return outcome;
}

/// The reference dam, whose rigid block slides 2.559 mm, without finite elements.
Assessment screened(double allowable_mm)
{
    Scene scene = read_scene(std::filesystem::path(source_dir()) / "examples/reference_dam_profile.toml");
    scene.criteria.allowable_slip = allowable_mm * one_mm;
    scene.criteria.document.clear();
    Assessment a;
    a.ready = prepare(scene, Method::rigid_block);
    a.screening = run_screening(a.ready, 1);
    return a;
}

/// 23 and 19 mm, each +- 0.5 mm.
Assessment with_finite_elements(double allowable_mm)
{
    Assessment a = screened(allowable_mm);
    a.fe = a.ready;
    const std::string record = a.ready.records().front().files.name;
    a.runs = {fe_run_of(record, 1, 23.0), fe_run_of(record, -1, 19.0)};
    a.spread.runs = {finite_elements("other polarity", 19.0), finite_elements("massless rock", 39.0),
                     finite_elements("added mass", 24.0)};
    return a;
}

TEST(Assess, RangeHoldsErrorPolarityAndWaterButNotMasslessRock)
{
    Assessment a = with_finite_elements(50);
    judge_assessment(a);
    ASSERT_TRUE(a.recommended);
    EXPECT_DOUBLE_EQ(a.recommended->slip, 23.0 * one_mm);
    EXPECT_DOUBLE_EQ(a.recommended->low, 19.0 * one_mm);
    EXPECT_DOUBLE_EQ(a.recommended->high, 24.0 * one_mm);
    a.spread.runs.clear();
    judge_assessment(a);
    EXPECT_NEAR(a.recommended->low, 22.5 * one_mm, 1e-9);
    EXPECT_NEAR(a.recommended->high, 23.5 * one_mm, 1e-9);
}

TEST(Assess, VerdictIsOfTheWholeRange)
{
    const auto verdict = [](double allowable_mm) {
        Assessment a = with_finite_elements(allowable_mm);
        judge_assessment(a);
        return a.verdict;
    };
    EXPECT_EQ(verdict(50), damslip::Verdict::pass);
    EXPECT_EQ(verdict(23.8), damslip::Verdict::undecided); // above the slip with its error, within the range
    EXPECT_EQ(verdict(21), damslip::Verdict::fail); // the worst run is above it, whatever the other polarity says
    EXPECT_EQ(verdict(10), damslip::Verdict::fail);
}

TEST(Assess, WithoutFiniteElementsABlockDoesNotPass)
{
    Assessment a = screened(5000);
    judge_assessment(a);
    ASSERT_TRUE(a.recommended);
    EXPECT_EQ(a.recommended->level, SlipLevel::rigid_block);
    EXPECT_EQ(a.verdict, damslip::Verdict::undecided);
    EXPECT_NE(pages::assess_headline(a).sentence.find("no upper bound"), std::string::npos);
}

TEST(Assess, RecordThatDidNotFitTakesThePassBack)
{
    Assessment a = with_finite_elements(50);
    std::vector<RecordPair> two = a.ready.records();
    two.push_back(two.front());
    two.back().files.name = "another";
    a.fe->pairs = std::make_shared<const std::vector<RecordPair>>(std::move(two));
    judge_assessment(a);
    EXPECT_EQ(a.verdict, damslip::Verdict::undecided);
}

/// Ends the computation when the n-th model of finite elements is begun.
class StopsAtModel final : public Watch {
public:
    explicit StopsAtModel(int n) : last_(n) {}
    bool stop_asked() const override { return begun_ >= last_; }
    void begin(const std::string& label, double) override
    {
        if (label == "fe") ++begun_;
    }

private:
    int last_;
    std::atomic<int> begun_ = 0;
};

TEST(Assess, PolarityThatDidNotFitTakesThePassBack)
{
    Assessment a = with_finite_elements(50);
    a.runs.pop_back();
    a.spread.runs.clear();
    judge_assessment(a);
    EXPECT_EQ(a.verdict, damslip::Verdict::undecided);
    EXPECT_NE(a.verdict_reason.find("polarity"), std::string::npos);
}

TEST(Assess, RangeOfARunWithoutErrorHoldsTheOtherPolarityWithIts)
{
    Assessment a = with_finite_elements(50);
    a.spread.runs.clear();
    a.runs[0].mesh.check = MeshCheck::no_answer; // 23 mm, on a coarser mesh
    judge_assessment(a);
    EXPECT_FALSE(a.recommended->error_known);
    EXPECT_DOUBLE_EQ(a.recommended->slip, 23.0 * one_mm);
    EXPECT_NEAR(a.recommended->low, 18.5 * one_mm, 1e-9);
    EXPECT_NEAR(a.recommended->high, 23.0 * one_mm, 1e-9);
    EXPECT_EQ(a.verdict, damslip::Verdict::undecided);
}

TEST(Assess, TimeForElementsOfTwiceTheSizeAloneGivesTheirSlipWithoutAnError)
{
    Scene scene = read_scene(std::filesystem::path(source_dir()) / "examples/reference_dam_profile.toml");
    scene.mesh.size = 4.0;
    scene.mesh.contact_size = 2.5;
    scene.criteria.allowable_slip = 5.0;
    StopsAtModel watch(2); // the first is the coarser one
    Assessment a = assess(scene, {1e6, 1}, watch);
    EXPECT_TRUE(a.interrupted);
    EXPECT_FALSE(a.recommended);
    EXPECT_EQ(exit_code_of(a), exit_no_answer);
    a.interrupted = false; // as if the time, not the user, had ended it there
    judge_assessment(a);
    ASSERT_TRUE(a.recommended);
    EXPECT_EQ(a.recommended->level, SlipLevel::finite_elements);
    EXPECT_EQ(a.runs.size(), 2u); // both polarities
    EXPECT_FALSE(a.recommended->error_known);
    EXPECT_LT(a.recommended->low, a.recommended->slip); // the other polarity
    EXPECT_EQ(a.verdict, damslip::Verdict::undecided);  // far below 5 m, but the error is not known
    EXPECT_TRUE(std::any_of(a.left_out.begin(), a.left_out.end(),
                            [](const LeftOut& l) { return l.what.find("twice the size") != std::string::npos; }));
    StopsAtModel sooner(1);
    const Assessment none = assess(scene, {1e6, 1}, sooner);
    EXPECT_TRUE(none.runs.empty());
}

TEST(Assess, LevelsThreeTimesApartNameAnAssumptionInWhichTheyDiffer)
{
    Assessment a = with_finite_elements(50);
    // Without uplift the number would be nearest to the block's 2.56 mm; but the block has the uplift, too.
    a.assumptions = {finite_elements("without uplift", 2.5, Effect::uplift), finite_elements(rigid_dam, 3.7),
                     finite_elements("without separation", 21.0, Effect::separation)};
    judge_assessment(a);
    const auto rigid = std::find_if(a.disagreements.begin(), a.disagreements.end(),
                                    [](const Disagreement& d) { return d.lower.level == SlipLevel::rigid_block; });
    ASSERT_NE(rigid, a.disagreements.end());
    EXPECT_EQ(rigid->higher.level, SlipLevel::finite_elements);
    ASSERT_TRUE(rigid->closest);
    EXPECT_EQ(rigid->closest->what, "rigid dam on rigid rock");
    EXPECT_TRUE(rigid->explains);
    a.assumptions.erase(a.assumptions.begin() + 1);
    judge_assessment(a);
    for (const Disagreement& d : a.disagreements) EXPECT_FALSE(d.explains); // 21 mm is no way to 2.6 mm
    const std::vector<std::string> said = pages::disagreement_sentences(a);
    ASSERT_FALSE(said.empty());
    EXPECT_NE(said.front().find("No single assumption"), std::string::npos);
}

TEST(Assess, LevelsWithinThreeTimesAreNotAskedFor)
{
    Assessment a = with_finite_elements(50);
    for (ContactRun& r : a.runs) r.fe.slip = r.fe.max_slip = 4.0 * one_mm;
    judge_assessment(a);
    EXPECT_TRUE(a.disagreements.empty()); // 4 mm beside 2.56 and a median of 4.19 mm
}

TEST(Assess, DamThatDoesNotStandFails)
{
    Assessment a = screened(50);
    Scene scene = a.ready.given;
    scene.contact.friction = 0.3;
    a.ready = prepare(scene, Method::rigid_block);
    a.screening = run_screening(a.ready, 1);
    judge_assessment(a);
    EXPECT_EQ(a.verdict, damslip::Verdict::fail);
    EXPECT_NE(a.verdict_reason.find("does not stand"), std::string::npos);
}

TEST(Assess, WhatIsLeftOutIsNamedInEveryForm)
{
    Assessment a = with_finite_elements(50);
    a.left_out.push_back({"finite elements, without uplift", "3 s would not do"});
    a.left_out.push_back({"finite elements, without separation", "3 s would not do"});
    judge_assessment(a);
    const std::string sentence =
        "Not run (3 s would not do): finite elements, without uplift; finite elements, without separation.";
    EXPECT_NE(pages::assess_answer(a, a.ready.given).full().find(sentence), std::string::npos);
    const auto notes = pages::assess_answer(a, a.ready.given).json()["notes"];
    EXPECT_NE(std::find(notes.begin(), notes.end(), sentence), notes.end());
    const std::vector<std::string> warnings = pages::assess_page(a, a.ready.given, {.ready = a.ready, .fe = {}, .rock_change = {}, .parts = {}}).warnings;
    EXPECT_NE(std::find(warnings.begin(), warnings.end(), sentence), warnings.end());
}

TEST(Assess, NumbersAreTheOnesOfTheJson)
{
    Assessment a = with_finite_elements(50);
    judge_assessment(a);
    const nlohmann::ordered_json j = pages::assess_answer(a, a.ready.given).json();
    EXPECT_EQ(j["verdict"], "PASS");
    EXPECT_NEAR(j["recommended"]["slip_mm"].get<double>(), 23.0, 1e-9);
    const auto fe = std::find_if(j["levels"].begin(), j["levels"].end(),
                                 [](const auto& row) { return row["level"] == "finite elements"; });
    ASSERT_NE(fe, j["levels"].end());
    EXPECT_NEAR((*fe)["high_mm"].template get<double>(), 23.5, 1e-9);
}

TEST(AssessCommand, BadInputIsRefusedBeforeAnythingRuns)
{
    const std::string dam = std::string(source_dir()) + "/examples/reference_dam_profile.toml";
    const ProgramAnswer no_time = answer_of({"assess", dam, "--budget", "0"});
    EXPECT_EQ(no_time.code, 2);
    EXPECT_NE(no_time.talk.find("seconds > 0"), std::string::npos);
    const ProgramAnswer no_record = answer_of({"assess", std::string(source_dir()) + "/examples/koyna.toml"});
    EXPECT_EQ(no_record.code, 3);
    EXPECT_NE(no_record.talk.find("--record FILE"), std::string::npos);
    const ProgramAnswer wedge = answer_of({"assess", std::string(source_dir()) + "/examples/rock_wedge.toml"});
    EXPECT_EQ(wedge.code, 3);
}

} // namespace
