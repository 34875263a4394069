#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

namespace damslip {

/// Value below which the share q of the sorted samples lies, linear between order statistics (Hyndman & Fan 1996, type 7).
inline double percentile(std::vector<double> samples, double q)
{
    if (samples.empty()) return std::nan("");
    std::sort(samples.begin(), samples.end());
    const double at = q * static_cast<double>(samples.size() - 1);
    const auto below = static_cast<std::size_t>(at);
    const std::size_t above = std::min(below + 1, samples.size() - 1);
    return samples[below] + (at - static_cast<double>(below)) * (samples[above] - samples[below]);
}

/// The least of the samples up to which their weights reach the share q; with equal weights as without them.
inline double percentile(const std::vector<double>& samples, const std::vector<double>& weights, double q)
{
    if (samples.empty() || std::ranges::all_of(weights, [&](double w) { return w == weights.front(); }))
        return percentile(samples, q);
    std::vector<std::size_t> order(samples.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, {}, [&](std::size_t i) { return samples[i]; });
    double left = q * std::accumulate(weights.begin(), weights.end(), 0.0) * (1.0 - 1e-12);
    for (const std::size_t i : order)
        if ((left -= weights[i]) <= 0.0) return samples[i];
    return samples[order.back()];
}

} // namespace damslip
