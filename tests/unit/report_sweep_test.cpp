// The report of a sweep: its charts say what the rows say.
#include "pages/sweep/sweep_pages.hpp"
#include "scene/read.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace damslip;
using namespace damslip;
using namespace damslip::pages;

struct TestRow {
    SweepVariant variant;
    std::string record, method, status;
    SweepRow row;
};

/// Slip of a row in mm, chosen so that every row is told from every other:
/// 100 (1 - μ) + 10 level index + record + method; polarity -1 slides half as far. Critical friction 0.7.
std::vector<TestRow> sweep_rows(int records = 3)
{
    std::vector<TestRow> rows;
    for (const double friction : {0.9, 0.8, 0.65})
        for (const double level : {60.0, 50.0})
            for (const int polarity : {1, -1})
                for (int record = 1; record <= records; ++record)
                    for (const std::string method : {"rigid", "fe"}) {
                        TestRow& made = rows.emplace_back();
                        made.variant = {.level = level, .uplift = "linear", .reservoir = "auto"};
                        made.record = "record " + std::to_string(record);
                        made.method = method;
                        made.status = friction > 0.7 ? "at rest" : "static failure";
                        SweepRow& row = made.row;
                        row.id = static_cast<std::int64_t>(rows.size()) - 1;
                        row.friction = friction;
                        row.polarity = polarity;
                        row.yield_acceleration = 10.0 * (friction - 0.7);
                        row.pga = 2.0;
                        row.critical_friction = 0.7;
                        if (friction > 0.7)
                            row.slip = 1e-3 *
                                       (100 * (1 - friction) + (level == 60.0 ? 10 : 0) + record +
                                        (method == "fe" ? 20 : 0)) *
                                       (polarity > 0 ? 1.0 : 0.5);
                    }
    return rows;
}

SweepView view_of(const std::vector<TestRow>& rows)
{
    SweepViewMaker maker;
    for (const TestRow& r : rows) {
        SweepRow row = r.row;
        row.record = r.record;
        row.method = r.method;
        row.status = r.status;
        maker.add(r.variant, row);
    }
    return maker.view();
}

TEST(SweepReport, ViewReadsVariantsMethodsAndStaticFailures)
{
    const SweepView view = view_of(sweep_rows());
    ASSERT_EQ(view.variants.size(), 2u);
    EXPECT_EQ(view.variant_names[0], "level 60 m"); // only what differs
    EXPECT_EQ(view.frictions, (std::vector<double>{0.65, 0.8, 0.9}));
    EXPECT_EQ(view.records.size(), 3u);
    EXPECT_EQ(std::count_if(view.rows.begin(), view.rows.end(), [](const SweepRow& r) { return r.fails_statically(); }),
              24);
    EXPECT_TRUE(std::none_of(view.rows.begin(), view.rows.end(), [](const SweepRow& r) { return r.unanswered(); }));
}

TEST(SweepReport, SlipOverFrictionIsTheLargestOfFewRecords)
{
    const SweepView view = view_of(sweep_rows());
    const pages::Chart chart = slip_over_friction(view, 0, 0.04);
    ASSERT_EQ(chart.curves.size(), 2u);
    const pages::Curve& fe = chart.curves[1];
    EXPECT_EQ(fe.name, "fe");
    EXPECT_TRUE(fe.low.empty());
    EXPECT_TRUE(std::isnan(fe.y[0])); // slides statically
    EXPECT_NEAR(fe.y[1], 20 + 10 + 3 + 20, 1e-9);
    ASSERT_EQ(chart.vertical.size(), 1u);
    EXPECT_EQ(chart.vertical[0].at, 0.7);
    ASSERT_EQ(chart.horizontal.size(), 1u);
    EXPECT_EQ(chart.horizontal[0].at, 40.0);
    EXPECT_NEAR(slip_over_friction(view, 1, {}).curves[0].y[1], 20 + 3, 1e-9);
}

TEST(SweepReport, SlipOverFrictionIsTheMedianOfManyRecordsWithABandOfOneMethod)
{
    const SweepView view = view_of(sweep_rows(5));
    const pages::Chart chart = slip_over_friction(view, 0, {});
    ASSERT_EQ(chart.curves.size(), 2u);
    const pages::Curve& fe = chart.curves[1];
    EXPECT_NEAR(fe.y[1], 20 + 10 + 3 + 20, 1e-9);
    EXPECT_NEAR(fe.low[1], 20 + 10 + 1 + 20, 1e-9);
    EXPECT_NEAR(fe.high[2], 10 + 10 + 5 + 20, 1e-9);
    EXPECT_TRUE(chart.curves[0].low.empty());
}

