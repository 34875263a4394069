#include "core/statistics.hpp"

#include <algorithm>
#include <cmath>

namespace damslip {

double percentile(std::vector<double> samples, double q)
{
    if (samples.empty()) return std::nan("");
    std::sort(samples.begin(), samples.end());
    const double at = q * static_cast<double>(samples.size() - 1);
    const auto below = static_cast<std::size_t>(at);
    const std::size_t above = std::min(below + 1, samples.size() - 1);
    return samples[below] + (at - static_cast<double>(below)) * (samples[above] - samples[below]);
}

} // namespace damslip
