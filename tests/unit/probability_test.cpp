#include "analysis/fragility/hazard_file.hpp"
#include "core/input_error.hpp"
#include "probability/annual_rate.hpp"
#include "probability/cloud_fit.hpp"
#include "probability/distribution.hpp"
#include "probability/fit.hpp"
#include "probability/sampling.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>

using namespace damslip::probability;
using damslip::InputError;

namespace {

std::string hazard_message(const std::string& text)
{
    try {
        (void)damslip::parse_hazard_file(text, "hazard.csv", {});
    } catch (const InputError& error) {
        return error.what();
    }
    return "no error";
}

void expect_has(const std::string& text, const std::string& part)
{
    EXPECT_NE(text.find(part), std::string::npos) << text;
}

/// Of standard normal numbers: the mean of their product, over their standard deviations.
double correlation(const std::vector<double>& a, const std::vector<double>& b)
{
    const auto product = [](const std::vector<double>& x, const std::vector<double>& y) {
        return std::inner_product(x.begin(), x.end(), y.begin(), 0.0);
    };
    return product(a, b) / std::sqrt(product(a, a) * product(b, b));
}

} // namespace

TEST(ProbabilityLaws, QuantileInvertsTheDistributionInBothTails)
{
    const std::array laws{Distribution::lognormal(0.77, 0.15),
                          Distribution::lognormal_of_mean(0.8, 0.3),
                          Distribution::normal(-2.0, 3.0),
                          Distribution::uniform(-1.0, 4.0),
                          Distribution::triangular(0.0, 0.0, 2.0),
                          Distribution::triangular(1.0, 1.5, 4.0),
                          Distribution::beta(0.5, 3.0, 0.0, 20.0),
                          Distribution::lognormal(0.77, 0.15).truncated(0.4, 0.9),
                          Distribution::normal(0.0, 1.0).truncated(6.0, INFINITY)};
    for (const Distribution& law : laws)
        for (const double u : {1e-9, 1e-3, 0.3, 0.5, 0.8, 0.999})
            EXPECT_NEAR(law.cdf(law.quantile(u)), u, 1e-12 + 1e-9 * u);
}

TEST(ProbabilityLaws, MeanAndVariationGiveTheLognormalOfThatMean)
{
    // Mean by the middles of 1e5 equal strata: the tails cut cost some 1e-4 of the standard deviation.
    const Distribution law = Distribution::lognormal_of_mean(2.0, 0.5);
    double mean = 0.0, square = 0.0;
    constexpr int n = 100000;
    for (int k = 0; k < n; ++k) {
        const double x = law.quantile((k + 0.5) / n);
        mean += x / n;
        square += x * x / n;
    }
    EXPECT_NEAR(mean, 2.0, 1e-3);
    EXPECT_NEAR(std::sqrt(square - mean * mean) / mean, 0.5, 1e-3);
}

TEST(ProbabilityLaws, TruncationIsTheConditionalLawFarInTheUpperTail)
{
    // P(X > 7 | X > 6) of a standard normal: both tails known to their last digits.
    const Distribution tail = Distribution::normal(0.0, 1.0).truncated(6.0, INFINITY);
    EXPECT_NEAR(1.0 - tail.cdf(7.0), normal_cdf(-7.0) / normal_cdf(-6.0), 1e-12);
    EXPECT_GE(tail.quantile(1e-12), 6.0);
}

TEST(ProbabilityLaws, ChoicesComeWithTheirWeights)
{
    const Distribution choice = Distribution::discrete({0.6, 0.3, 0.1});
    EXPECT_EQ(choice.quantile(0.59), 0.0);
    EXPECT_EQ(choice.quantile(0.61), 1.0);
    EXPECT_EQ(choice.quantile(0.95), 2.0);
    EXPECT_DOUBLE_EQ(choice.cdf(1.0), 0.9);
}

