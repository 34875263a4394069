#include "records/measure/peaks.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace damslip::records {

namespace {

/// One interval with local time x in (0, dt): a = a0 + slope x.
struct Interval {
    double a0, slope, v0, u0;
    double velocity(double x) const { return v0 + x * (a0 + x * slope / 2.0); }
    double displacement(double x) const { return u0 + x * (v0 + x * (a0 / 2.0 + x * slope / 6.0)); }
};

void count_velocity_extreme(const Interval& i, double dt, Peaks& peaks)
{
    const double x = -i.a0 / i.slope; // acceleration zero; NaN or infinite where there is none, and then outside
    if (x > 0.0 && x < dt) peaks.velocity = std::max(peaks.velocity, std::abs(i.velocity(x)));
}

/// Roots of v0 + a0 x + slope x^2/2 inside (0, dt), without cancellation.
void count_displacement_extremes(const Interval& i, double dt, Peaks& peaks)
{
    const double discriminant = i.a0 * i.a0 - 2.0 * i.slope * i.v0;
    if (discriminant < 0.0) return;
    const double q = -(i.a0 + std::copysign(std::sqrt(discriminant), i.a0));
    for (const double x : {q / i.slope, 2.0 * i.v0 / q})
        if (x > 0.0 && x < dt) peaks.displacement = std::max(peaks.displacement, std::abs(i.displacement(x)));
}

} // namespace

Peaks motion_peaks(std::span<const double> accel, double dt)
{
    Peaks peaks;
    double v = 0.0, u = 0.0;
    for (std::size_t k = 0; k < accel.size(); ++k) {
        if (std::abs(accel[k]) > peaks.acceleration) {
            peaks.acceleration = std::abs(accel[k]);
            peaks.acceleration_time = dt * static_cast<double>(k);
        }
        if (k == 0) continue;
        const Interval i{accel[k - 1], (accel[k] - accel[k - 1]) / dt, v, u};
        count_velocity_extreme(i, dt, peaks);
        count_displacement_extremes(i, dt, peaks);
        v = v + 0.5 * dt * (accel[k - 1] + accel[k]);
        u = i.displacement(dt);
        peaks.velocity = std::max(peaks.velocity, std::abs(v));
        peaks.displacement = std::max(peaks.displacement, std::abs(u));
    }
    peaks.final_velocity = v;
    peaks.final_displacement = u;
    return peaks;
}

} // namespace damslip::records
