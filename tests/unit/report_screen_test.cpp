#include "core/units.hpp"
#include "pages/screen/screen_pages.hpp"
#include "scene/read.hpp"
#include "source_dir.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>

namespace {

using namespace damslip;
using namespace damslip;
using namespace damslip::pages;

/// The scene of the browser test, which names its records.
Scene report_scene()
{
    return read_scene(std::filesystem::path(source_dir()) / "tests/report/dam.toml");
}

struct ReportRun {
    Scene scene;
    std::vector<RecordPair> records;
    Screening screening;
};

ReportRun report_run(const Scene& given)
{
    const Ready ready = prepare(given, Method::rigid_block);
    return {ready.scene, ready.records(), run_screening(ready, 1)};
}

std::vector<const pages::Chart*> charts_of(const pages::Page& page)
{
    std::vector<const pages::Chart*> charts;
    for (const pages::Section& section : page.sections)
        for (const pages::Part& part : section.parts)
            if (const auto* chart = std::get_if<pages::Chart>(&part)) charts.push_back(chart);
    return charts;
}

const pages::Chart* chart_named(const pages::Page& page, const std::string& title)
{
    for (const pages::Chart* chart : charts_of(page))
        if (chart->title == title) return chart;
    return nullptr;
}

TEST(ScreenReport, EveryChartHasFiniteValuesInEachCurve)
{
    const ReportRun run = report_run(report_scene());
    const pages::Page page = screen_page({report_scene(), run.scene, run.screening, run.records, 1});
    const auto charts = charts_of(page);
    EXPECT_GE(charts.size(), 9u);
    for (const pages::Chart* chart : charts) {
        EXPECT_FALSE(chart->curves.empty()) << chart->title;
        for (const pages::Curve& curve : chart->curves)
            EXPECT_TRUE(std::any_of(curve.y.begin(), curve.y.end(), [](double v) { return std::isfinite(v); }))
                << chart->title << ", " << curve.name;
    }
}

TEST(ScreenReport, ChartsAgreeWithTheScreening)
{
    const ReportRun run = report_run(report_scene());
    const Screening& s = run.screening;
    const pages::Page page = screen_page({report_scene(), run.scene, s, run.records, 1});
    const double mu = run.scene.contact.friction;

    // Friction is varied through the scene's own value, where the largest slip is that of the table to the last bit.
    const pages::Chart* slip = chart_named(page, "Slip over friction");
    ASSERT_NE(slip, nullptr);
    const auto& x = slip->curves[0].x;
    const auto at = std::find(x.begin(), x.end(), mu);
    ASSERT_NE(at, x.end());
    const double expected = std::max(s.slips[0].rigid().max_slip, s.slips[1].rigid().max_slip) / units::mm;
    EXPECT_GT(expected, 1.0);
    EXPECT_EQ(slip->curves[0].y[static_cast<std::size_t>(at - x.begin())], expected);

    // a_y is linear in friction: interpolated to the scene's value it is the table's.
    const pages::Chart* yield = chart_named(page, "Yield acceleration over friction");
    ASSERT_NE(yield, nullptr);
    const pages::Curve& own = yield->curves[0];
    const double slope = (own.y.back() - own.y.front()) / (own.x.back() - own.x.front());
    EXPECT_NEAR(own.y.front() + slope * (mu - own.x.front()), s.bases.front().model.downstream.law.constant, 1e-12);

    // The history ends at the slip of the table.
    const pages::Chart* history = chart_named(page, "pulses <1>: slip");
    ASSERT_NE(history, nullptr);
    ASSERT_EQ(history->curves.size(), 2u);
    const double end = std::max(std::abs(s.slips[0].with_vertical->slip), std::abs(s.slips[1].with_vertical->slip));
    EXPECT_NEAR(history->curves[1].y.back(), end / units::mm, 1e-9 * end / units::mm);
}

TEST(ScreenReport, HeadlineJudgesBySlipAndStaticState)
{
    Scene scene = report_scene();
    scene.motion.scale = 0.9; // 0.54 g: at 0.57 g it tips upstream before it slides that way, and nothing is decided
    ReportRun run = report_run(scene);
    const double worst = std::max(run.screening.slips[0].judged().max_slip, run.screening.slips[1].judged().max_slip);

    scene.criteria.allowable_slip = 0.99 * worst;
    run = report_run(scene);
    EXPECT_EQ(screen_headline(run.scene, run.screening).outcome, pages::Outcome::fail);

    scene.criteria.allowable_slip = 1.01 * worst;
    run = report_run(scene);
    EXPECT_NE(screen_headline(run.scene, run.screening).outcome, pages::Outcome::fail);
    EXPECT_EQ(screen_headline(run.scene, run.screening).verdict,
              "Below the allowable as a rigid block; elasticity not checked.");

    scene.criteria.allowable_slip.reset();
    run = report_run(scene);
    EXPECT_EQ(screen_headline(run.scene, run.screening).verdict, "No criterion for the slip.");

    scene.contact.friction = 0.3; // below what holds the dam
    run = report_run(scene);
    EXPECT_EQ(screen_headline(run.scene, run.screening).outcome, pages::Outcome::fail);
    EXPECT_NE(screen_headline(run.scene, run.screening).sentence.find("without any earthquake"), std::string::npos);
}

TEST(ScreenReport, ASceneWithoutRecordsOrWaterHasAReportToo)
{
    Scene scene =
        parse_scene("[section]\nheight_m = 10\nbase_m = 8\n[dam]\ndensity_kg_m3 = 2500\n[contact]\nfriction = 0.6\n",
                    "block.toml", FileCheck::skip);
    const ReportRun run = report_run(scene);
    const std::string html = page_html(screen_page({scene, run.scene, run.screening, run.records, 1}));
    EXPECT_NE(html.find("no record is given"), std::string::npos);
}

TEST(ScreenReport, SameBytesForAnyNumberOfThreads)
{
    const ReportRun run = report_run(report_scene());
    const Scene given = report_scene();
    EXPECT_EQ(page_html(screen_page({given, run.scene, run.screening, run.records, 1})),
              page_html(screen_page({given, run.scene, run.screening, run.records, 2})));
}

} // namespace
