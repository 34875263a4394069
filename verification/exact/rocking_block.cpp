#include "verification/exact/rocking_block.hpp"

#include <cmath>
#include <numbers>

namespace damslip::exact {

double Rocker::slenderness() const
{
    return std::atan(width / height);
}

double Rocker::frequency() const
{
    return std::sqrt(1.5 * gravity / std::hypot(width, height));
}

double Rocker::linear_period(double share) const
{
    return 4.0 / frequency() * std::acosh(1.0 / (1.0 - share));
}

double Rocker::quarter_period(double share) const
{
    // theta = theta_0 (1 - x^2): the root cancels, and the rest is smooth; 4000 intervals leave round-off.
    const double alpha = slenderness(), top = share * alpha;
    const auto f = [&](double x) {
        const double y = 0.5 * top * x * x;                                      // half the way back
        const double difference = 2.0 * std::sin(alpha - top + y) * std::sin(y); // of the two cosines
        const double shape = x > 0.0 ? x / std::sqrt(difference) : 1.0 / std::sqrt(top * std::sin(alpha - top));
        return 2.0 * top * shape;
    };
    constexpr int n = 4000;
    double sum = f(0.0) + f(1.0);
    for (int k = 1; k < n; ++k) sum += (k % 2 ? 4.0 : 2.0) * f(static_cast<double>(k) / n);
    return sum / (3.0 * n) / (std::numbers::sqrt2 * frequency());
}

double Rocker::landing_ratio() const
{
    const double s = std::sin(slenderness());
    return 1.0 - 1.5 * s * s;
}

double Rocker::starts() const
{
    return gravity * width / height;
}

} // namespace damslip::exact
