// Weighted regressions: median and band against closed forms and a numerical distribution.
#include "sliding/empirical/regression.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

using namespace damslip::sliding;

namespace {

RegressionInputs ensemble_inputs(double yield, double pga)
{
    RegressionInputs x;
    x.yield_coefficient = yield, x.pga_g = pga, x.arias_m_s = 2.0, x.pgv_cm_s = 50.0, x.mean_period_s = 0.5;
    return x;
}

double value_of_model(const char* id, const RegressionInputs& x)
{
    return *evaluate(*find_regression(id), x).median_cm;
}

} // namespace

// One member: its own median and its own band.
TEST(EmpiricalEnsemble, one_member_is_itself)
{
    const RegressionInputs x = ensemble_inputs(0.1, 0.4);
    const std::vector<RegressionWeight> weights{{"jibson-1998", 3.0}};
    const Ensemble e = weighted_ensemble(evaluate_all(x), weights);
    const RegressionResult r = evaluate(*find_regression("jibson-1998"), x);
    ASSERT_EQ(e.members.size(), 1u);
    EXPECT_DOUBLE_EQ(e.weights[0], 1.0);
    EXPECT_NEAR(*e.median_cm, *r.median_cm, 1e-9 * *r.median_cm);
    EXPECT_NEAR(*e.low_cm, *r.minus_sd_cm, 1e-9 * *r.minus_sd_cm);
    EXPECT_NEAR(*e.high_cm, *r.plus_sd_cm, 1e-9 * *r.plus_sd_cm);
    EXPECT_EQ(e.weight_left_out, 0.0);
}

// The quantiles of a mixture satisfy sum w Phi(z) = q, checked with the distribution function itself.
TEST(EmpiricalEnsemble, two_members)
{
    const RegressionInputs x = ensemble_inputs(0.1, 0.4);
    const std::vector<RegressionWeight> weights{{"ambraseys-menu-1988", 1.0}, {"jibson-2007-ratio", 3.0}};
    const Ensemble e = weighted_ensemble(evaluate_all(x), weights);
    const double a = value_of_model("ambraseys-menu-1988", x), b = value_of_model("jibson-2007-ratio", x);
    const auto below = [&](double d) {
        const auto phi = [](double z) { return 0.5 * std::erfc(-z / std::sqrt(2.0)); };
        return 0.25 * phi(std::log10(d / a) / 0.30) + 0.75 * phi(std::log10(d / b) / 0.51);
    };
    EXPECT_NEAR(below(*e.low_cm), 0.158655253931457, 1e-12);
    EXPECT_NEAR(below(*e.median_cm), 0.5, 1e-12);
    EXPECT_NEAR(below(*e.high_cm), 0.841344746068543, 1e-12);
    EXPECT_GT(*e.median_cm, std::min(a, b));
    EXPECT_LT(*e.median_cm, std::max(a, b));
}

// Equal weights: every estimate that is valid; no upper bound, no other tectonic setting, nothing out of its range.
TEST(EmpiricalEnsemble, equal_weights_of_the_valid_ones)
{
    const auto has = [](const Ensemble& e, std::string_view id) {
        return std::find(e.members.begin(), e.members.end(), id) != e.members.end();
    };
    const Ensemble e = weighted_ensemble(evaluate_all(ensemble_inputs(0.1, 0.4)));
    EXPECT_TRUE(has(e, "saygili-rathje-2008-pga"));
    EXPECT_TRUE(has(e, "jibson-1993"));
    EXPECT_FALSE(has(e, "hynes-griffin-franklin-1984-upper"));
    EXPECT_FALSE(has(e, "rathje-saygili-2009")); // no magnitude was given
    for (const double w : e.weights) EXPECT_DOUBLE_EQ(w, 1.0 / static_cast<double>(e.members.size()));
    const Ensemble weak = weighted_ensemble(evaluate_all(ensemble_inputs(0.01, 0.4)));
    EXPECT_FALSE(has(weak, "saygili-rathje-2008-pga")); // a_c 0.05 to 0.30
    EXPECT_FALSE(has(weak, "jibson-1993"));             // a_c 0.02 to 0.40
    EXPECT_FALSE(has(weak, "ambraseys-menu-1988"));     // ratio 0.1 to 0.9
    EXPECT_TRUE(has(weak, "hynes-griffin-franklin-1984-mean"));
    EXPECT_NEAR(
        weak.weight_left_out,
        1.0 - static_cast<double>(weak.members.size()) /
                  [&] {
                      double all = 0.0;
                      for (const Regression& r : regressions()) all += r.use == EnsembleUse::estimate;
                      return all;
                  }(),
        1e-12);
}

TEST(EmpiricalEnsemble, nothing_to_weigh)
{
    const RegressionInputs x = ensemble_inputs(0.1, 0.4);
    const std::vector<RegressionWeight> asks_for_magnitude{{"rathje-saygili-2009", 1.0}};
    const Ensemble e = weighted_ensemble(evaluate_all(x), asks_for_magnitude);
    EXPECT_TRUE(e.members.empty());
    EXPECT_FALSE(e.median_cm.has_value());
    EXPECT_DOUBLE_EQ(e.weight_left_out, 1.0);
    const Ensemble sliding = weighted_ensemble(evaluate_all(ensemble_inputs(-0.1, 0.4)));
    EXPECT_FALSE(sliding.median_cm.has_value());
    const Ensemble rest = weighted_ensemble(evaluate_all(ensemble_inputs(0.4, 0.4))); // D = 0 by all rigid models
    EXPECT_EQ(*rest.median_cm, 0.0);
    EXPECT_EQ(*rest.high_cm, 0.0);
}

// A share of the weight at D = 0 moves the quantiles: 0.6 at zero makes the median zero, the 84 % one that of the rest at
// (0.8413 - 0.6)/0.4.
TEST(EmpiricalEnsemble, zero_displacement_has_its_share)
{
    RegressionInputs x = ensemble_inputs(0.3, 0.4);
    x.magnitude = 6.9, x.period_s = 0.3, x.sa_15_g = 0.6; // k_max = 0.29 g < k_y: D = 0 by the flexible model
    const std::vector<RegressionWeight> weights{{"rathje-antonakos-2011-pga-pgv", 0.6}, {"ambraseys-menu-1988", 0.4}};
    const Ensemble e = weighted_ensemble(evaluate_all(x), weights);
    const double a = value_of_model("ambraseys-menu-1988", x);
    EXPECT_EQ(*e.low_cm, 0.0);
    EXPECT_EQ(*e.median_cm, 0.0);
    const double z = std::log10(*e.high_cm / a) / 0.30;
    EXPECT_NEAR(0.5 * std::erfc(-z / std::sqrt(2.0)), (0.841344746068543 - 0.6) / 0.4, 1e-12);
}

// Members without a published sigma are steps: the band of two of them is their two values.
TEST(EmpiricalEnsemble, steps)
{
    const RegressionInputs x = ensemble_inputs(0.1, 0.4);
    const std::vector<RegressionWeight> weights{{"hynes-griffin-franklin-1984-mean", 1.0},
                                                {"hynes-griffin-franklin-1984-upper", 1.0}};
    const Ensemble e = weighted_ensemble(evaluate_all(x), weights);
    EXPECT_NEAR(*e.low_cm, value_of_model("hynes-griffin-franklin-1984-mean", x), 1e-9);
    EXPECT_NEAR(*e.high_cm, value_of_model("hynes-griffin-franklin-1984-upper", x), 1e-7);
}