TEST(ProbabilityLaws, WhatIsNotAllowedIsNamedWithItsRange)
{
    EXPECT_THROW(Distribution::lognormal(0.77, -0.15), ParameterError);
    EXPECT_THROW(Distribution::triangular(0.0, 3.0, 2.0), ParameterError);
    EXPECT_THROW(Distribution::normal(0.0, 1.0).truncated(50.0, 60.0), ParameterError); // no probability there
    EXPECT_THROW(Distribution::discrete({0.5, 0.5}).truncated(0.0, 1.0), ParameterError);
    try {
        (void)Distribution::uniform(2.0, 1.0);
    } catch (const ParameterError& error) {
        EXPECT_STREQ(error.what(), "max = 1 is not allowed; expected: more than min = 2");
    }
}

TEST(ProbabilityLaws, LogarithmsOfTailsAreFiniteAndContinuous)
{
    EXPECT_NEAR(log_normal_cdf(-5.0 - 1e-9), log_normal_cdf(-5.0 + 1e-9), 2e-8);
    EXPECT_NEAR(mills(-5.0 - 1e-9), mills(-5.0 + 1e-9), 1e-8);
    EXPECT_NEAR(log_normal_cdf(-40.0), -804.608442, 1e-5); // -800 - ln(40 sqrt(2 pi)) - 1/1600 + ...
    EXPECT_TRUE(std::isfinite(log_normal_cdf(-1e6)));
}

TEST(ProbabilityLaws, CorrelationsThatContradictOneAnotherAreRefused)
{
    const std::array<damslip::probability::RankCorrelation, 3> bad{{{0, 1, 0.9}, {1, 2, 0.9}, {0, 2, -0.9}}};
    try {
        (void)GaussianCopula(3, bad);
        FAIL() << "accepted";
    } catch (const NotPositiveDefinite& error) {
        EXPECT_LT(error.smallest_eigenvalue(), 0.0);
    }
    const std::array<damslip::probability::RankCorrelation, 2> twice{{{0, 1, 0.5}, {1, 0, 0.5}}};
    EXPECT_THROW(GaussianCopula(2, twice), ParameterError);
}

TEST(ProbabilityLaws, ConditionalDrawsHaveTheCorrelationOfTheCopula)
{
    const std::array<damslip::probability::RankCorrelation, 2> ranks{{{0, 1, 0.6}, {1, 2, -0.4}}};
    const GaussianCopula copula(3, ranks);
    // Variable 1 drawn, 0 and 2 drawn given it: together they have the law of the copula, so z_0 and z_1 correlate by r_01.
    constexpr std::uint32_t n = 20000;
    const UnitPoints points(Sampling::random, 4, {"a", "b", "c", "d"}, n);
    std::vector<double> z0, z1, z2;
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::array<double, 3> fixed{0.5, points(i, 3), 0.5};
        const std::array<double, 3> u{points(i, 0), points(i, 1), points(i, 2)};
        const std::vector<double> x = copula.conditional(0b010, fixed, u);
        EXPECT_EQ(x[1], fixed[1]);
        z0.push_back(normal_quantile(x[0]));
        z1.push_back(normal_quantile(x[1]));
        z2.push_back(normal_quantile(x[2]));
    }
    const double scatter = 4.0 / std::sqrt(static_cast<double>(n)); // of a correlation, 4 standard errors at most
    EXPECT_NEAR(correlation(z0, z1), copula.correlation(0, 1), scatter);
    EXPECT_NEAR(correlation(z1, z2), copula.correlation(1, 2), scatter);
    EXPECT_NEAR(correlation(z0, z2), copula.correlation(0, 2), scatter);
}

TEST(ProbabilitySampling, UniformNumbersNeverReachTheEnds)
{
    const Stream stream(1, "mu");
    for (std::uint32_t i = 0; i < 1000; ++i) {
        const double u = stream.uniform(i);
        EXPECT_GT(u, 0.0);
        EXPECT_LT(u, 1.0);
        EXPECT_EQ(1.0 - (1.0 - u), u); // 1 - u is a number of the same kind
    }
    EXPECT_LT((2.0 * (0x1p52 - 1.0) + 1.0) * 0x1p-53, 1.0); // the largest of all
}

