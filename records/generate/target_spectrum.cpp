#include "records/generate/target_spectrum.hpp"

#include "core/file.hpp"
#include "core/input_error.hpp"
#include "core/units.hpp"
#include "records/read/header.hpp"
#include "records/read/number_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
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

} // namespace damslip::records
