#include "records/measure/measures.hpp"

#include "core/units.hpp"

#include <gsl/gsl_fft_real.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <complex>
#include <cstddef>
#include <initializer_list>
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

namespace {

constexpr double rigid_below = 1e-3; // T / dt
constexpr double steps_per_period = 16.0;
constexpr int all_fine = 64;       // steps of an interval that are not worth a plan
constexpr double forgotten = 37.0; // e^-37: below the last digit

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
    /// @param inside  whether extremes inside the step h count
    void next(double y1, double r1, double h, bool inside)
    {
        peak = std::max(peak, std::abs(y1));
        // An extreme below the peak found so far cannot matter: within a step it exceeds the ends by less than h |r|.
        if (inside && r * r1 < 0.0 &&
            std::max(std::abs(y), std::abs(y1)) + h * std::min(std::abs(r), std::abs(r1)) > peak)
            peak = std::max(peak, cubic_peak(y, r, y1, r1, h));
        y = y1;
        r = r1;
    }
};

/// Steps of one kind in the plan of an interval.
struct Stretch {
    int count = 0, size = 1; ///< of steps; of each, in the smallest steps
    bool peaks = true;       ///< false: no extreme lies inside
};

/// How an interval of n smallest steps is divided, `per_period` of them a period. Between samples a response is a straight
/// line and what the oscillator remembers of the start. An oscillation that decays makes the largest value the first
/// or the last of its extremes: their curves, straight line ± decaying exponential, are convex and concave. From the
/// critical damping on, steps grow as the fast part is forgotten; once all is, one step takes the straight line.
std::vector<Stretch> plan_of(int n, double per_period, double ratio)
{
    using std::numbers::pi;
    if (n <= all_fine) return {{n}};
    if (ratio <= 0.5) { // the damped period is 1.155 T at most
        const int ends = static_cast<int>(std::ceil(1.25 * per_period));
        if (2 * ends >= n) return {{n}};
        return {{ends}, {1, n - 2 * ends, false}, {ends}};
    }
    const double decay = 2.0 * pi / per_period * (ratio - std::sqrt(std::max(0.0, ratio * ratio - 1.0))); // a step
    std::vector<Stretch> plan;
    for (int done = 0, size = 1; done < n;) {
        if (done * decay > forgotten) {
            plan.push_back({1, n - done, false});
            break;
        }
        const int count = std::min(static_cast<int>(steps_per_period), (n - done) / size);
        plan.push_back(count > 0 ? Stretch{count, size} : Stretch{1, n - done});
        done += plan.back().count * plan.back().size;
        if (ratio >= 1.0 && 2 * size * decay < 0.2) size *= 2;
    }
    return plan;
}

class Oscillator {
public:
    Oscillator(double period, double ratio, double dt) : w_(2.0 * std::numbers::pi / period), ratio_(ratio)
    {
        const double per_period = std::max(steps_per_period, 3.0 * std::numbers::pi * (1.0 + 2.0 * ratio));
        steps_ = std::max(1, static_cast<int>(std::ceil(dt / period * per_period)));
        const double h = dt / steps_;
        const OscillatorStep smallest(w_, ratio, h);
        for (const Stretch& stretch : plan_of(steps_, per_period, ratio))
            parts_.push_back({stretch, h * stretch.size, smallest.repeated(stretch.size)});
    }

    /// One interval of the record, ground acceleration from a0 to a1.
    void interval(double a0, double a1)
    {
        const double change = (a1 - a0) / steps_;
        if (a0 != accel_end_) jump(a0);
        int done = 0;
        for (const Part& part : parts_)
            for (int j = 0; j < part.stretch.count; ++j) {
                const double before = a0 + done * change;
                done += part.stretch.size;
                const double after = done == steps_ ? a1 : a0 + done * change;
                state_ = part.step.advance(state_, before, after);
                keep(after, part.h, part.stretch.peaks);
            }
        accel_end_ = a1;
    }

