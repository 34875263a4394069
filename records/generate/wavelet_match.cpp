#include "records/generate/wavelet_match.hpp"

#include "records/generate/generate.hpp"
#include "records/measure/response_spectrum.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <gsl/gsl_fft_halfcomplex.h>
#include <numbers>

namespace damslip::records {

namespace {

using std::numbers::pi;
constexpr double spectrum_damping = 0.05;
constexpr std::size_t parts =
    4; ///< steps of the oscillator per sample; at T = 0.04 s and dt = 0.01 s sixteen per period

/// -w^2 u of one oscillator, or the ground acceleration itself (period 0), at one of its extremes.
struct Extreme {
    std::size_t at = 0; ///< fine step, dt/parts
    double value = 0.0; ///< [m/s^2]
};

/// The extremes of one oscillator that matter: the largest, and those that would pass the target first when it is
/// changed.
struct Response {
    double period = 0.0, wanted = 0.0;
    std::vector<Extreme> extremes; ///< by falling |value|
};

constexpr double near_target = 0.6;       ///< smaller extremes are not looked at
constexpr std::size_t most_extremes = 12; ///< per oscillator

void keep_largest(Response& response)
{
    std::sort(response.extremes.begin(), response.extremes.end(),
              [](const Extreme& a, const Extreme& b) { return std::abs(a.value) > std::abs(b.value); });
    while (response.extremes.size() > most_extremes ||
           (response.extremes.size() > 1 && std::abs(response.extremes.back().value) < near_target * response.wanted))
        response.extremes.pop_back();
}

Response oscillator_response(std::span<const double> accel, double dt, double period, double wanted)
{
    const double w = 2.0 * pi / period;
    const OscillatorStep step(w, spectrum_damping, dt / parts);
    OscillatorState s;
    Response response{period, wanted, {}};
    double before = 0.0, value = 0.0;
    for (std::size_t k = 0; k + 1 < accel.size(); ++k) {
        const double change = (accel[k + 1] - accel[k]) / parts;
        for (std::size_t j = 0; j < parts; ++j) {
            s = step.advance(s, accel[k] + static_cast<double>(j) * change,
                             accel[k] + static_cast<double>(j + 1) * change);
            const double next = -w * w * s.displacement;
            if ((value - before) * (next - value) <= 0.0 && std::abs(value) > 0.3 * wanted)
                response.extremes.push_back({k * parts + j, value});
            before = value;
            value = next;
        }
    }
    if (response.extremes.empty()) response.extremes.push_back({accel.size() / 2 * parts, 1e-6 * wanted});
    keep_largest(response);
    return response;
}

Response ground_response(std::span<const double> accel, double pga)
{
    Response response{0.0, pga, {}};
    for (std::size_t k = 0; k < accel.size(); ++k)
        if (std::abs(accel[k]) > near_target * pga) response.extremes.push_back({k * parts, accel[k]});
    if (response.extremes.empty()) response.extremes.push_back({accel.size() / 2 * parts, 1e-6 * pga});
    keep_largest(response);
    return response;
}

/// A function of time that is zero outside `values`, which start at sample `begin` >= 1.
struct Wavelet {
    std::size_t begin = 1;
    std::vector<double> values;
};

/// Al Atik & Abrahamson (2010): cos(w_d (t - t_c)) exp(-((t - t_c)/gamma)^2), gamma = 1.178 f^-0.93 s, brought to zero
/// at both ends of the record. t_c is early by the time the oscillator needs to answer; for the ground acceleration
/// (period 0) f = 25 Hz, no delay.
Wavelet wavelet(double period, const Extreme& extreme, std::size_t n, double dt)
{
    constexpr double end_taper = 0.5, ground_frequency = 25.0; // [s], [Hz]
    const double root = std::sqrt(1.0 - spectrum_damping * spectrum_damping);
    const double w_d = period > 0.0 ? 2.0 * pi / period * root : 2.0 * pi * ground_frequency;
    const double delay = period > 0.0 ? std::atan(root / spectrum_damping) / w_d : 0.0;
    const double center = static_cast<double>(extreme.at) * dt / parts - delay;
    const double gamma = 1.178 * std::pow(w_d / (2.0 * pi), -0.93), last = static_cast<double>(n - 1) * dt;
    const double from = std::max(1.0, std::ceil((center - 4.0 * gamma) / dt)); // exp(-16) = 1e-7
    const double to = std::min(static_cast<double>(n - 2), std::floor((center + 4.0 * gamma) / dt));
    Wavelet f{static_cast<std::size_t>(from), {}};
    for (double k = from; k <= to; k += 1.0) {
        const double t = k * dt, x = t - center;
        const double taper = std::min({1.0, t / end_taper, (last - t) / end_taper});
        f.values.push_back(taper * std::cos(w_d * x) * std::exp(-(x / gamma) * (x / gamma)));
    }
    return f;
}

/// How one response answers samples: -w^2 u at every fine step after the start of a hat of height 1 and half width dt.
class HatResponse {
public:
    HatResponse(double period, double dt, std::size_t samples) : rigid_(period == 0.0)
    {
        if (rigid_) return;
        const double w = 2.0 * pi / period;
        const OscillatorStep step(w, spectrum_damping, dt / parts);
        const auto hat = [](std::size_t j) {
            return std::max(0.0, 1.0 - std::abs(static_cast<double>(j) / parts - 1.0));
        };
        for (auto& phase : phases_) phase.reserve(samples);
        OscillatorState s;
        for (std::size_t j = 0; j < parts * samples; ++j) {
            phases_[j % parts].push_back(-w * w * s.displacement);
            s = step.advance(s, hat(j), hat(j + 1));
        }
    }

