#include "verification/exact/oscillator.hpp"

#include <cmath>
#include <numbers>

namespace damslip::exact {

namespace {
struct Parts {
    double p, q, w_d, c, s;
};
Parts parts(const RampedOscillator& o)
{
    const double q = -o.slope / (o.w * o.w), p = -o.a0 / (o.w * o.w) + 2.0 * o.zeta * o.slope / (o.w * o.w * o.w);
    const double w_d = o.w * std::sqrt(1.0 - o.zeta * o.zeta), c = o.u0 - p;
    return {p, q, w_d, c, (o.v0 - q + o.zeta * o.w * c) / w_d};
}
} // namespace

double RampedOscillator::displacement(double t) const
{
    const auto [p, q, w_d, c, s] = parts(*this);
    return p + q * t + std::exp(-zeta * w * t) * (c * std::cos(w_d * t) + s * std::sin(w_d * t));
}

double RampedOscillator::velocity(double t) const
{
    const auto [p, q, w_d, c, s] = parts(*this);
    return q + std::exp(-zeta * w * t) *
                   ((s * w_d - zeta * w * c) * std::cos(w_d * t) - (c * w_d + zeta * w * s) * std::sin(w_d * t));
}

double step_pseudo_acceleration(double acceleration, double zeta)
{
    return acceleration * (1.0 + std::exp(-std::numbers::pi * zeta / std::sqrt(1.0 - zeta * zeta)));
}

} // namespace damslip::exact
