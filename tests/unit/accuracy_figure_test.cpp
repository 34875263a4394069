// What the hierarchy's figure, tables and sentence say of a few results that are made up.
#include "pages/accuracy/accuracy_pages.hpp"

#include <gtest/gtest.h>

namespace {

using namespace damslip;
using namespace damslip::pages;

ModelLevelResult result(const std::string& id, double slip, double seconds)
{
    ModelLevelResult r;
    r.model_level = parse_model_level(id).value();
    r.status = Status::at_rest;
    r.motions.emplace_back().slip = slip;
    r.seconds = seconds;
    r.repeats = 1;
    return r;
}

/// Second order in the step: 50 mm + 8 mm/4^k; the limit is 50 mm, the finest model level errs by 0.125 mm.
std::vector<ModelLevelResult> results()
{
    std::vector<ModelLevelResult> all{result("rigid:h", 0.03, 0.01), result("fe-dry:dt", 0.058, 0.1),
                                result("fe-dry:dt/2", 0.052, 0.2), result("fe-dry:dt/4", 0.0505, 0.4),
                                result("fe-dry:dt/8", 0.050125, 0.8)};
    all.push_back(result("fe-dry:dt/4,stick=1e+10", 0.06, 0.9)); // slower and worse
    all.push_back(result("fe-dry:dt/8,h/2", 0.05, 9.0));
    all.back().skipped = true;
    all.back().status = Status::not_resolved;
    all.back().motions.clear();
    all.back().remark = "about 9 s, 3 s of the budget left";
    return all;
}

TEST(AccuracyFigure, NamesTheFrontTheChoiceAndTheTolerance)
{
    const auto all = results();
    const Judgement j = judge_model_levels(all, 0.02);
    const std::string svg = cost_figure(all, j, 0.02, "Dam <1>", FigureStyle::standalone);
    EXPECT_EQ(svg.find("<1>"), std::string::npos);
    EXPECT_NE(svg.find("Dam &lt;1&gt;"), std::string::npos);
    for (const char* name : {">rigid:h<", ">fe-dry:dt<", ">fe-dry:dt/4<", ">fe-dry:dt/8<", ">tolerance 2 %<"})
        EXPECT_NE(svg.find(name), std::string::npos) << name;
    EXPECT_EQ(svg.find("h/2"), std::string::npos); // skipped: no dot
    EXPECT_NE(svg.find("prefers-color-scheme: dark"), std::string::npos);
    const std::string inside = cost_figure(all, j, 0.02, "Dam", FigureStyle::page);
    EXPECT_EQ(inside.find("prefers-color-scheme"), std::string::npos); // the page has the colours
    EXPECT_TRUE(cost_figure({}, judge_model_levels({}, 0.02), 0.02, "", FigureStyle::page).empty());
}

TEST(AccuracyFigure, TheSentenceSaysTheModelLevelItsSlipTimeAndDeviation)
{
    const auto all = results();
    // dt/4: 0.375 mm from the finest, which errs by 0.125 mm: 0.5 mm of 50.125 mm.
    EXPECT_EQ(choice_sentence(all, judge_model_levels(all, 0.02), 0.02),
              "Cheapest model level within 2 %: fe-dry:dt/4, slip 50.5 mm in 0.4 s, 1 % from the finest (fe-dry:dt/8, "
              "0.8 s).");
    EXPECT_EQ(choice_sentence(all, judge_model_levels(all, 0.001), 0.001),
              "No model level is within 0.1 %: the finest one, fe-dry:dt/8, itself leaves 0.25 % open.");
    EXPECT_EQ(choice_sentence({}, judge_model_levels({}, 0.02), 0.02), "No model level has a slip to compare.");
}

TEST(AccuracyFigure, TheTableKeepsWhatWasSkippedAndWhy)
{
    const auto all = results();
    const Table t = model_level_table(all, judge_model_levels(all, 0.02));
    ASSERT_EQ(t.rows.size(), all.size());
    for (const auto& row : t.rows) EXPECT_EQ(row.size(), t.columns.size());
    EXPECT_EQ(std::get<std::string>(t.rows.back().back()), "skipped: about 9 s, 3 s of the budget left");
    EXPECT_TRUE(std::holds_alternative<std::monostate>(t.rows.back()[1]));
    const Table models = model_table(all, judge_model_levels(all, 0.02));
    ASSERT_EQ(models.rows.size(), 2u); // the rigid block, and the dry dam with its limit
    EXPECT_NEAR(std::get<double>(models.rows[1][1]), 50.0, 1e-9);
    EXPECT_NEAR(std::get<double>(models.rows[1][4]), 2.0, 1e-9);
}

} // namespace
