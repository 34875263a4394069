// Regressions: values by hand, bands, limits, warnings.
#include "sliding/empirical/regression.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

using namespace damslip::sliding;

namespace {

RegressionInputs full_inputs(double yield_coefficient, double pga_g)
{
    RegressionInputs inputs;
    inputs.yield_coefficient = yield_coefficient;
    inputs.pga_g = pga_g;
    inputs.arias_m_s = 1.0;
    inputs.pgv_cm_s = 1.0;
    inputs.mean_period_s = 1.0;
    inputs.magnitude = 7.0;
    return inputs;
}

RegressionResult run(const char* id, const RegressionInputs& inputs)
{
    return evaluate(*find_regression(id), inputs);
}

} // namespace

// By hand with Ia = PGV = Tm = 1 (their logarithms vanish), M = 7 and r = 1/2, log10 r = -0.30102999566; a_c = 0.1 for the Arias models.
TEST(EmpiricalRegression, values_by_hand)
{
    const double half = std::log10(0.5);
    const RegressionInputs ratio = full_inputs(0.1, 0.2), unit = full_inputs(0.5, 1.0);
    const struct {
        const char* id;
        const RegressionInputs& inputs;
        double log_d, sigma;
        bool natural;
    } rows[] = {
        {"ambraseys-menu-1988", ratio, 0.90 + 1.44 * half, 0.30, false},
        {"jibson-1993", ratio, 0.8818, 0.409, false},
        {"jibson-1998", ratio, 0.447, 0.375, false},
        {"jibson-2007-ratio", ratio, 0.215 + 0.903 * half, 0.510, false},
        {"jibson-2007-ratio-magnitude", ratio, 0.258 + 0.857 * half, 0.454, false},
        {"jibson-2007-arias", ratio, 0.251, 0.656, false},
        {"jibson-2007-arias-ratio", ratio, -1.474 - 3.833 * half, 0.616, false},
        {"saygili-rathje-2008-pga", unit, 1.7375, 1.13, true},
        {"saygili-rathje-2008-pga-pgv", unit, -5.3725, 0.67, true},
        {"saygili-rathje-2008-pga-arias", unit, -1.495625, 0.74, true},
        {"saygili-rathje-2008-pga-pgv-arias", unit, -4.59625, 0.595, true},
        {"saygili-rathje-2008-pga-period", unit, 2.84, 0.73, true},
        {"rathje-saygili-2009", unit, 1.9400, 0.98975, true},
    };
    ASSERT_EQ(std::size(rows), regressions().size()); // a new row needs its value here
    for (const auto& row : rows) {
        const RegressionResult result = run(row.id, row.inputs);
        ASSERT_EQ(result.status, RegressionStatus::ok) << row.id;
        const double base = row.natural ? std::exp(1.0) : 10.0;
        EXPECT_NEAR(std::log(*result.median_cm) / std::log(base), row.log_d, 1e-12) << row.id;
        EXPECT_NEAR(std::log(*result.plus_sd_cm / *result.median_cm) / std::log(base), row.sigma, 1e-12) << row.id;
        EXPECT_NEAR(std::log(*result.median_cm / *result.minus_sd_cm) / std::log(base), row.sigma, 1e-12) << row.id;
    }
}

// 2.928 cm: Ambraseys & Menu at r = 0.5, the number a reader of the paper checks first.
TEST(EmpiricalRegression, ambraseys_menu_at_one_half)
{
    EXPECT_NEAR(*run("ambraseys-menu-1988", full_inputs(0.1, 0.2)).median_cm, 2.9277, 1e-3);
}

TEST(EmpiricalRegression, no_slip_at_and_above_the_peak)
{
    for (const double yield : {0.2, 0.3})
        for (const RegressionResult& result : evaluate_all(full_inputs(yield, 0.2))) {
            EXPECT_EQ(result.status, RegressionStatus::no_slip);
            EXPECT_EQ(*result.median_cm, 0.0);
            EXPECT_EQ(*result.plus_sd_cm, 0.0);
            EXPECT_EQ(result.warnings.size(), 1u);
        }
}

TEST(EmpiricalRegression, nothing_for_static_sliding)
{
    for (const double yield : {0.0, -0.1, std::nan("")})
        for (const RegressionResult& result : evaluate_all(full_inputs(yield, 0.2))) {
            EXPECT_EQ(result.status, RegressionStatus::static_sliding);
            EXPECT_FALSE(result.median_cm.has_value());
        }
}

TEST(EmpiricalRegression, warns_outside_the_data)
{
    EXPECT_TRUE(run("jibson-1993", full_inputs(0.02, 0.6)).warnings.empty());
    EXPECT_TRUE(run("jibson-1998", full_inputs(0.40, 0.6)).warnings.empty());
    for (const double yield : {0.019, 0.41}) {
        const RegressionResult result = run("jibson-1998", full_inputs(yield, 0.6));
        EXPECT_EQ(result.status, RegressionStatus::ok);
        ASSERT_EQ(result.warnings.size(), 1u);
        EXPECT_NE(result.warnings[0].find("0.02 to 0.4"), std::string::npos) << result.warnings[0];
    }
    RegressionInputs large = full_inputs(0.1, 0.6);
    large.magnitude = 8.0;
    EXPECT_EQ(run("jibson-2007-ratio-magnitude", large).warnings.size(), 1u);
}

// Inputs that do not matter are not asked for; those that do are named.
TEST(EmpiricalRegression, missing_inputs_are_named)
{
    RegressionInputs bare;
    bare.yield_coefficient = 0.1;
    bare.pga_g = 0.3;
    EXPECT_EQ(run("ambraseys-menu-1988", bare).status, RegressionStatus::ok);
    const RegressionResult result = run("jibson-1993", bare);
    EXPECT_EQ(result.status, RegressionStatus::missing_input);
    EXPECT_FALSE(result.median_cm.has_value());
    EXPECT_NE(result.warnings.at(0).find("Arias intensity"), std::string::npos);
    bare.arias_m_s = 0.0; // a record of zeros
    EXPECT_EQ(run("jibson-1993", bare).status, RegressionStatus::missing_input);
}

TEST(EmpiricalRegression, rows_are_complete)
{
    std::set<std::string_view> ids;
    for (const Regression& r : regressions()) {
        EXPECT_TRUE(ids.insert(r.id).second) << r.id;
        EXPECT_FALSE(r.name.empty() || r.formula.empty() || r.data_set.empty() || r.citation.empty()) << r.id;
        EXPECT_FALSE(r.inputs.empty());
        for (const ValidityRange& range : r.validity) EXPECT_LT(range.low, range.high);
    }
    EXPECT_EQ(find_regression("no-such"), nullptr);
}

TEST(EmpiricalRegression, failure_probability)
{
    EXPECT_EQ(failure_probability_jibson_1998(0.0), 0.0);
    EXPECT_NEAR(failure_probability_jibson_1998(1.0), 0.335 * (1.0 - std::exp(-0.048)), 1e-16);
    EXPECT_NEAR(failure_probability_jibson_1998(1e4), 0.335, 1e-15);
}
