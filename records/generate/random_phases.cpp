#include "records/generate/stages.hpp"

#include "records/generate/random.hpp"
#include "records/measure/response_spectrum.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <gsl/gsl_fft_halfcomplex.h>
#include <numbers>

namespace damslip::records {

namespace {

using std::numbers::pi;
constexpr double damping = 0.05;

struct Line {
    double frequency; ///< [Hz]
    std::size_t index;
    double amplitude; ///< [m/s^2]
    double phase;     ///< [rad]
};

/// Gasparini & Vanmarcke (1976): G(w) w (pi/(4 zeta) - 1) = S_a^2/r^2 - integral of G up to w, with the peak factor r
/// = 3.
std::vector<Line> starting_lines(const TargetSpectrum& target, std::size_t transform, const RandomPhaseOptions& options)
{
    constexpr double lowest = 0.15, highest = 40.0, peak_factor = 3.0;
    const double step = 1.0 / (static_cast<double>(transform) * options.dt);
    const double upper = std::min(highest, 0.8 * 0.5 / options.dt);
    UniformRandom random(options.seed, options.stream);
    std::vector<Line> lines;
    double power_below = 0.0; // integral of G dw
    for (std::size_t k = 1; k < transform / 2; ++k) {
        const double f = static_cast<double>(k) * step, w = 2.0 * pi * f, dw = 2.0 * pi * step;
        if (f < lowest) continue;
        if (f > upper) break;
        const double s_a = options.pga * target.amplification(1.0 / f) / peak_factor;
        const double density = std::max(s_a * s_a - power_below, 0.01 * s_a * s_a) / (w * (pi / (4.0 * damping) - 1.0));
        power_below += density * dw;
        lines.push_back({f, k, std::sqrt(2.0 * density * dw), 2.0 * pi * random.next()});
    }
    return lines;
}

std::vector<double> sum_of_lines(const std::vector<Line>& lines, std::size_t transform,
                                 std::span<const double> envelope)
{
    std::vector<double> data(transform, 0.0);
    for (const Line& line : lines) {
        const double half = 0.5 * static_cast<double>(transform) * line.amplitude;
        data[line.index] = half * std::cos(line.phase);
        data[transform - line.index] = half * std::sin(line.phase);
    }
    gsl_fft_halfcomplex_radix2_inverse(data.data(), 1, transform);
    std::vector<double> accel(envelope.size());
    for (std::size_t k = 0; k < accel.size(); ++k) accel[k] = envelope[k] * data[k];
    return accel;
}

/// Value at x of the polygon through (xs, ys), constant outside.
double interpolated(std::span<const double> xs, std::span<const double> ys, double x)
{
    if (x <= xs.front()) return ys.front();
    if (x >= xs.back()) return ys.back();
    const auto right = static_cast<std::size_t>(std::upper_bound(xs.begin(), xs.end(), x) - xs.begin());
    const double part = (x - xs[right - 1]) / (xs[right] - xs[right - 1]);
    return ys[right - 1] + part * (ys[right] - ys[right - 1]);
}

} // namespace

std::vector<double> random_phase_record(const TargetSpectrum& target, std::span<const double> envelope,
                                        const RandomPhaseOptions& options)
{
    const std::size_t transform = std::bit_ceil(envelope.size());
    std::vector<Line> lines = starting_lines(target, transform, options);
    const std::vector<double> periods = logarithmic_periods(0.03, 5.0, 90);
    std::vector<double> log_periods(periods.size()), ratio(periods.size());
    for (std::size_t k = 0; k < periods.size(); ++k) log_periods[k] = std::log(periods[k]);

    std::vector<double> accel = sum_of_lines(lines, transform, envelope);
    for (int iteration = 0; iteration < options.iterations; ++iteration) {
        const auto points = response_spectrum(accel, options.dt, periods, damping).points;
        for (std::size_t k = 0; k < periods.size(); ++k)
            ratio[k] = options.pga * target.amplification(periods[k]) / points[k].pseudo_acceleration;
        for (Line& line : lines) line.amplitude *= interpolated(log_periods, ratio, -std::log(line.frequency));
        accel = sum_of_lines(lines, transform, envelope);
    }
    return accel;
}

} // namespace damslip::records