    /// Value at fine step `at` of the response to a wavelet.
    double to(const Wavelet& f, std::size_t at) const
    {
        if (rigid_) {
            const std::size_t k = at / parts;
            return k >= f.begin && k - f.begin < f.values.size() ? f.values[k - f.begin] : 0.0;
        }
        const std::vector<double>& h = phases_[at % parts];
        const std::size_t last = at / parts + 1; // the hat of sample k starts one sample before it: lag last - k
        double sum = 0.0;
        for (std::size_t k = 0; k < f.values.size() && f.begin + k <= last && last - f.begin - k < h.size(); ++k)
            sum += h[last - f.begin - k] * f.values[k];
        return sum;
    }

private:
    bool rigid_;
    std::vector<double> phases_[parts]; ///< fine step m parts + p is phases_[p][m]
};

/// One extreme as a row of the system, everything over the target value, so that a percent counts alike at 2 s and at
/// 0.1 s.
struct Row {
    bool leads = false; ///< the largest extreme of its oscillator: it goes to the target. The others count once they
                        ///< would pass it
    double value = 0.0; ///< |extreme| / target
    std::vector<double> answers; ///< change of `value` per wavelet
};

std::vector<Row> rows_of(const Response& response, const std::vector<Wavelet>& wavelets, double dt, std::size_t samples)
{
    const HatResponse hat(response.period, dt, samples);
    std::vector<Row> rows;
    for (const Extreme& extreme : response.extremes) {
        Row row{rows.empty(), std::abs(extreme.value) / response.wanted, std::vector<double>(wavelets.size())};
        const double factor = std::copysign(1.0 / response.wanted, extreme.value);
        for (std::size_t j = 0; j < wavelets.size(); ++j) row.answers[j] = factor * hat.to(wavelets[j], extreme.at);
        rows.push_back(std::move(row));
    }
    return rows;
}

double predicted(const Row& row, const std::vector<double>& amplitudes)
{
    double value = row.value;
    for (std::size_t j = 0; j < amplitudes.size(); ++j) value += row.answers[j] * amplitudes[j];
    return value;
}

/// Amplitudes that bring the leading rows to 1; a row that would pass 1 by that joins the system, and it is solved
/// again.
std::vector<double> solve_with_limits(const std::vector<Row>& rows, double regularisation)
{
    constexpr int rounds = 6;
    std::vector<bool> active(rows.size(), false);
    RegularisedLeastSquares system(rows.front().answers.size());
    std::vector<double> amplitudes(rows.front().answers.size(), 0.0);
    for (int round = 0; round < rounds; ++round) {
        bool settled = true;
        for (std::size_t i = 0; i < rows.size(); ++i) {
            if (active[i] || !(rows[i].leads || predicted(rows[i], amplitudes) > 1.0)) continue;
            system.add(rows[i].answers, 1.0 - rows[i].value);
            active[i] = true;
            settled = false;
        }
        if (settled) break;
        amplitudes = system.solve(regularisation);
    }
    return amplitudes;
}

} // namespace

void match_by_wavelets(std::vector<double>& accel, double dt, const TargetSpectrum& target, double pga,
                       std::span<const double> periods, double regularisation)
{
    // 1. extremes of all oscillators; the largest of each sign carries a wavelet
    std::vector<Response> responses{ground_response(accel, pga)};
    for (const double period : periods)
        responses.push_back(oscillator_response(accel, dt, period, pga * target.amplification(period)));
    std::vector<Wavelet> wavelets;
    for (const Response& r : responses) {
        wavelets.push_back(wavelet(r.period, r.extremes.front(), accel.size(), dt));
        const auto other = std::find_if(r.extremes.begin(), r.extremes.end(),
                                        [&](const Extreme& e) { return e.value * r.extremes.front().value < 0.0; });
        if (other != r.extremes.end()) wavelets.push_back(wavelet(r.period, *other, accel.size(), dt));
    }

    // 2. how every extreme answers every wavelet, and the amplitudes wanted
    std::vector<Row> rows;
    for (const Response& r : responses)
        for (Row& row : rows_of(r, wavelets, dt, accel.size())) rows.push_back(std::move(row));
    const std::vector<double> amplitudes = solve_with_limits(rows, regularisation);

    // 3. the wavelets, added
    for (std::size_t j = 0; j < wavelets.size(); ++j)
        for (std::size_t k = 0; k < wavelets[j].values.size(); ++k)
            accel[wavelets[j].begin + k] += amplitudes[j] * wavelets[j].values[k];
}

namespace {

/// x := A^-1 x for a positive definite A, lower triangle by rows, overwritten by its factor. Written out, since a BLAS library may sum
/// in another order on another processor: the same seed must give the same record.
void cholesky_solve(std::vector<double>& a, std::vector<double>& x)
{
    const std::size_t n = x.size();
    const auto row = [&](std::size_t i) { return a.data() + i * n; };
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j <= i; ++j) {
            double sum = row(i)[j];
            for (std::size_t k = 0; k < j; ++k) sum -= row(i)[k] * row(j)[k];
            row(i)[j] = i == j ? std::sqrt(sum) : sum / row(j)[j];
        }
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t k = 0; k < i; ++k) x[i] -= row(i)[k] * x[k];
        x[i] /= row(i)[i];
    }
    for (std::size_t i = n; i-- > 0;) {
        for (std::size_t k = i + 1; k < n; ++k) x[i] -= row(k)[i] * x[k];
        x[i] /= row(i)[i];
    }
}

} // namespace

void RegularisedLeastSquares::add(std::span<const double> coefficients, double value)
{
    for (std::size_t i = 0; i < unknowns_; ++i) {
        if (coefficients[i] == 0.0) continue;
        double* row = normal_.data() + i * unknowns_;
        for (std::size_t j = 0; j <= i; ++j) row[j] += coefficients[i] * coefficients[j];
        right_[i] += coefficients[i] * value;
    }
}

std::vector<double> RegularisedLeastSquares::solve(double regularisation) const
{
    std::vector<double> matrix = normal_, x = right_;
    double trace = 0.0;
    for (std::size_t i = 0; i < unknowns_; ++i) trace += matrix[i * unknowns_ + i];
    const double lambda = regularisation * trace / static_cast<double>(unknowns_);
    for (std::size_t i = 0; i < unknowns_; ++i) matrix[i * unknowns_ + i] += lambda; // positive definite
    cholesky_solve(matrix, x);
    return x;
}

namespace {

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
