#include "records/generate/wavelet_match.hpp"

#include "core/file.hpp"
#include "core/input_error.hpp"
#include "core/units.hpp"
#include "records/generate/generate.hpp"
#include "records/measure/measures.hpp"
#include "records/read/header.hpp"
#include "records/read/number_table.hpp"

#include <fmt/format.h>
#include <gsl/gsl_fft_halfcomplex.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>
#include <vector>

namespace damslip::records {

namespace {

/// Corner periods of the EN 1998-1 shape [s] and the height of its plateau over PGA [-].
struct Eurocode8Shape {
    double T_B, T_C, T_D, plateau;

    double operator()(double T) const
    {
        if (T <= T_B) return 1.0 + T / T_B * (plateau - 1.0);
        if (T <= T_C) return plateau;
        if (T <= T_D) return plateau * T_C / T;
        return plateau * T_C * T_D / (T * T);
    }
};

constexpr std::array<Eurocode8Shape, 5> type_1{{{0.15, 0.4, 2.0, 2.5},
                                                {0.15, 0.5, 2.0, 2.5},
                                                {0.20, 0.6, 2.0, 2.5},
                                                {0.20, 0.8, 2.0, 2.5},
                                                {0.15, 0.5, 2.0, 2.5}}};
constexpr std::array<Eurocode8Shape, 5> type_2{{{0.05, 0.25, 1.2, 2.5},
                                                {0.05, 0.25, 1.2, 2.5},
                                                {0.10, 0.25, 1.2, 2.5},
                                                {0.10, 0.30, 1.2, 2.5},
                                                {0.05, 0.25, 1.2, 2.5}}};
constexpr Eurocode8Shape vertical{0.05, 0.15, 1.0, 3.0}; // both types

/// log-log line through (x0, y0) and (x1, y1).
double log_line(double x0, double y0, double x1, double y1, double x)
{
    return y0 * std::exp(std::log(y1 / y0) * std::log(x / x0) / std::log(x1 / x0));
}

struct RockShape {
    static constexpr double acceleration = 2.12, velocity = 1.65, displacement = 1.39; // amplification [-]
    static constexpr double v_per_a = 36.0 * 0.0254 / units::standard_gravity;         // 36 in/s per g [s]
    static constexpr double ad_per_v2 = 6.0;
    static constexpr double T_rigid = 1.0 / 33.0, T_plateau = 1.0 / 8.0; // [s]

    double operator()(double T) const
    {
        if (T <= T_rigid) return 1.0;
        if (T <= T_plateau) return log_line(T_rigid, 1.0, T_plateau, acceleration, T);
        const double w = 2.0 * std::numbers::pi / T;
        return std::min({acceleration, velocity * v_per_a * w, displacement * ad_per_v2 * v_per_a * v_per_a * w * w});
    }
};

struct TableShape {
    std::vector<SpectrumRow> rows; // accelerations over the first