    SpectrumPoint peaks(double period) const
    {
        return {period, displacement_.peak, velocity_.peak, w_ * w_ * displacement_.peak, absolute_.peak};
    }

private:
    struct Part {
        Stretch stretch;
        double h;
        OscillatorStep step;
    };

    void keep(double ground, double h, bool peaks)
    {
        const double absolute = -w_ * (w_ * state_.displacement + 2.0 * ratio_ * state_.velocity); // u'' + a_g
        const double relative = absolute - ground;                                                 // u''
        displacement_.next(state_.displacement, state_.velocity, h, peaks);
        velocity_.next(state_.velocity, relative, h, peaks);
        absolute_.next(absolute, -w_ * (w_ * state_.velocity + 2.0 * ratio_ * relative), h, peaks);
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
    int steps_; ///< smallest steps of an interval
    std::vector<Part> parts_;
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

OscillatorStep::OscillatorStep(double circular_frequency, double ratio, double step)
{
    const double w = circular_frequency, h = step;
    assert(w >= 0.0 && ratio >= 0.0 && h > 0.0 && w * h * (1.0 + 2.0 * ratio) <= 2.0);

    // In the variables (w u, u') the matrix is Z = w h [0 1; -1 -2 zeta], of norm <= w h (1 + 2 zeta). The response to
    // the constant part of the load is h phi_1(Z), to the rising part h phi_2(Z) with phi_1 = sum Z^k/(k+1)!, phi_2 =
    // sum Z^k/(k+2)!. In (u/h, u') the same powers have entries free of 1/w: power = [p0 p1; p2 p3] of Z' = [0 1;
    // -(wh)^2 -2 zeta w h].
    const double z2 = -(w * h) * (w * h), z3 = -2.0 * ratio * w * h;
    double p[4] = {1.0, 0.0, 0.0, 1.0};
    double e[4] = {}, phi1[2] = {}, phi2[2] = {}; // phi: second column, the load enters the velocity row
    double factorial = 1.0;                       // k!
    for (int k = 0; k < 28; ++k) {                // 2^28/28! = 9e-22
        const double f1 = factorial * (k + 1), f2 = f1 * (k + 2);
        for (int i = 0; i < 4; ++i) e[i] += p[i] / factorial;
        phi1[0] += p[1] / f1, phi1[1] += p[3] / f1;
        phi2[0] += p[1] / f2, phi2[1] += p[3] / f2;
        const double next[4] = {p[1] * z2, p[0] + p[1] * z3, p[3] * z2, p[2] + p[3] * z3};
        for (int i = 0; i < 4; ++i) p[i] = next[i];
        factorial = f1;
    }
    a_[0] = e[0], a_[1] = e[1] * h, a_[2] = e[2] / h, a_[3] = e[3];
    b_[0] = -h * h * (phi1[0] - phi2[0]), b_[1] = -h * h * phi2[0];
    b_[2] = -h * (phi1[1] - phi2[1]), b_[3] = -h * phi2[1];
}

OscillatorStep OscillatorStep::in_turn(const OscillatorStep& first, int p, const OscillatorStep& second, int q)
{
    const double f = static_cast<double>(p) / (p + q); // acceleration between: (1 - f) a_0 + f a_1
    OscillatorStep both;
    for (const int row : {0, 2}) {
        const double* a = second.a_ + row;
        for (const int column : {0, 1}) {
            both.a_[row + column] = a[0] * first.a_[column] + a[1] * first.a_[2 + column];
            const double through = a[0] * first.b_[1] + a[1] * first.b_[3] + second.b_[row]; // of the one between
            both.b_[row + column] = column == 0 ? a[0] * first.b_[0] + a[1] * first.b_[2] + (1.0 - f) * through
                                                : f * through + second.b_[row + 1];
        }
    }
    return both;
}

OscillatorStep OscillatorStep::repeated(int count) const
{
    assert(count >= 1);
    if (count == 1) return *this;
    const OscillatorStep half = repeated(count / 2), twice = in_turn(half, 1, half, 1);
    return count % 2 == 0 ? twice : in_turn(twice, count - 1, *this, 1);
}

} // namespace damslip::records
