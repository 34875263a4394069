#include "core/status.hpp"
#include "probability/distribution.hpp"
#include "probability/fit.hpp"
#include "probability/sampling.hpp"
#include "verification/cases/modules.hpp"

#include <array>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace damslip::verification {

namespace {

using namespace damslip::probability;
using Check = damslip::verification::Check;

/// Variance of the mean of the sum of the coordinates, over replicates, divided by k / (12 N^3).
double variance_ratio(Sampling sampling, std::size_t k, std::uint32_t n, std::uint32_t replicates)
{
    std::vector<std::string> names;
    for (std::size_t v = 0; v < k; ++v) names.push_back(fmt::format("v{}", v));
    double squares = 0.0;
    for (std::uint32_t r = 0; r < replicates; ++r) {
        const UnitPoints points(sampling, 3, names, n, r);
        double sum = 0.0;
        for (std::uint32_t i = 0; i < n; ++i)
            for (std::size_t v = 0; v < k; ++v) sum += points(i, v) - 0.5;
        squares += std::pow(sum / n, 2) / replicates;
    }
    return squares * 12.0 * std::pow(n, 3) / static_cast<double>(k);
}

std::vector<Check> stratified_means()
{
    constexpr std::uint32_t replicates = 2000;
    const double tolerance = 4.0 * std::sqrt(2.0 / replicates); // of chi^2 / degrees; the sum is normal to a part in N
    std::vector<Check> checks;
    for (const std::size_t k : {1u, 4u})
        for (const Sampling sampling : {Sampling::lhs, Sampling::sobol})
            checks.push_back({fmt::format("{} dimensions, {}, N = 32: variance of the mean of ΣU by k/(12 N³)", k,
                                          sampling == Sampling::lhs ? "Latin hypercube" : "Sobol'"),
                              "–", 1.0, variance_ratio(sampling, k, 32, replicates), tolerance, Measure::absolute});
    return checks;
}

std::vector<Check> ishigami()
{
    constexpr double a = 7.0, b = 0.1, pi = std::numbers::pi;
    const auto f = [](double u1, double u2, double u3) {
        const double x1 = pi * (2.0 * u1 - 1.0), x2 = pi * (2.0 * u2 - 1.0), x3 = pi * (2.0 * u3 - 1.0);
        return std::sin(x1) + a * std::pow(std::sin(x2), 2) + b * std::pow(x3, 4) * std::sin(x1);
    };
    constexpr std::uint32_t n = 8192;
    const UnitPoints points(Sampling::sobol, 1, {"a1", "a2", "a3", "b1", "b2", "b3"}, n);
    std::vector<double> f_a, f_b;
    std::vector<std::vector<double>> f_ab(3);
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::vector<double> u = points.point(i);
        f_a.push_back(f(u[0], u[1], u[2]));
        f_b.push_back(f(u[3], u[4], u[5]));
        for (std::size_t k = 0; k < 3; ++k) {
            std::vector<double> mixed(u.begin(), u.begin() + 3);
            mixed[k] = u[3 + k];
            f_ab[k].push_back(f(mixed[0], mixed[1], mixed[2]));
        }
    }
    const SobolIndices found = sobol_indices(f_a, f_b, f_ab, 0.0, 1, 200);
    const double p4 = std::pow(pi, 4), v1 = 0.5 * std::pow(1.0 + b * p4 / 5.0, 2), v2 = a * a / 8.0,
                 v13 = b * b * p4 * p4 * (1.0 / 18.0 - 1.0 / 50.0), v = v1 + v2 + v13;
    const std::array<double, 3> first{v1 / v, v2 / v, 0.0}, total{(v1 + v13) / v, v2 / v, v13 / v};
    std::vector<Check> checks{{"variance", "–", v, found.variance, 0.02}};
    for (std::size_t k = 0; k < 3; ++k) {
        const SobolIndex& index = found.variables[k];
        const auto bound = [](const Estimated& e) { return 4.0 * (e.upper - e.lower) / 3.92; };
        checks.push_back(
            {fmt::format("S_{}", k + 1), "–", first[k], index.first.value, bound(index.first), Measure::absolute});
        checks.push_back(
            {fmt::format("T_{}", k + 1), "–", total[k], index.total.value, bound(index.total), Measure::absolute});
        checks.push_back({fmt::format("half-width of S_{}", k + 1), "–", 0.05,
                          0.5 * (index.first.upper - index.first.lower), 0.0, Measure::upper_bound});
    }
    return checks;
}