TEST(SweepReport, FeOverRigidPairsTheSameMotions)
{
    const auto chart = fe_over_rigid(view_of(sweep_rows()));
    ASSERT_TRUE(chart);
    const pages::Curve& fe = chart->curves[0];
    ASSERT_EQ(fe.x.size(), 24u); // 2 frictions that stand, 2 levels, 2 polarities, 3 records
    for (std::size_t i = 0; i < fe.x.size(); ++i) {
        const double more = fe.y[i] - fe.x[i];
        EXPECT_TRUE(std::abs(more - 20) < 1e-9 || std::abs(more - 10) < 1e-9) << more;
    }
    std::vector<TestRow> rigid_only = sweep_rows();
    std::erase_if(rigid_only, [](const TestRow& row) { return row.method == "fe"; });
    EXPECT_FALSE(fe_over_rigid(view_of(rigid_only)));
}

TEST(SweepReport, PointsOverTheYieldRatioAndYieldOverFriction)
{
    const SweepView view = view_of(sweep_rows());
    const pages::Chart ratio = slip_over_yield_ratio(view);
    ASSERT_EQ(ratio.curves.size(), 2u);
    EXPECT_EQ(ratio.curves[0].x.size(), 24u);
    EXPECT_NEAR(ratio.curves[0].x.front(), 10.0 * 0.1 / 2.0, 1e-9);
    EXPECT_NEAR(ratio.curves[0].x.back(), 10.0 * 0.2 / 2.0, 1e-9);
    const pages::Chart yield = yield_over_friction(view);
    ASSERT_EQ(yield.curves.size(), 1u); // both levels have the same here
    EXPECT_NEAR(yield.curves[0].y[0], -0.5, 1e-12);
}

Scene sweep_scene()
{
    return parse_scene("[section]\nheight_m = 10\nbase_m = 8\n[dam]\ndensity_kg_m3 = 2500\nyoung_modulus_GPa = "
                       "25\n[contact]\nfriction = "
                       "0.6\n[criteria]\nallowable_slip_mm = 45\n",
                       "block.toml", FileCheck::skip);
}

TEST(SweepReport, HeadlineCountsStaticFailuresAndRowsWithoutAnAnswer)
{
    const Scene scene = sweep_scene();
    std::vector<TestRow> rows = sweep_rows();
    const auto page_of = [&](const std::vector<TestRow>& of) {
        const Table none;
        return sweep_page({&scene, none, view_of(of), {}, {}, {}, "results.csv"});
    };
    pages::Page page = page_of(rows);
    EXPECT_EQ(page.headline.outcome, pages::Outcome::none);
    EXPECT_NE(page.headline.sentence.find("72 rows: the largest slip is 53 mm (fe, μ = 0.8, record record 3)"),
              std::string::npos)
        << page.headline.sentence;
    EXPECT_NE(page.headline.sentence.find("24 rows slide without any earthquake"), std::string::npos);
    // FE slips above 45 mm: only at μ = 0.8 and the higher level, where the three records give 51, 52 and 53 mm.
    EXPECT_NE(page.headline.sentence.find("3 of 24 slips by fe exceed the allowable 45 mm"), std::string::npos)
        << page.headline.sentence;
    const std::string rigid_base =
        "rigid base: no radiation damping; an elastic dam may slide on it without end."; // first of all
    EXPECT_EQ(page.warnings, std::vector<std::string>{rigid_base});

    rows[1].row.slip.reset(); // an FE run at 0.9 that did not end
    rows[1].status = "not resolved";
    page = page_of(rows);
    EXPECT_EQ(page.headline.outcome, pages::Outcome::unresolved);
    ASSERT_EQ(page.warnings.size(), 2u);
    EXPECT_EQ(page.warnings[0], rigid_base);
    EXPECT_NE(page.warnings[1].find("not resolved"), std::string::npos);

    // Nothing is said of a base below rigid blocks alone.
    for (TestRow& row : rows) row.method = "rigid";
    rows[1].status = "at rest";
    EXPECT_TRUE(page_of(rows).warnings.empty());
}

TEST(SweepReport, ATableWithoutRowsHasAPageToo)
{
    const Scene scene = sweep_scene();
    const Table rows;
    EXPECT_NE(page_html(sweep_page({&scene, rows, view_of({}), {}, {}, {}, ""})).find("0 rows"), std::string::npos);
}

} // namespace
