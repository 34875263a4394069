#include "probability/fit/interval.hpp"

#include "core/statistics.hpp"
#include "probability/laws/distribution.hpp"
#include "probability/laws/normal.hpp"
#include "probability/sampling/philox.hpp"

#include <algorithm>
#include <cmath>
#include <gsl/gsl_cdf.h>
#include <vector>

namespace damslip::probability {

Interval wilson(double z, double n, double confidence)
{
    return wilson_by_quantile(z, n, normal_quantile(0.5 + 0.5 * confidence));
}

Interval wilson_by_quantile(double z, double n, double k)
{
    const double p = z / n, s = k * k / n;
    const double centre = (p + 0.5 * s) / (1.0 + s), half = k / (1.0 + s) * std::sqrt(p * (1.0 - p) / n + 0.25 * s / n);
    return {z <= 0.0 ? 0.0 : std::max(0.0, centre - half), z >= n ? 1.0 : std::min(1.0, centre + half)};
}

Interval wilson_of_estimate(double p, double se, double n, double degrees, double confidence)
{
    const double inner = std::clamp(p, 0.5 / n, 1.0 - 0.5 / n); // p (1 - p) of a number of trials is 0 beyond the ends
    const double most = 20.0 * n;
    const double trials = se > 0.0 ? std::min(most, inner * (1.0 - inner) / (se * se)) : most;
    return wilson_by_quantile(std::clamp(p, 0.0, 1.0) * trials, trials,
                              gsl_cdf_tdist_Pinv(0.5 + 0.5 * confidence, degrees));
}

Interval jeffreys(double z, double n, double confidence)
{
    const Distribution posterior = Distribution::beta(z + 0.5, n - z + 0.5, 0.0, 1.0);
    return {z <= 0.0 ? 0.0 : posterior.quantile(0.5 - 0.5 * confidence),
            z >= n ? 1.0 : posterior.quantile(0.5 + 0.5 * confidence)};
}

double bound_of_none(double n, double confidence)
{
    return -std::expm1(std::log1p(-confidence) / n);
}

ClusterInterval cluster_bootstrap(std::size_t clusters,
                                  const std::function<double(std::span<const std::uint32_t>)>& statistic,
                                  std::uint64_t seed, double confidence, std::uint32_t draws)
{
    ClusterInterval interval;
    interval.clusters = clusters;
    interval.few = clusters < 10;
    if (clusters < 2) return interval; // one cluster says nothing of the others: 0 ... 1
    const Stream stream(seed, "bootstrap of clusters");
    const std::uint32_t count = static_cast<std::uint32_t>(clusters);
    std::vector<std::uint32_t> multiplicity(clusters, 1u);
    const double whole = statistic(multiplicity);
    const double stretch = std::sqrt(static_cast<double>(clusters) / static_cast<double>(clusters - 1));
    std::vector<double> values;
    for (std::uint32_t d = 0; d < draws; ++d) {
        std::fill(multiplicity.begin(), multiplicity.end(), 0u);
        for (std::uint32_t k = 0; k < count; ++k) ++multiplicity[stream.below(count, k, d)];
        const double value = statistic(multiplicity);
        if (std::isfinite(value)) values.push_back(whole + stretch * (value - whole));
    }
    interval.lower = percentile(values, 0.5 - 0.5 * confidence);
    interval.upper = percentile(values, 0.5 + 0.5 * confidence);
    return interval;
}

ClusterInterval cluster_proportion(std::span<const ClusterOutcome> outcomes, std::uint64_t seed, double confidence,
                                   std::uint32_t draws)
{
    std::vector<std::size_t> names;
    for (const ClusterOutcome& o : outcomes) names.push_back(o.cluster);
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
    std::vector<double> sum(names.size(), 0.0), count(names.size(), 0.0);
    for (const ClusterOutcome& o : outcomes) {
        const std::size_t k =
            static_cast<std::size_t>(std::lower_bound(names.begin(), names.end(), o.cluster) - names.begin());
        sum[k] += o.f;
        count[k] += 1.0;
    }
    ClusterInterval interval = cluster_bootstrap(
        names.size(),
        [&](std::span<const std::uint32_t> multiplicity) {
            double f = 0.0, n = 0.0;
            for (std::size_t k = 0; k < sum.size(); ++k) f += multiplicity[k] * sum[k], n += multiplicity[k] * count[k];
            return f / n;
        },
        seed, confidence, draws);
    interval.lower = std::clamp(interval.lower, 0.0, 1.0);
    interval.upper = std::clamp(interval.upper, 0.0, 1.0);
    return interval;
}

} // namespace damslip::probability
