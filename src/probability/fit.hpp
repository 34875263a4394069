#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace damslip::probability {

enum class Link {
    probit, ///< p = Phi(eta)
    logit   ///< p = 1 / (1 + e^-eta)
};
enum class Penalty {
    none, ///< maximum likelihood; the caller knows that it exists
    firth ///< likelihood times sqrt(det information) (Firth 1993): exists for any counts
};

/// eta = b_0 + b_1 x_1 + ... + b_k x_k and its likelihood sum z ln p + (n - z) ln(1 - p), 0 <= z <= n, real numbers allowed.
struct BinaryFit {
    Link link = Link::probit;
    std::vector<double> coefficients; ///< b_0 ... b_k
    std::vector<double> covariance;   ///< inverse of the expected information, row by row
    int iterations = 0;
    bool converged =
        false; ///< Newton decrement below 1e-20 of the log-likelihood, or 1e-12 where no step rises any more

    double eta(std::span<const double> x) const;
    double probability(std::span<const double> x) const;
};

/// Newton's method with halved steps; a covariate that does not vary, or is a linear combination of those before it, has the coefficient 0.
/// @param x  k covariates a row, row by row; k = x.size() / n.size()
BinaryFit fit_binary(Link link, Penalty penalty, std::span<const double> x, std::span<const double> n,
                     std::span<const double> z);

/// One covariate: whether the likelihood has a maximum. It has where successes and survivals overlap: the lowest x with a success lies below the
/// highest with a survival, and the lowest with a survival below the highest with a success (Albert & Anderson 1984).
bool likelihood_has_maximum(std::span<const double> x, std::span<const double> n, std::span<const double> z);

/// Intervals of a probability from counts.

struct Interval {
    double lower = 0.0, upper = 1.0;
    bool contains(double p) const { return lower <= p && p <= upper; }
    double half_width() const { return 0.5 * (upper - lower); }
};

/// Wilson (1927), for z of n independent trials: |p_hat - p| <= k sqrt(p (1 - p) / n) solved for p. z and n may be real (n_eff).
/// z = 0: lower end exactly 0; z = n: upper end exactly 1.
Interval wilson(double z, double n, double confidence = 0.95);

/// Of an estimate p with a standard error: Wilson's with n_eff = p (1 - p) / se^2 trials, at most 20 n, and the quantile of Student's t. At p <= 0
/// or >= 1, where that is no number of trials, p is taken at 1 / (2 n) from the end.
/// @param degrees  of freedom of se, n - 1 of independent samples with normal errors
Interval wilson_of_estimate(double p, double se, double n, double degrees, double confidence = 0.95);

/// Largest p under which no event in n trials has the probability 1 - confidence: 1 - 0.05^(1/n). No failure: upper bound of p;
/// all failed: 1 minus it is the lower bound.
double bound_of_none(double n, double confidence = 0.95);

/// Interval by drawing whole clusters with replacement.
struct ClusterInterval : Interval {
    std::size_t clusters = 0;
    bool few = false; ///< fewer than 10 clusters: the interval is too short
};

/// @param statistic  value for the clusters with these multiplicities (how often each was drawn)
/// Deviations from the statistic of all are stretched by sqrt(R / (R - 1)), R the number of clusters, as a bootstrap variance is (R - 1) / R short.
ClusterInterval cluster_bootstrap(std::size_t clusters,
                                  const std::function<double(std::span<const std::uint32_t>)>& statistic,
                                  std::uint64_t seed, double confidence = 0.95, std::uint32_t draws = 2000);

/// Fragility P(D > d | x) = Phi(ln(x / median) / beta).
struct LognormalCurve {
    double median = 1.0; ///< theta, unit of the intensity
    double beta = 0.4;   ///< standard deviation of ln x at failure, > 0; 0: a step at the median
    double probability(double x) const;
    double level(double p) const; ///< x with that probability
};

