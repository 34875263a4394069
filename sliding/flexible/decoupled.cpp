#include "sliding/flexible/flexible_slide.hpp"
#include "sliding/flexible/oscillator.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace damslip::sliding {

namespace {

double omega_of(const FlexibleBlock& flexible)
{
    return 2.0 * std::numbers::pi / flexible.period;
}

/// Until the free vibration has faded to 1e-4.
double tail_length(const FlexibleBlock& flexible, double tail_max)
{
    const double rate = flexible.damping_ratio * omega_of(flexible);
    return rate * tail_max > std::log(1e4) ? std::log(1e4) / rate : tail_max;
}

} // namespace

GroundMotion average_motion(const GroundMotion& motion, const FlexibleBlock& flexible, double tail_max)
{
    const auto parts = static_cast<std::size_t>(std::clamp(std::ceil(80.0 * motion.dt / flexible.period), 1.0, 400.0));
    const double h = motion.dt / static_cast<double>(parts), gamma = flexible.mass_ratio;
    const Oscillator mode(omega_of(flexible), flexible.damping_ratio, 1.0);
    GroundMotion average;
    average.name = motion.name;
    average.dt = h;
    average.notes = motion.notes;
    OscillatorState state;
    // x'' = a_h - restoring, so k = (1 - Gamma) a_h + Gamma restoring.
    const auto add = [&](double a_h, double a_v) {
        average.accel_h.push_back((1.0 - gamma) * a_h + gamma * mode.restoring(state));
        if (!motion.accel_v.empty()) average.accel_v.push_back(a_v);
    };
    const auto vertical = [&](std::size_t k) { return motion.accel_v.empty() ? 0.0 : motion.accel_v[k]; };
    add(motion.accel_h.front(), vertical(0));
    for (std::size_t k = 0; k + 1 < motion.accel_h.size(); ++k) {
        const double a0 = motion.accel_h[k], slope = (motion.accel_h[k + 1] - a0) / motion.dt;
        const double v0 = vertical(k), v_slope = (vertical(k + 1) - v0) / motion.dt;
        for (std::size_t i = 0; i < parts; ++i) {
            const double t = h * static_cast<double>(i);
            state = mode.after(state, a0 + slope * t, slope, h);
            add(a0 + slope * (t + h), v0 + v_slope * (t + h));
        }
    }
    const auto tail = static_cast<std::size_t>(std::ceil(tail_length(flexible, tail_max) / h));
    for (std::size_t i = 0; i < tail; ++i) {
        state = mode.after(state, 0.0, 0.0, h);
        add(0.0, 0.0);
    }
    return average;
}

FlexibleSlide slide_decoupled(const GroundMotion& motion, const SlipStages& stages, const FlexibleBlock& flexible,
                              const SlideOptions& options)
{
    check_flexible(flexible, stages);
    check_motion(motion);
    const GroundMotion average = average_motion(motion, flexible, options.sliding.run_out_max);
    FlexibleSlide result;
    for (const double k : average.accel_h) result.peak_acceleration = std::max(result.peak_acceleration, std::abs(k));
    result.slide = slide(average, stages, options);
    return result;
}

} // namespace damslip::sliding