TEST(ProbabilitySampling, EveryStratumIsHitOnceByHypercubeAndSobolPoints)
{
    for (const Sampling sampling : {Sampling::lhs, Sampling::sobol})
        for (const std::uint32_t replicate : {0u, 1u}) {
            const UnitPoints points(sampling, 9, {"a", "b", "c"}, 64, replicate);
            for (std::size_t k = 0; k < 3; ++k) {
                std::set<int> strata;
                for (std::uint32_t i = 0; i < 64; ++i) strata.insert(static_cast<int>(64.0 * points(i, k)));
                EXPECT_EQ(strata.size(), 64u);
            }
        }
    EXPECT_THROW(UnitPoints(Sampling::sobol, 1, {"a"}, 48), ParameterError);
    EXPECT_EQ(UnitPoints(Sampling::sobol, 1, std::vector<std::string>(41, "a"), 8).used(), Sampling::random);
}

TEST(ProbabilitySampling, BalancedBlocksMeetEveryRecordAsItsWeightSays)
{
    const RecordDraw equal(RecordOrder::balanced, 1, 7);
    for (std::uint32_t block = 0; block < 3; ++block) {
        std::set<std::size_t> met;
        for (std::uint32_t k = 0; k < 7; ++k) met.insert(equal(7 * block + k));
        EXPECT_EQ(met.size(), 7u);
    }
    const std::array<double, 4> weights{1.0, 1.0, 2.0, 4.0};
    const RecordDraw weighted(RecordOrder::balanced, 1, weights);
    std::array<int, 4> counts{};
    for (std::uint32_t i = 0; i < 4000; ++i) ++counts[weighted(i)];
    // Each block meets a record 4 w times rounded up or down; 1000 blocks: s.d. below sqrt(1000) / 2.
    for (std::size_t r = 0; r < 4; ++r) EXPECT_NEAR(counts[r], 500.0 * weights[r], 64.0);
    std::array<int, 4> one_block{};
    for (std::uint32_t i = 0; i < 4; ++i) ++one_block[weighted(i)];
    EXPECT_EQ(one_block[2], 1);
    EXPECT_EQ(one_block[3], 2);
}

TEST(ProbabilitySampling, PermutationsAreAllMet)
{
    std::set<std::vector<std::uint32_t>> met;
    const Stream stream(3, "order");
    for (std::uint32_t block = 0; block < 400; ++block) met.insert(permutation(stream, 4, block));
    EXPECT_EQ(met.size(), 24u); // a missing one of 24 in 400 draws: 1e-6
}

TEST(ProbabilityFit, CloudFindsTheLawItsSlipsWereDrawnFrom)
{
    // ln D = 1 + 2 ln x + 0.6 e above d_0, by stratified e: the truncated fit returns it, ordinary least squares on what is left would not.
    const double d0 = 1e-3;
    std::vector<CloudPoint> points;
    constexpr int n = 4000;
    const Stream stream(2, "cloud"), intensity(2, "x");
    for (int i = 0; i < n; ++i) {
        const std::uint32_t k = static_cast<std::uint32_t>(i);
        const double x = 0.01 * std::exp(3.0 * intensity.uniform(k));
        points.push_back({x, std::exp(1.0 + 2.0 * std::log(x) + 0.6 * normal_quantile(stream.uniform(k))), false});
    }
    const CloudFit fit = fit_cloud(points, d0);
    ASSERT_TRUE(fit.found) << fit.why;
    EXPECT_NEAR(fit.b, 2.0, 0.1); // s.e. 0.6 / (sqrt(3400) s.d. of ln x) = 0.013, times what truncation costs
    EXPECT_NEAR(fit.sigma, 0.6, 0.03);
    EXPECT_NEAR(fit.probability(0.1, 0.02), normal_cdf((1.0 + 2.0 * std::log(0.1) - std::log(0.02)) / 0.6), 0.03);
    EXPECT_THROW((void)fit.probability(0.1, 1e-4), ParameterError);
}

