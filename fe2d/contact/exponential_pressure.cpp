#include "fe2d/contact/exponential_pressure.hpp"

#include <cassert>
#include <cmath>
#include <numbers>

namespace damslip::fe2d {

namespace {

constexpr double deepest = ExponentialPressure::deepest;

double slope(double z) // of z (exp z - 1)
{
    return std::expm1(z) + z * std::exp(z);
}

/// ∫ z (exp z - 1) dz from 0. The closed form loses all digits at small z, where a series is summed.
double integral(double z)
{
    if (z > 0.5) return (z - 1.0) * std::exp(z) + 1.0 - 0.5 * z * z;
    double sum = 0.0, term = z; // z^(k+1)/k!
    for (int k = 1; k < 20; ++k) {
        term *= z / k;
        sum += term * z / (k + 2);
    }
    return sum;
}

} // namespace

ExponentialPressure::ExponentialPressure(double at_zero_clearance, double at_zero_pressure)
    : unit_(at_zero_clearance / (std::numbers::e - 1.0)), range_(at_zero_pressure)
{
    assert(at_zero_clearance > 0.0 && at_zero_pressure > 0.0);
}

double ExponentialPressure::pressure(double clearance) const
{
    const double z = 1.0 - clearance / range_;
    if (z <= 0.0) return 0.0;
    if (z <= deepest) return unit_ * z * std::expm1(z);
    return unit_ * (deepest * std::expm1(deepest) + slope(deepest) * (z - deepest));
}

double ExponentialPressure::stiffness(double clearance) const
{
    const double z = 1.0 - clearance / range_;
    if (z <= 0.0) return 0.0;
    return unit_ / range_ * slope(z < deepest ? z : deepest);
}

double ExponentialPressure::energy(double clearance) const
{
    const double z = 1.0 - clearance / range_;
    if (z <= 0.0) return 0.0;
    if (z <= deepest) return unit_ * range_ * integral(z);
    const double beyond = z - deepest;
    return unit_ * range_ *
           (integral(deepest) + beyond * (deepest * std::expm1(deepest) + 0.5 * beyond * slope(deepest)));
}

double ExponentialPressure::clearance(double pressure) const
{
    assert(pressure > 0.0);
    const double q = pressure / unit_;
    const double last = deepest * std::expm1(deepest);
    if (q >= last) return range_ * (1.0 - deepest - (q - last) / slope(deepest));
    // z² <= z (exp z - 1) everywhere and exp z - 1 <= z (exp z - 1) from z = 1 on: Newton falls from above, the function
    // being convex.
    double z = q < std::numbers::e - 1.0 ? std::sqrt(q) : std::log1p(q);
    for (int k = 0; k < 60; ++k) {
        const double step = (z * std::expm1(z) - q) / slope(z);
        z -= step;
        if (std::abs(step) <= 1e-15 * z) break;
    }
    return range_ * (1.0 - z);
}

} // namespace damslip::fe2d
