#include "sliding/empirical/slip_distribution.hpp"

#include <algorithm>
#include <cmath>

namespace damslip::sliding {

double SlipDistribution::below(double d) const
{
    if (median <= 0.0) return 1.0;
    const double z = std::log(d / median);
    const double share = sigma > 0.0 ? normal_cdf(z / sigma) : (z >= 0.0 ? 1.0 : 0.0);
    return zero + (1.0 - zero) * share;
}

// Bisection on ln D between bounds outside of which no member has weight.
double quantile(std::span<const SlipDistribution> mixture, double q)
{
    const auto below = [&](double d) {
        double p = 0.0;
        for (const SlipDistribution& m : mixture) p += m.weight * m.below(d);
        return p;
    };
    double low = 1e300, high = 0.0;
    for (const SlipDistribution& m : mixture)
        if (m.median > 0.0) {
            low = std::min(low, m.median * std::exp(-12.0 * m.sigma));
            high = std::max(high, m.median * std::exp(12.0 * m.sigma));
        }
    if (high == 0.0 || below(0.999 * low) >= q) return 0.0;
    double a = std::log(0.999 * low), b = std::log(high);
    for (int k = 0; k < 100; ++k) {
        const double middle = 0.5 * (a + b);
        (below(std::exp(middle)) >= q ? b : a) = middle;
    }
    return std::exp(b);
}

double normal_cdf(double z)
{
    return 0.5 * std::erfc(-z / std::sqrt(2.0));
}

} // namespace damslip::sliding
