#include "pages/report/chart.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>

namespace {

using namespace damslip::pages;

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();

Curve report_curve(std::vector<double> x, std::vector<double> y)
{
    Curve c;
    c.name = "curve";
    c.x = std::move(x);
    c.y = std::move(y);
    return c;
}

nlohmann::json report_json(const Chart& chart)
{
    return nlohmann::json::parse(chart_json(chart, common_abscissae(chart)));
}

TEST(ReportChart, AShorterHistoryOnTheSameGridIsFilledUpWithNothing)
{
    Chart chart;
    chart.curves = {report_curve({0, 1, 2, 3}, {5, 6, 7, 8}), report_curve({0, 1}, {1, 2})};
    const ChartData data = common_abscissae(chart);
    EXPECT_FALSE(data.joined);
    EXPECT_EQ(data.x, (std::vector<double>{0, 1, 2, 3}));
    ASSERT_EQ(data.columns.size(), 2u);
    EXPECT_EQ(data.columns[1][1], 2);
    EXPECT_TRUE(std::isnan(data.columns[1][2]));
}

TEST(ReportChart, DifferentGridsAreUnited)
{
    Chart chart;
    chart.curves = {report_curve({0, 2, 4}, {0, 2, 4}), report_curve({1, 2, 3}, {10, 20, 30})};
    const ChartData data = common_abscissae(chart);
    EXPECT_TRUE(data.joined);
    EXPECT_EQ(data.x, (std::vector<double>{0, 1, 2, 3, 4}));
    EXPECT_EQ(data.columns[0][2], 2);
    EXPECT_EQ(data.columns[1][2], 20);
    EXPECT_TRUE(std::isnan(data.columns[0][1]));
    EXPECT_TRUE(std::isnan(data.columns[1][4]));
}

TEST(ReportChart, ThinningKeepsTheExtremesOfEachPartAndBothEnds)
{
    // One spike up and one down among 100 000 samples of a sine: a plain every-k-th thinning loses both.
    Chart chart;
    std::vector<double> x, y;
    for (int i = 0; i < 100000; ++i) {
        x.push_back(0.001 * i);
        y.push_back(std::sin(0.01 * i));
    }
    y[54321] = 9;
    y[54322] = -7;
    chart.curves = {report_curve(x, y)};
    const ChartData thin = thinned(common_abscissae(chart), 20000, 2000);
    EXPECT_EQ(thin.samples, 100000u);
    EXPECT_LE(thin.x.size(), 2u * 2000 + 2);
    EXPECT_GE(thin.x.size(), 2000u);
    EXPECT_EQ(thin.x.front(), x.front());
    EXPECT_EQ(thin.x.back(), x.back());
    EXPECT_EQ(*std::max_element(thin.columns[0].begin(), thin.columns[0].end()), 9);
    EXPECT_EQ(*std::min_element(thin.columns[0].begin(), thin.columns[0].end()), -7);
    EXPECT_TRUE(std::is_sorted(thin.x.begin(), thin.x.end()));
}

TEST(ReportChart, UpToTheLimitNothingIsThinned)
{
    Chart chart;
    chart.curves = {report_curve({0, 1, 2, 3}, {5, 6, 7, 8})};
    EXPECT_EQ(thinned(common_abscissae(chart), 4, 1).x.size(), 4u);
    EXPECT_LT(thinned(common_abscissae(chart), 3, 1).x.size(), 4u);
}

TEST(ReportChart, NanAndInfinityAreNull)
{
    Chart chart;
    chart.curves = {report_curve({0, 1, 3}, {nan_value, std::numeric_limits<double>::infinity(), 2.5})};
    const auto j = report_json(chart);
    EXPECT_TRUE(j["curves"][0]["y"][0].is_null());
    EXPECT_TRUE(j["curves"][0]["y"][1].is_null());
    EXPECT_EQ(j["curves"][0]["y"][2], 2.5);
}

TEST(ReportChart, ALogAxisLeavesOutZeroAndBelow)
{
    Chart chart;
    chart.y.scale = Scale::log;
    chart.curves = {report_curve({0, 1, 3}, {0, -1, 10})};
    const auto j = report_json(chart);
    EXPECT_TRUE(j["curves"][0]["y"][0].is_null());
    EXPECT_TRUE(j["curves"][0]["y"][1].is_null());
    EXPECT_EQ(j["curves"][0]["y"][2], 10);
}

TEST(ReportChart, NumbersHaveSixDigitsAndEvenTimesAreThreeNumbers)
{
    Chart chart;
    chart.curves = {report_curve({0.25, 0.5, 0.75, 1.0}, {1.0 / 3, 123456.789, 1e-9, 0})};
    const auto j = report_json(chart);
    EXPECT_EQ(j["curves"][0]["y"][0], 0.333333);
    EXPECT_EQ(j["curves"][0]["y"][1], 123457);
    EXPECT_EQ(j["x"]["from"], 0.25);
    EXPECT_EQ(j["x"]["step"], 0.25);
    EXPECT_EQ(j["x"]["n"], 4);
    chart.curves = {report_curve({0, 1, 3}, {0, 0, 0})};
    EXPECT_EQ(report_json(chart)["x"].size(), 3u);
}

TEST(ReportChart, BandsComeAsLowAndHigh)
{
    Chart chart;
    Curve c = report_curve({0, 1}, {1, 2});
    c.low = {0, 1};
    c.high = {2, 3};
    chart.curves = {c, report_curve({0, 1}, {7, 8})};
    const auto j = report_json(chart);
    EXPECT_EQ(j["curves"][0]["low"][1], 1);
    EXPECT_EQ(j["curves"][0]["high"][1], 3);
    EXPECT_EQ(j["curves"][1]["y"][0], 7);
    EXPECT_FALSE(j["curves"][1].contains("low"));
}

TEST(ReportChart, NoCurvesIsAnEmptyChartNotACrash)
{
    const auto j = report_json(Chart{});
    EXPECT_EQ(j["curves"].size(), 0u);
    EXPECT_EQ(j["x"].size(), 0u);
}

} // namespace
