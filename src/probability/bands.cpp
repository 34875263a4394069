#include "probability/bands.hpp"

#include "core/statistics.hpp"
#include "probability/distribution.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <vector>

namespace damslip::probability {

EpistemicBands epistemic_bands(std::span<const double> p_hat, std::span<const double> inner)
{
    if (p_hat.size() < 2) throw ParameterError("draws", fmt::format("{}", p_hat.size()), "2 epistemic draws at least");
    if (p_hat.size() != inner.size())
        throw ParameterError("inner", fmt::format("{}", inner.size()), fmt::format("{} numbers", p_hat.size()));
    EpistemicBands bands;
    const double n = static_cast<double>(p_hat.size());
    for (const double p : p_hat) bands.mean += p / n;
    double spread = 0.0, noise = 0.0;
    for (std::size_t e = 0; e < p_hat.size(); ++e) {
        if (inner[e] == 1.0) throw ParameterError("inner", "1", "0 (exact), or 2 samples at least");
        spread += std::pow(p_hat[e] - bands.mean, 2) / (n - 1.0);
        if (inner[e] > 0.0) noise += p_hat[e] * (1.0 - p_hat[e]) / (inner[e] - 1.0) / n;
    }
    bands.variance = std::max(0.0, spread - noise);
    bands.noise_share = spread > 0.0 ? std::min(1.0, noise / spread) : 0.0;
    bands.add_inner = bands.noise_share > 0.2;
    const std::vector<double> values(p_hat.begin(), p_hat.end());
    for (std::size_t k = 0; k < band_levels.size(); ++k) bands.percentiles[k] = percentile(values, band_levels[k]);
    return bands;
}

double LognormalBands::probability(double x, double q) const
{
    return normal_cdf((std::log(x / median) + beta_epistemic * normal_quantile(q)) / beta_aleatory);
}

double LognormalBands::mean(double x) const
{
    return normal_cdf(std::log(x / median) / std::hypot(beta_aleatory, beta_epistemic));
}

} // namespace damslip::probability
