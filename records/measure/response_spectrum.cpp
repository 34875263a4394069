#include "records/measure/response_spectrum.hpp"

#include "records/measure/oscillator.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace damslip::records {

namespace {

constexpr double rigid_below = 1e-3; // T / dt
constexpr double steps_per_period = 16.0;

/// Largest |y| of the cubic with values y0, y1 and rates r0, r1 at the ends of a step h, given r0 r1 < 0: one extreme
/// inside.
double cubic_peak(double y0, double r0, double y1, double r1, double h)
{
    // y'(s) = c0 + 2 c1 s + 3 c2 s^2, s in 0 ... 1
    const double c0 = h * r0, d = y1 - y0;
    const double c1 = 3.0 * d - h * (2.0 * r0 + r1), c2 = h * (r0 + r1) - 2.0 * d;
    const double q = -(c1 + std::copysign(std::sqrt(std::max(0.0, c1 * c1 - 3.0 * c0 * c2)), c1));
    double peak = 0.0;
    for (const double s : {q / (3.0 * c2), c0 / q})
        if (s > 0.0 && s < 1.0) peak = std::max(peak, std::abs(y0 + s * (c0 + s * (c1 + s * c2))));
    return peak;
}

/// Follows one response quantity y with rate r and keeps its largest |y|.
struct PeakKeeper {
    double y = 0.0, r = 0.0, peak = 0.0;
    void next(double y1, double r1, double h)
    {
        peak = std::max(peak, std::abs(y1));
        // An extreme below the peak found so far cannot matter: within a step it exceeds the ends by less than h |r|.
        if (r * r1 < 0.0 && std::max(std::abs(y), std::abs(y1)) + h * std::min(std::abs(r), std::abs(r1)) > peak)
            peak = std::max(peak, cubic_peak(y, r, y1, r1, h));
        y = y1;
        r = r1;
    }
};

class Oscillator {
public:
    Oscillator(double period, double ratio, double dt)
        : w_(2.0 * std::numbers::pi / period), ratio_(ratio),
          steps_(std::max(1, static_cast<int>(std::ceil(
                                 dt / period * std::max(steps_per_period, std::numbers::pi * (1.0 + 2.0 * ratio)))))),
          h_(dt / steps_), step_(w_, ratio, h_)
    {
    }

    /// One interval of the record, ground acceleration from a0 to a1.
    void interval(double a0, double a1)
    {
        const double change = (a1 - a0) / steps_;
        if (a0 != accel_end_) jump(a0);
        for (int j = 0; j < steps_; ++j) {
            const double before = a0 + j * change, after = j + 1 == steps_ ? a1 : a0 + (j + 1) * change;
            state_ = step_.advance(state_, before, after);
            keep(after);
        }
        accel_end_ = a1;
    }

    SpectrumPoint peaks(double period) const
    {
        return {period, displacement_.peak, velocity_.peak, w_ * w_ * displacement_.peak, absolute_.peak};
    }

private:
    void keep(double ground)
    {
        const double absolute = -w_ * (w_ * state_.displacement + 2.0 * ratio_ * state_.velocity); // u'' + a_g
        const double relative = absolute - ground;                                                 // u''
        displacement_.next(state_.displacement, state_.velocity, h_);
        velocity_.next(state_.velocity, relative, h_);
        absolute_.next(absolute, -w_ * (w_ * state_.velocity + 2.0 * ratio_ * relative), h_);
    }

    /// The ground acceleration jumps (first sample, end of the record): so do the rates that contain it.
    void jump(double ground)
    {
        accel_end_ = ground;
        const double absolute = -w_ * (w_ * state_.displacement + 2.0 * ratio_ * state_.velocity);
        velocity_.r = absolute - ground;
        absolute_.r = -w_ * (w_ * state_.velocity + 2.0 * ratio_ * velocity_.r);
    }

    double w_, ratio_;
    int steps_;
    double h_;
    OscillatorStep step_;
    OscillatorState state_;
    double accel_end_ = 0.0;
    PeakKeeper displacement_, velocity_, absolute_;
};

SpectrumPoint peak_response(std::span<const double> accel, double dt, double period, double ratio)
{
    if (period < rigid_below * dt || period <= 0.0) {
        double pga = 0.0;
        for (const double a : accel) pga = std::max(pga, std::abs(a));
        return {period, 0.0, 0.0, pga, pga};
    }
    Oscillator oscillator(period, ratio, dt);
    for (std::size_t k = 1; k < accel.size(); ++k) oscillator.interval(accel[k - 1], accel[k]);
    const auto tail = static_cast<long>(std::ceil(period / dt));
    for (long k = 0; k < tail; ++k) oscillator.interval(0.0, 0.0);
    return oscillator.peaks(period);
}

} // namespace

ResponseSpectrum response_spectrum(std::span<const double> accel, double dt, std::span<const double> periods,
                                   double ratio)
{
    assert(dt > 0.0 && ratio >= 0.0 && ratio <= 10.0);
    ResponseSpectrum spectrum{ratio, {}};
    spectrum.points.reserve(periods.size());
    for (const double period : periods) spectrum.points.push_back(peak_response(accel, dt, period, ratio));
    return spectrum;
}

double peak_absolute_acceleration(std::span<const double> accel, double dt, double frequency_hz, double ratio)
{
    assert(frequency_hz > 0.0);
    return peak_response(accel, dt, 1.0 / frequency_hz, ratio).absolute_acceleration;
}

std::vector<double> logarithmic_periods(double shortest, double longest, int count)
{
    assert(shortest > 0.0 && longest >= shortest && count >= 2);
    std::vector<double> periods(static_cast<std::size_t>(count));
    for (int k = 0; k < count; ++k)
        periods[static_cast<std::size_t>(k)] =
            shortest * std::pow(longest / shortest, static_cast<double>(k) / (count - 1));
    periods.back() = longest;
    return periods;
}

} // namespace damslip::records