/// What one stripe gave. Real numbers are allowed (weighted runs, expected counts).
struct StripeCount {
    double x = 0.0; ///< intensity, > 0
    double n = 0.0; ///< runs with an answer
    double z = 0.0; ///< those with D > d
};

enum class FitMethod {
    likelihood, ///< maximum likelihood (Baker 2015)
    firth,      ///< penalised: the likelihood has no maximum for these counts
    none        ///< no lognormal curve; `why` says it
};

struct LognormalFit {
    FitMethod method = FitMethod::none;
    std::string why;                                ///< of firth and none, a sentence
    LognormalCurve curve;                           ///< of likelihood and firth
    double b0 = 0.0, b1 = 0.0;                      ///< Phi(b0 + b1 ln x): median = e^(-b0/b1), beta = 1 / b1
    double var_b0 = 0.0, cov_b = 0.0, var_b1 = 0.0; ///< inverse of the expected information
    int iterations = 0;
    double deviance = 0.0;   ///< 2 sum z ln(z / np) + (n - z) ln((n - z) / (n (1 - p)))
    int degrees = 0;         ///< levels - 2
    double deviance_p = 1.0; ///< P(chi^2 > deviance); 1 without degrees of freedom
    bool lognormal() const { return method != FitMethod::none && deviance_p >= 0.01; } ///< else the raw curve is shown

    /// Pointwise interval of the curve: Phi(eta +- k sqrt(var eta)). Of independent runs; clusters: bootstrap fit_lognormal.
    Interval interval(double x, double confidence = 0.95) const;
};

/// The likelihood has a maximum with b1 > 0 only where the lowest level with a failure lies below the highest with a survival (and the lowest
/// with a survival below the highest with a failure). Else Firth's penalty; none: all survive, all fail, one level, or a curve that falls.
/// @throws ParameterError for x <= 0, n < 0, z outside 0 ... n
LognormalFit fit_lognormal(std::span<const StripeCount> stripes);

/// Lognormal capacities of an incremental dynamic analysis.
struct CapacityFit {
    bool found = false;
    std::string why; ///< where not found
    LognormalCurve curve;
    std::size_t reached = 0, censored = 0;
    double se_log_median = 0.0, se_beta = 0.0; ///< standard errors by the information matrix
    int iterations = 0;                        ///< 0: by moments
};

/// @param reached      levels at which a record first has D > d, > 0
/// @param censored_at  highest level tried of each record that never has it
/// None censored: mean and standard deviation (n - 1) of the logarithms. Else the maximum of
///     sum ln[phi(z_r) / (beta x_r)] + sum ln[1 - Phi(z_c)],   z = ln(x / theta) / beta       Baker (2015), eq. (5)-(6),
/// concave in 1 / beta and ln(theta) / beta. Not found with fewer than two different levels reached.
CapacityFit fit_capacities(std::span<const double> reached, std::span<const double> censored_at);

inline constexpr std::array<double, 5> band_levels{0.05, 0.16, 0.50, 0.84, 0.95};

/// What lack of knowledge leaves open: percentiles over the epistemic draws e of P_e, each estimated with n_e aleatory samples.
struct EpistemicBands {
    std::array<double, 5> percentiles{}; ///< of P_e, at band_levels
    double mean = 0.0;                   ///< E P_e: the curve for rates
    double variance = 0.0;               ///< of P_e: s^2(p_hat) - mean p_hat (1 - p_hat) / (n - 1), not below 0
    double noise_share = 0.0;            ///< what the inner samples add to s^2(p_hat) [-]
    bool add_inner = false;              ///< noise_share > 20 %: the bands are too wide, more inner samples are needed
};

/// @param p_hat  estimate of P_e of each draw
/// @param inner  number of independent aleatory samples behind each; 0: exact
/// @throws ParameterError for fewer than 2 draws, sizes that differ, inner = 1
EpistemicBands epistemic_bands(std::span<const double> p_hat, std::span<const double> inner);

} // namespace damslip::probability
