#include "records/measure/intensity.hpp"

#include "core/units.hpp"

#include <cassert>
#include <cmath>
#include <cstddef>

namespace damslip::records {

namespace {

/// Integral of a^2 over the part x = 0 ... 1 of an interval, in units of dt; a goes from a0 linearly by `change` per
/// interval.
double squared_integral(double a0, double change, double x)
{
    return x * (a0 * a0 + x * change * (a0 + x * change / 3.0));
}

/// The x in [0, 1] at which squared_integral reaches `wanted`: Newton's method kept inside a shrinking bracket (the
/// function rises).
double fraction_of_interval(double a0, double change, double wanted)
{
    double low = 0.0, high = 1.0, x = 0.5;
    for (int k = 0; k < 100; ++k) {
        const double excess = squared_integral(a0, change, x) - wanted;
        (excess > 0.0 ? high : low) = x;
        const double a = a0 + x * change;
        const double newton = x - excess / (a * a);
        const double next = newton > low && newton < high ? newton : 0.5 * (low + high);
        if (std::abs(next - x) <= 1e-16) return next;
        x = next;
    }
    return x;
}

/// Integral of a^2 dt over the whole record [m^2/s^3].
double squared_integral(std::span<const double> accel, double dt)
{
    double sum = 0.0;
    for (std::size_t k = 1; k < accel.size(); ++k) sum += squared_integral(accel[k - 1], accel[k] - accel[k - 1], 1.0);
    return sum * dt;
}

/// First time at which the running integral of a^2 reaches `wanted` [m^2/s^3]. @returns [s]
double arrival_time(std::span<const double> accel, double dt, double wanted)
{
    double sum = 0.0;
    for (std::size_t k = 1; k < accel.size(); ++k) {
        const double change = accel[k] - accel[k - 1];
        const double whole = squared_integral(accel[k - 1], change, 1.0);
        if (whole > 0.0 && (sum + whole) * dt >= wanted)
            return dt * (static_cast<double>(k - 1) + fraction_of_interval(accel[k - 1], change, wanted / dt - sum));
        sum += whole;
    }
    return dt * static_cast<double>(accel.size() - 1);
}

} // namespace

double arias_intensity(std::span<const double> accel, double dt)
{
    return std::numbers::pi / (2.0 * units::standard_gravity) * squared_integral(accel, dt);
}

double cumulative_absolute_velocity(std::span<const double> accel, double dt)
{
    double sum = 0.0;
    for (std::size_t k = 1; k < accel.size(); ++k) {
        const double a0 = std::abs(accel[k - 1]), a1 = std::abs(accel[k]);
        const bool crosses = accel[k - 1] * accel[k] < 0.0;
        sum += crosses ? (a0 * a0 + a1 * a1) / (a0 + a1) : a0 + a1;
    }
    return 0.5 * dt * sum;
}

double significant_duration(std::span<const double> accel, double dt, double from, double to)
{
    assert(0.0 <= from && from < to && to <= 1.0);
    const double total = squared_integral(accel, dt);
    if (total <= 0.0) return 0.0;
    return arrival_time(accel, dt, to * total) - arrival_time(accel, dt, from * total);
}

} // namespace damslip::records
