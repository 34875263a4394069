#include "verification/exact/damped_oscillator.hpp"

#include <cmath>

namespace damslip::exact {

Motion DampedOscillator::free(double displacement, double velocity, double time) const
{
    const double damped = omega * std::sqrt(1.0 - ratio * ratio), decay = std::exp(-ratio * omega * time);
    const double c = std::cos(damped * time), s = std::sin(damped * time);
    const double b = (velocity + ratio * omega * displacement) / damped;
    const double u = decay * (displacement * c + b * s);
    return {u, -ratio * omega * u + decay * damped * (b * c - displacement * s)};
}

Motion DampedOscillator::step(double load, double time) const
{
    const double still = load / (omega * omega);
    const Motion vibration = free(-still, 0.0, time);
    return {still + vibration.displacement, vibration.velocity};
}

Motion DampedOscillator::harmonic(double load, double load_omega, double time) const
{
    const double r = load_omega / omega, in_phase = 1.0 - r * r, quadrature = 2.0 * ratio * r;
    const double scale = load / (omega * omega) / (in_phase * in_phase + quadrature * quadrature);
    const double s = std::sin(load_omega * time), c = std::cos(load_omega * time);
    const Motion vibration = free(scale * quadrature, -scale * in_phase * load_omega, time);
    return {scale * (in_phase * s - quadrature * c) + vibration.displacement,
            scale * load_omega * (in_phase * c + quadrature * s) + vibration.velocity};
}

double DampedOscillator::transmissibility(double ground_omega) const
{
    const double r = ground_omega / omega, q = 2.0 * ratio * r;
    return std::sqrt((1.0 + q * q) / ((1.0 - r * r) * (1.0 - r * r) + q * q));
}

} // namespace damslip::exact
