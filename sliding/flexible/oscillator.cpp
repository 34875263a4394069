#include "sliding/flexible/oscillator.hpp"

#include <cmath>

namespace damslip::sliding {

Oscillator::Oscillator(double omega, double damping, double inertia)
    : stiffness_(omega * omega), damping_(2.0 * damping * omega), decay_(damping * omega / inertia),
      square_(stiffness_ / inertia - decay_ * decay_), free_stiffness_(stiffness_ / inertia)
{
}

OscillatorState Oscillator::after(const OscillatorState& now, double p0, double p1, double h) const
{
    // Particular solution, linear in time; the rest is free.
    const double v_p = p1 / stiffness_;
    const double x_p = (p0 - damping_ * v_p) / stiffness_;
    const double x = now.x - x_p, v = now.v - v_p;
    double even = 1.0, odd = h; // cos(d h), sin(d h)/d
    const double d = std::sqrt(std::abs(square_));
    if (d * h > 1e-8) {
        even = square_ > 0.0 ? std::cos(d * h) : std::cosh(d * h);
        odd = (square_ > 0.0 ? std::sin(d * h) : std::sinh(d * h)) / d;
    }
    const double fade = std::exp(-decay_ * h);
    return {x_p + v_p * h + fade * (x * even + (v + decay_ * x) * odd),
            v_p + fade * (v * even - (free_stiffness_ * x + decay_ * v) * odd)};
}

} // namespace damslip::sliding
