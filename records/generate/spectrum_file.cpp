#include "records/generate/spectrum_file.hpp"

#include "core/file.hpp"
#include "records/read/number_table.hpp"
#include "records/read/unit.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <vector>

namespace damslip::records {

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
