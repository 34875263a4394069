#pragma once

#include <cstdint>
#include <functional>
#include <span>

/// Intervals of a probability from counts.
namespace damslip::probability {

struct Interval {
    double lower = 0.0, upper = 1.0;
    bool contains(double p) const { return lower <= p && p <= upper; }
    double half_width() const { return 0.5 * (upper - lower); }
};

/// Wilson (1927), for z of n independent trials: |p_hat - p| <= k sqrt(p (1 - p) / n) solved for p. z and n may be real (n_eff).
/// z = 0: lower end exactly 0; z = n: upper end exactly 1.
Interval wilson(double z, double n, double confidence = 0.95);

/// The same for a given quantile k, where it is not that of the normal distribution.
Interval wilson_by_quantile(double z, double n, double k);

/// Of an estimate p with a standard error: Wilson's with n_eff = p (1 - p) / se^2 trials, at most 20 n, and the quantile of Student's t. At p <= 0
/// or >= 1, where that is no number of trials, p is taken at 1 / (2 n) from the end.
/// @param degrees  of freedom of se, n - 1 of independent samples with normal errors
Interval wilson_of_estimate(double p, double se, double n, double degrees, double confidence = 0.95);

/// Beta(z + 1/2, n - z + 1/2) at both ends, 0 at z = 0 and 1 at z = n (Brown, Cai & DasGupta 2001).
Interval jeffreys(double z, double n, double confidence = 0.95);

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

/// One outcome: f = 1 or 0 (or a share between), met by the cluster (an event) it belongs to.
struct ClusterOutcome {
    std::size_t cluster = 0;
    double f = 0.0;
};

/// The mean of f, by clusters. Ends are kept within 0 and 1.
ClusterInterval cluster_proportion(std::span<const ClusterOutcome> outcomes, std::uint64_t seed,
                                   double confidence = 0.95, std::uint32_t draws = 2000);

} // namespace damslip::probability
