// `damslip regress`: regressions from given measures, and the yield coefficient for a median slip.
#include "analysis/screen/regression_rows.hpp"
#include "program_answer.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace damslip {

namespace {

TEST(Regress, rows_are_the_regressions_of_the_same_measures)
{
    const ProgramAnswer a = answer_of(
        {"regress", "--yield-g", "0.08", "--pga-g", "0.35", "--pgv-cm-s", "28", "--magnitude", "6.8", "--json"});
    ASSERT_EQ(a.code, 0) << a.talk;
    sliding::RegressionInputs in;
    in.yield_coefficient = 0.08;
    in.pga_g = 0.35;
    in.pgv_cm_s = 28.0;
    in.magnitude = 6.8;
    in.sa_13_g = in.sa_15_g = 0.35; // a rigid mass
    std::size_t with_a_slip = 0;
    const auto answer = nlohmann::json::parse(a.out);
    for (const auto& row : answer["regressions"]) {
        const sliding::Regression* r = sliding::find_regression(row["id"].get<std::string>());
        if (!r) continue; // the weighted median
        const sliding::RegressionResult expected = sliding::evaluate(*r, in);
        EXPECT_EQ(row["slip_mm"].is_null(), !expected.median_cm.has_value()) << r->id;
        if (!expected.median_cm || row["slip_mm"].is_null()) continue;
        EXPECT_NEAR(row["slip_mm"].get<double>(), 10.0 * *expected.median_cm, 1e-12 * 10.0 * *expected.median_cm)
            << r->id;
        ++with_a_slip;
    }
    EXPECT_GE(with_a_slip, 8u);
}

/// Ambraseys & Menu (1988): log D = 0.9 + log[(1 - r)^2.53 r^-1.09].
TEST(Regress, yield_coefficient_gives_the_median_back)
{
    sliding::RegressionInputs in;
    in.pga_g = 0.4;
    in.arias_m_s = 1.5;
    in.pgv_cm_s = 35.0;
    in.magnitude = 7.0;
    in.mean_period_s = 0.5;
    in.sa_13_g = in.sa_15_g = 0.4;
    std::size_t found = 0;
    for (const sliding::Regression& r : sliding::regressions()) {
        const std::optional<double> k = yield_coefficient_for(r, in, 0.05);
        if (!k) continue;
        const auto median = [&](double yield) {
            sliding::RegressionInputs at = in;
            at.yield_coefficient = yield;
            return sliding::evaluate(r, at).median_cm.value_or(-1.0);
        };
        EXPECT_GE(median(*k - 2e-9), 5.0) << r.id;
        EXPECT_LE(median(*k + 2e-9), 5.0) << r.id; // 0 where it reaches the demand
        ++found;
    }
    EXPECT_GE(found, 8u);
    const sliding::Regression& menu = *sliding::find_regression("ambraseys-menu-1988");
    const double ratio = *yield_coefficient_for(menu, in, 0.05) / 0.4;
    EXPECT_NEAR(0.9 + 2.53 * std::log10(1.0 - ratio) - 1.09 * std::log10(ratio), std::log10(5.0), 1e-6);
    EXPECT_FALSE(yield_coefficient_for(menu, in, 1e6));
}

TEST(Regress, bad_numbers_are_named)
{
    const ProgramAnswer none = answer_of({"regress", "--pga-g", "0.35"});
    EXPECT_EQ(none.code, 2);
    EXPECT_NE(none.talk.find("--yield-g"), std::string::npos) << none.talk;
    const ProgramAnswer nothing = answer_of({"regress", "--yield-g", "0.1", "--pga-g", "nan"});
    EXPECT_EQ(nothing.code, 2);
    EXPECT_NE(nothing.talk.find("a number from"), std::string::npos) << nothing.talk;
    const ProgramAnswer high = answer_of({"regress", "--yield-g", "0.1", "--pga-g", "35"});
    EXPECT_EQ(high.code, 2);
    EXPECT_NE(high.talk.find("--pga-g"), std::string::npos) << high.talk;
}

} // namespace

} // namespace damslip