    double operator()(double T) const
    {
        if (T <= rows[0].period) return 1.0;
        const SpectrumRow& last = rows.back();
        if (T >= last.period) return last.acceleration * (last.period / T) * (last.period / T);
        std::size_t k = 1;
        while (rows[k].period < T) ++k;
        const SpectrumRow &a = rows[k - 1], &b = rows[k];
        if (a.period == 0.0) return a.acceleration + (b.acceleration - a.acceleration) * T / b.period;
        return log_line(a.period, a.acceleration, b.period, b.acceleration, T);
    }
};

} // namespace

TargetSpectrum eurocode8_spectrum(Eurocode8Type type, GroundType ground, MotionComponent component)
{
    const char* type_name = type == Eurocode8Type::type_1 ? "type 1" : "type 2";
    if (component == MotionComponent::vertical) return {fmt::format("Eurocode 8 {}, vertical", type_name), vertical};
    const auto index = static_cast<std::size_t>(ground);
    return {fmt::format("Eurocode 8 {}, ground {}, horizontal", type_name, "ABCDE"[index]),
            (type == Eurocode8Type::type_1 ? type_1 : type_2)[index]};
}

TargetSpectrum rock_spectrum()
{
    return {"rock (Newmark & Hall 1982, median)", RockShape{}};
}

TargetSpectrum table_spectrum(std::span<const SpectrumRow> rows, std::string name)
{
    const auto fail = [&](std::string problem, std::string expected, std::string fix) {
        throw InputError(Diagnostic{name, 0, 0, std::move(problem), std::move(expected), std::move(fix)});
    };
    if (rows.size() < 2)
        fail(fmt::format("a target spectrum of {} rows.", rows.size()),
             "at least 2 rows of period [s] and spectral acceleration", "add rows");
    for (std::size_t k = 0; k < rows.size(); ++k) {
        if (!(rows[k].acceleration > 0.0) || !std::isfinite(rows[k].acceleration))
            fail(fmt::format("spectral acceleration {} at {} s.", rows[k].acceleration, rows[k].period), "a number > 0",
                 "correct the row");
        if (!(rows[k].period >= 0.0) || !std::isfinite(rows[k].period) ||
            (k > 0 && rows[k].period <= rows[k - 1].period))
            fail(fmt::format("period {} s in row {}.", rows[k].period, k + 1), "periods >= 0 that rise from row to row",
                 "sort the rows");
    }
    constexpr double latest_first = 0.03, earliest_last = 2.0; // [s]
    if (rows.front().period > latest_first)
        fail(fmt::format("the first period is {} s.", rows.front().period),
             fmt::format("0 to {} s: the first row is the PGA", latest_first),
             "add a row \"0, PGA\", of frequencies \"100, PGA\"");
    if (rows.back().period < earliest_last)
        fail(fmt::format("the last period is {} s.", rows.back().period),
             fmt::format("at least {} s: so far the record is matched", earliest_last), "add rows");
    TableShape shape{{rows.begin(), rows.end()}};
    for (SpectrumRow& row : shape.rows) row.acceleration /= rows.front().acceleration;
    return {std::move(name), std::move(shape)};
}

namespace {

/// What a column of a spectrum holds: one number of it is `factor` s, or `factor` Hz.
struct SpectrumColumn {
    enum { period, frequency, acceleration } kind = period;
    double factor = 1.0;
};

SpectrumColumn spectrum_column(const RecordText& text, std::size_t line, std::string_view heading)
{
    std::string name = lower(trimmed(heading));
    const auto is_acceleration = [](std::string_view unit) {
        return acceleration_unit(unit) || unit == "%g" || unit == "-" || unit == "%";
    };
    const std::string unit = take_unit(name, [&](std::string_view u) {
                                 return is_acceleration(u) || u == "s" || u == "sec" || u == "ms" || u == "hz";
                             }).value_or("");
    std::replace(name.begin(), name.end(), '_', ' ');
    const auto is = [&](std::initializer_list<std::string_view> names) {
        return std::find(names.begin(), names.end(), name) != names.end();
    };
    if (is({"t", "tn", "period", "natural period"}) && (unit.empty() || unit.starts_with('s') || unit == "ms"))
        return {SpectrumColumn::period, unit == "ms" ? 1e-3 : 1.0};
    if (is({"f", "fn", "freq", "frequency", "hz"}) && (unit.empty() || unit == "hz"))
        return {SpectrumColumn::frequency, 1.0};
    if ((is({"a", "sa", "s a", "se", "s e", "psa", "pseudo acceleration", "spectral acceleration", "sa/pga",
             "amplification"}) ||
         name.starts_with("acc")) &&
        (unit.empty() || is_acceleration(unit)))
        return {SpectrumColumn::acceleration, 1.0};
    refuse(text, {line, 0}, fmt::format("the heading {} is none of a target spectrum.", in_quotes(heading)),
           "period_s or frequency_hz, and the spectral acceleration: sa_g, \"Sa [m/s2]\"; no velocity, no displacement",
           "rename the column, or write  period_s,sa_g");
}

/// The two headings above the numbers, and their line; other lines of words there are remarks, but for one that speaks of frequencies.
std::pair<std::vector<std::string>, std::size_t> headings_of(const RecordText& text, const NumberTable& table)
{
    if (!table.headings.empty() || table.skipped_lines.empty()) return {table.headings, table.heading_line};
    const std::size_t line = table.skipped_lines.back();
    const std::string words = lower(text.lines[line - 1]);
    if (contains(words, "hz") || contains(words, "freq"))
        refuse(text, {line, 0},
               fmt::format("{} is no heading of two columns.", in_quotes(trimmed(text.lines[line - 1]))),
               "a heading for each column, with the separator of the numbers", "write  frequency_hz,sa_g");
    return {};
}

} // namespace

TargetSpectrum parse_target_spectrum(std::string_view content, std::string_view file_name)
{
    const RecordText text = split_lines(content, file_name);
    const NumberTable table = read_number_table(text);
    const auto [headings, line] = headings_of(text, table);
    std::size_t of_period = 0;
    SpectrumColumn abscissa;
    if (headings.size() == 2) {
        const SpectrumColumn first = spectrum_column(text, line, headings[0]),
                             second = spectrum_column(text, line, headings[1]);
        if ((first.kind == SpectrumColumn::acceleration) == (second.kind == SpectrumColumn::acceleration))
            refuse(text, {line, 0}, "the headings name no pair of period and spectral acceleration.", "one of each",
                   "write  period_s,sa_g");
        of_period = first.kind == SpectrumColumn::acceleration ? 1 : 0;
        abscissa = of_period ? second : first;
    }
    std::vector<SpectrumRow> rows;
    for (std::size_t row = 0; row < table.rows(); ++row) {
        if (table.width(row) != 2)
            refuse(text, {table.row_line[row], 0},
                   fmt::format("{} numbers in a line of a target spectrum.", table.width(row)),
                   "two: period [s] and spectral acceleration", "correct the line");
        const double at = abscissa.factor * table.values[table.row_begin[row] + of_period];
        rows.push_back({abscissa.kind == SpectrumColumn::frequency ? 1.0 / at : at,
                        table.values[table.row_begin[row] + 1 - of_period]});
    }
    if (abscissa.kind == SpectrumColumn::frequency && rows.front().period > rows.back().period)
        std::reverse(rows.begin(), rows.end());
    return table_spectrum(rows, std::string(file_name));
}

TargetSpectrum read_target_spectrum(const std::filesystem::path& path)
{
    return parse_target_spectrum(read_file(path), path.string());
}

std::optional<TargetSpectrum> find_target_spectrum(std::string_view word, const std::filesystem::path& file,
                                                   GroundType ground, MotionComponent component)
{
    if (word == "rock") return rock_spectrum();
    if (word == "ec8-1") return eurocode8_spectrum(Eurocode8Type::type_1, ground, component);
    if (word == "ec8-2") return eurocode8_spectrum(Eurocode8Type::type_2, ground, component);
    if (!std::filesystem::exists(file)) return std::nullopt;
    return read_target_spectrum(file);
}

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