/// Lognormal in both kinds: P_q(x) = Phi((ln(x / theta) + beta_U z_q) / beta_R), mean curve with beta^2 = beta_R^2 + beta_U^2
/// (Kennedy et al. 1980).
struct LognormalBands {
    double median = 1.0, beta_aleatory = 0.4, beta_epistemic = 0.2;

    double probability(double x, double q) const
    {
        return normal_cdf((std::log(x / median) + beta_epistemic * normal_quantile(q)) / beta_aleatory);
    }
    double mean(double x) const { return normal_cdf(std::log(x / median) / std::hypot(beta_aleatory, beta_epistemic)); }
};

/// Lognormal pulse amplitude about an uncertain median friction: P_e and its percentiles, exact and with inner noise.
std::vector<Check> bands()
{
    constexpr std::uint32_t n = 4096, inner = 50;
    const LognormalBands closed{0.5, 0.4, 0.25};
    const double x = 0.42;
    const UnitPoints points(Sampling::sobol, 21, {"e"}, n);
    const Stream counts(22, "inner");
    std::vector<double> exact, noisy, none(n, 0.0), many(n, static_cast<double>(inner));
    for (std::uint32_t i = 0; i < n; ++i) {
        const double p =
            normal_cdf((std::log(x / closed.median) + closed.beta_epistemic * normal_quantile(points(i, 0))) /
                       closed.beta_aleatory);
        double z = 0.0;
        for (std::uint32_t k = 0; k < inner; ++k) z += counts.uniform(i, k) < p;
        exact.push_back(p);
        noisy.push_back(z / inner);
    }
    const EpistemicBands found = epistemic_bands(exact, none), with_noise = epistemic_bands(noisy, many);
    std::vector<Check> checks;
    for (std::size_t k = 0; k < band_levels.size(); ++k)
        checks.push_back({fmt::format("{:g} % of P_e", 100.0 * band_levels[k]), "–",
                          closed.probability(x, band_levels[k]), found.percentiles[k], 1e-3, Measure::absolute});
    checks.push_back({"mean curve, β² = β_R² + β_U²", "–", closed.mean(x), found.mean, 1e-5, Measure::absolute});
    // s.d. of a variance of n draws, kurtosis below 3: sqrt(2/n); of the noise taken off much less.
    const double noise_by_p = [&] {
        double sum = 0.0;
        for (const double p : exact) sum += p * (1.0 - p) / inner / n;
        return sum;
    }();
    checks.push_back({"variance of P_e with the noise of 50 samples taken off", "–", found.variance,
                      with_noise.variance, 4.0 * std::sqrt(2.0 / n)});
    checks.push_back(
        {"share of the noise", "–", noise_by_p / (noise_by_p + found.variance), with_noise.noise_share, 0.1});
    return checks;
}

} // namespace

void add_probability_sampling_cases(Registry& registry)
{
    registry.push_back(
        {"probability.stratified", "Stratified points have the variance of theirs, without the floor of a plain shift",
         "k/(12 N³): one point at random in each of N strata", "4 standard deviations of χ²", stratified_means});
    registry.push_back({"probability.ishigami", "Sobol' indices of the Ishigami function",
                        "Ishigami & Homma (1990), a = 7, b = 0.1",
                        "4 standard deviations of the bootstrap, with the half-width bounded", ishigami});
    registry.push_back({"probability.bands", "Bands of what is not known, and inner noise taken off",
                        "Φ((ln(x/θ) + β_U z_q)/β_R); mean with β_R² + β_U² (Kennedy et al. 1980)",
                        "percentiles of 4096 stratified points: 1/N over the density; variances: 4 standard deviations",
                        bands});
}

} // namespace damslip::verification