TEST(ProbabilityFit, SeparatedTablesAreFittedByFirthWhereScoringAloneWandersOff)
{
    const std::vector<std::vector<StripeCount>> tables{
        {{0.1009, 321, 0}, {1.514, 20, 20}},
        {{0.1125, 3, 0}, {0.6676, 2, 2}},
        {{0.1025, 255, 0}, {0.3026, 492, 0}, {0.3816, 628, 0}, {1.775, 919, 919}}};
    for (const std::vector<StripeCount>& table : tables) {
        const LognormalFit fit = fit_lognormal(table);
        EXPECT_EQ(fit.method, FitMethod::firth) << fit.why;
        EXPECT_GT(fit.curve.median, table[table.size() - 2].x);
        EXPECT_LT(fit.curve.median, table.back().x);
    }
}

// Equal shares at all levels: the slope is round-off of either sign, its median has been infinite.
TEST(ProbabilityFit, SharesThatDoNotRiseHaveNoCurve)
{
    for (double n = 8.0; n <= 4096.0; n *= 2.0)
        for (const double z : {1.0, 0.25 * n, 0.5 * n, n - 1.0})
            for (const double x : {0.012, 0.12, 1.2, 12.0}) {
                const LognormalFit fit =
                    fit_lognormal(std::vector<StripeCount>{{x, n, z}, {1.2 * x, n, z}, {1.7 * x, n, z}});
                EXPECT_EQ(fit.method, FitMethod::none) << n << ' ' << z << ' ' << x;
                expect_has(fit.why, "does not rise");
            }
}

TEST(ProbabilityFit, CensoredCapacitiesAreTheMaximumOfTheirLikelihood)
{
    const std::array<double, 5> reached{0.2, 0.25, 0.4, 0.5, 0.7};
    const std::array<double, 3> censored{0.8, 0.8, 0.8};
    const CapacityFit fit = fit_capacities(reached, censored);
    ASSERT_TRUE(fit.found);
    const auto value = [&](double median, double beta) {
        double sum = 0.0;
        for (const double x : reached) sum += -0.5 * std::pow(std::log(x / median) / beta, 2) - std::log(beta);
        for (const double x : censored) sum += log_normal_cdf(-std::log(x / median) / beta);
        return sum;
    };
    const double best = value(fit.curve.median, fit.curve.beta);
    for (const double f : {0.99, 1.01}) {
        EXPECT_LT(value(f * fit.curve.median, fit.curve.beta), best);
        EXPECT_LT(value(fit.curve.median, f * fit.curve.beta), best);
    }
    EXPECT_GT(fit.curve.median, fit_capacities(reached, {}).curve.median);
    EXPECT_FALSE(fit_capacities(censored, {}).found);
}

TEST(ProbabilityFit, ClustersWidenTheIntervalOfWhatTheyShare)
{
    const auto interval_of = [](std::size_t clusters, std::size_t agreeing) { // a quarter of the clusters fail
        const auto mean = [=](std::span<const std::uint32_t> times) {
            double failed = 0.0, all = 0.0;
            for (std::size_t k = 0; k < clusters; ++k) {
                all += times[k];
                if (k / agreeing % 4 == 0) failed += times[k];
            }
            return failed / all;
        };
        return cluster_bootstrap(clusters, mean, 1);
    };
    const ClusterInterval wide = interval_of(20, 1), narrow = interval_of(120, 6); // 120 outcomes, six of a cluster alike, or each alone
    EXPECT_NEAR(wide.half_width() / narrow.half_width(), std::sqrt(6.0), 0.35);
    EXPECT_TRUE(wide.contains(0.25));
    EXPECT_FALSE(wide.few);
    EXPECT_TRUE(interval_of(3, 1).few);
}

