#include "sliding/flexible/strain_column.hpp"

#include "sliding/flexible/oscillator.hpp"

#include <algorithm>
#include <cmath>

namespace damslip::sliding {

namespace {

using std::numbers::pi;
constexpr int most_iterations = 200;

double radiation_damping(const StrainColumn& column, double velocity)
{
    if (column.base_velocity <= 0.0) return 0.0;
    return std::min(0.2, 0.55016 * std::pow(column.base_velocity / velocity, -0.9904));
}

/// 0.62 (G/G_0)^0.1 of Masing's hysteresis of the hyperbola, and 1 % at no strain. @param ratio  gamma/gamma_r, > 0
double material_damping(double ratio)
{
    const double masing = 1.0 / pi * (4.0 * (ratio - std::log1p(ratio)) * (1.0 + ratio) / (ratio * ratio) - 2.0);
    return 0.62 * std::pow(1.0 + ratio, -0.1) * masing + 0.01;
}

FlexibleBlock mode_of(const StrainColumn& column, double velocity, double damping, double mass_ratio)
{
    return {4.0 * column.height / velocity, std::min(0.5, damping), mass_ratio};
}

/// Largest |x| at the samples and one period after them [m].
double largest_deflection(const FlexibleBlock& block, const GroundMotion& motion)
{
    if (motion.accel_h.empty()) return 0.0;
    const double omega = 2.0 * pi / block.period;
    const Oscillator mode(omega, block.damping_ratio, 1.0);
    OscillatorState state;
    double largest = 0.0;
    const std::vector<double>& a = motion.accel_h;
    for (std::size_t k = 0; k + 1 < a.size(); ++k) {
        state = mode.after(state, a[k], (a[k + 1] - a[k]) / motion.dt, motion.dt);
        largest = std::max(largest, std::abs(state.x));
    }
    for (double t = 0.0; t < block.period; t += motion.dt) {
        state = mode.after(state, 0.0, 0.0, motion.dt);
        largest = std::max(largest, std::abs(state.x));
    }
    return largest;
}

} // namespace

StrainCompatible strain_compatible(const StrainColumn& column, const GroundMotion& motion, double mass_ratio,
                                   double tolerance)
{
    StrainCompatible now;
    now.velocity = column.velocity;
    double material = column.damping;
    now.block = mode_of(column, now.velocity, material + radiation_damping(column, now.velocity), mass_ratio);
    const auto strain = [&] { return 0.65 * 1.57 * 4.0 / pi * largest_deflection(now.block, motion) / column.height; };
    if (column.reference_strain <= 0.0) {
        now.strain = strain();
        return now;
    }
    now.settled = false;
    while (!now.settled && now.iterations < most_iterations) {
        ++now.iterations;
        now.strain = strain();
        const double ratio = std::max(1e-9, now.strain / column.reference_strain);
        double velocity = column.velocity / std::sqrt(1.0 + ratio), damping = material_damping(ratio);
        now.settled = std::abs(1.0 - velocity * velocity / (now.velocity * now.velocity)) <= tolerance &&
                      std::abs(1.0 - damping / material) <= tolerance;
        if (!now.settled && now.iterations > most_iterations / 4) { // it goes to and fro between two peaks: half steps
            velocity = 0.5 * (velocity + now.velocity);
            damping = 0.5 * (damping + material);
        }
        now.velocity = velocity;
        material = damping;
        now.block = mode_of(column, velocity, material + radiation_damping(column, velocity), mass_ratio);
    }
    return now;
}

} // namespace damslip::sliding
