#include "records/measure/measures.hpp"

#include "core/units.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <complex>
#include <cstddef>
#include <gsl/gsl_fft_real.h>
#include <numbers>
#include <vector>

namespace damslip::records {

Measures measure(const Record& record)
{
    const std::span<const double> accel = record.acceleration;
    const Peaks peaks = motion_peaks(accel, record.dt);
    Measures m;
    m.duration = record.duration();
    m.pga = peaks.acceleration;
    m.pga_time = peaks.acceleration_time;
    m.pgv = peaks.velocity;
    m.pgd = peaks.displacement;
    m.final_velocity = peaks.final_velocity;
    m.final_displacement = peaks.final_displacement;
    m.arias_intensity = arias_intensity(accel, record.dt);
    m.cumulative_velocity = cumulative_absolute_velocity(accel, record.dt);
    m.duration_5_75 = significant_duration(accel, record.dt, 0.05, 0.75);
    m.duration_5_95 = significant_duration(accel, record.dt, 0.05, 0.95);
    m.mean_period = mean_period(accel, record.dt);
    return m;
}

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

namespace {

/// |sum a_k exp(-i w k dt)|^2, by Horner's rule.
double power(std::span<const double> accel, double angle)
{
    const std::complex<double> turn = std::polar(1.0, -angle);
    std::complex<double> sum = 0.0;
    for (std::size_t k = accel.size(); k-- > 0;) sum = sum * turn + accel[k];
    return std::norm(sum);
}

} // namespace

double frequency_below(std::span<const double> accel, double dt, double share)
{
    assert(dt > 0.0 && share >= 0.0 && share <= 1.0);
    constexpr double df = 0.1, largest = 50.0;
    std::vector<double> below{0.0};
    double before = power(accel, 0.0);
    for (double f = df; f <= std::min(largest, 0.5 / dt) + 1e-9; f = df * static_cast<double>(below.size())) {
        const double now = power(accel, 2.0 * std::numbers::pi * f * dt);
        below.push_back(below.back() + 0.5 * (before + now));
        before = now;
    }
    if (below.back() == 0.0) return 0.0;
    const auto at = std::lower_bound(below.begin(), below.end(), share * below.back());
    return df * static_cast<double>(at - below.begin());
}

std::optional<double> mean_period(std::span<const double> accel, double dt)
{
    constexpr double lowest = 0.25, highest = 20.0, widest_step = 0.05; // [Hz]
    const auto samples_for_step = static_cast<std::size_t>(std::min(std::ceil(1.0 / (widest_step * dt)), 1e8));
    const std::size_t n = std::bit_ceil(std::max({accel.size(), samples_for_step, std::size_t{4}}));
    std::vector<double> spectrum(n, 0.0);
    std::copy(accel.begin(), accel.end(), spectrum.begin());
    gsl_fft_real_radix2_transform(spectrum.data(), 1, n); // half-complex: real part k at k, imaginary part at n - k

    double weighted = 0.0, total = 0.0;
    for (std::size_t k = 1; k < n / 2; ++k) {
        const double frequency = static_cast<double>(k) / (static_cast<double>(n) * dt);
        if (frequency < lowest) continue;
        if (frequency > highest) break;
        const double squared = spectrum[k] * spectrum[k] + spectrum[n - k] * spectrum[n - k];
        weighted += squared / frequency;
        total += squared;
    }
    if (!(total > 0.0)) return std::nullopt;
    return weighted / total;
}

} // namespace damslip::records