TEST(ProbabilityHazard, FilesThatAreWrongAreNamedByLineWithTheFix)
{
    expect_has(hazard_message("0.1,1e-2\n0.2,1e-3\n"), "hazard.csv:1");
    expect_has(hazard_message("im,rate\n0.1,1e-2\n0.1,1e-3\n"), "hazard.csv:3");
    expect_has(hazard_message("im,rate\n0.1,1e-2\n0.2,2e-2\n"), "never rise");
    expect_has(hazard_message("im,rate\n0.1,1e-2\n0.2,zero\n"), "\"zero\" is no number");
    expect_has(hazard_message("# investigation_time=50\nlon,lat,depth,poe-0.1,poe-0.2\n1,2,0,1.0,0.5\n"),
               "the curve has 1 points with a rate"); // poe = 1 is passed over
    expect_has(hazard_message("lon,lat,depth,poe-0.1,poe-0.2\n1,2,0,0.9,0.5\n"), "investigation_time");
    expect_has(hazard_message("# investigation_time=50\nlon,lat,depth,poe-0.1,poe-0.2\n1,2,0,0.9,0.5\n3,4,0,0.9,0.5\n"),
               "2 sites");
    expect_has(hazard_message("# investigation_time=50\nlon,lat,depth,poe-0.1,poe-0.2\n1,2,0,0.9\n"),
               "4 fields below 5");
    expect_has(hazard_message(""), "the file is empty");
}

TEST(ProbabilityHazard, SitesAndPointsWithoutEarthquakesAreToldApart)
{
    using damslip::HazardFile, damslip::parse_hazard_file;
    damslip::HazardWish wish;
    wish.measure = *damslip::parse_intensity("SA(0.3)");
    wish.site = {3.0, 4.0};
    const HazardFile file =
        parse_hazard_file("# investigation_time=50, imt=\"SA(0.3)\"\nlon,lat,depth,poe-0.1,poe-0.2,poe-3\n"
                          "1,2,0,0.9,0.5,0\n3,4,0,0.8,0.4,0.1\n",
                          "x.csv", wish);
    EXPECT_EQ(file.curve.x().size(), 3u);
    EXPECT_NEAR(file.curve.rate().front(), -std::log(0.2) / 50.0, 1e-15);
    const HazardFile cut =
        parse_hazard_file("# investigation_time=50\nlon,lat,depth,poe-0.1,poe-0.2,poe-3\n1,2,0,0.9,0.5,0\n",
                          "hazard_curve-mean-PGA_1.csv", {});
    EXPECT_EQ(cut.curve.x().size(), 2u);
    expect_has(cut.notes.back(), "points without any earthquake: 1, left out");
}

TEST(ProbabilityHazard, RatesOutsideTheTestedLevelsAreTold)
{
    const HazardCurve curve({0.1, 1.0}, {1e-2, 1e-4});
    const AnnualRate within = annual_rate(curve, 0.4, 0.2, 0.1, 1.0);
    EXPECT_FALSE(within.all_events); // P at the first point is small, but not 0
    const AnnualRate narrow = annual_rate(curve, 0.4, 0.2, 0.5, 0.6);
    EXPECT_FALSE(narrow.mostly_tested);
    EXPECT_GT(narrow.outside_share, within.outside_share);
    EXPECT_NEAR(annual_rate(curve, 0.4, 0.0, 0.1, 1.0).lower, curve.rate_at(0.4), 1e-15);
    EXPECT_NEAR(annual_rate(curve, 0.4, 1e-6, 0.1, 1.0).lower, curve.rate_at(0.4), 1e-11); // beta -> 0
    EXPECT_NEAR(annual_rate(curve, 0.4, 40.0, 0.1, 1.0).inside, 0.49 * 9.9e-3,
                2e-4); // P from 0.486 to 0.509
    EXPECT_THROW(annual_rate(curve, 0.4, 0.2, 0.1, 1.0, 1e-3), ParameterError);
}
