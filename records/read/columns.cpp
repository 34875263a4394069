#include "records/read/read_record.hpp"

#include "core/text.hpp"
#include "records/read/agency_samples.hpp"
#include "records/read/header.hpp"
#include "records/read/number_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <functional>

namespace damslip::records {

namespace {

/// `component`: a name of a component without a quantity ("NS", "U-D"), taken as an acceleration.
enum class ColumnKind { time, acceleration, component, motion, other };

/// What a heading such as "time_s", "acc [cm/s2]", "a_h (g)", "NS" says.
struct ColumnHeading {
    ColumnKind kind = ColumnKind::other; ///< `motion`: velocity, displacement, slip
    std::string name;                    ///< without the unit
    std::optional<std::string> unit;     ///< as written; time: "s" or "ms"
};

/// What has to be a unit, known or not: "mm/s", "m/s²", "%".
bool looks_like_unit(std::string_view text)
{
    return contains(text, "/s") || contains(text, "%") || contains(text, "\xc2\xb2");
}

/// Splits "name [unit]", "name (unit)", "name_unit" and "name unit".
ColumnHeading split(std::string_view heading)
{
    ColumnHeading out;
    const std::size_t open = heading.find_first_of("[(");
    if (open != std::string_view::npos && heading.size() > open + 1 &&
        (heading.back() == ']' || heading.back() == ')')) {
        out.name = trimmed(heading.substr(0, open));
        out.unit = std::string(trimmed(heading.substr(open + 1, heading.size() - open - 2)));
        if (out.unit == "+" || out.unit == "-") out.unit.reset(); // "U(+)" is positive up
        return out;
    }
    static constexpr std::array<std::string_view, 9> suffixes{"_mm_s2", "_cm_s2", "_m_s2", "_gal", "_mg",
                                                              "_ms",    "_g",     "_s",    "_sec"};
    const std::string low = lower(heading);
    for (const std::string_view suffix : suffixes)
        if (low.size() > suffix.size() && low.ends_with(suffix)) {
            out.name = heading.substr(0, heading.size() - suffix.size());
            out.unit = std::string(suffix.substr(1));
            return out;
        }
    const std::size_t blank = heading.find_last_of(" \t");
    if (blank != std::string_view::npos && acceleration_unit(heading.substr(blank + 1))) {
        out.name = trimmed(heading.substr(0, blank));
        out.unit = std::string(heading.substr(blank + 1));
        return out;
    }
    out.name = heading;
    out.unit = take_unit(out.name, [](std::string_view text) { return acceleration_unit(text).has_value(); });
    const std::size_t last = out.name.find_last_of('_');
    if (!out.unit && last != std::string::npos && looks_like_unit(std::string_view(out.name).substr(last + 1))) {
        out.unit = out.name.substr(last + 1);
        out.name.resize(last);
    }
    return out;
}

ColumnHeading read_heading(std::string_view heading)
{
    ColumnHeading out = split(trimmed(heading));
    const std::string name = lower(out.name);
    const std::string unit = out.unit ? lower(*out.unit) : "";
    const bool time_unit = unit.empty() || unit == "s" || unit == "sec" || unit == "ms";
    const bool time_name = name == "t" || name.starts_with("time") || name.starts_with("zeit") ||
                           name.starts_with("tiempo") || name.starts_with("temp");
    if (time_name && time_unit) {
        out.kind = ColumnKind::time;
        return out;
    }
    const bool motion = name.starts_with("vel") || name.starts_with("dis") || name.starts_with("slip");
    const bool named = name == "a" || name.starts_with("a_") || name.starts_with("acc") || contains(name, "accel");
    const bool by_unit = out.unit && acceleration_unit(*out.unit);
    if (motion)
        out.kind = ColumnKind::motion;
    else if (named || by_unit)
        out.kind = ColumnKind::acceleration;
    else if (component_in(out.name) != Component::none)
        out.kind = ColumnKind::component;
    return out;
}

constexpr std::string_view say_dt =
    "give it as motion.record.dt_s in the scene, --dt on the command line, or a line \"# dt: 0.01 s\" in the file";

struct File {
    const RecordText& text;
    const ReadOptions& options;
    TextHeader header;
    NumberTable table;
    std::optional<double> stated_dt;
    std::size_t width;    ///< numbers in every row; 0: rows differ
    bool last_is_shorter; ///< rows differ, but for the last they have as many numbers as the first
    std::vector<std::string> remarks;
};

RecordSource source_of(const File& f, std::string format, const AccelerationUnit& unit, std::string component)
{
    RecordSource s;
    s.format = std::move(format);
    s.unit = unit.name;
    s.component = component.empty() ? f.header.component : std::move(component);
    s.title = f.header.title;
    s.first_line = f.table.row_line.front();
    s.last_line = f.table.row_line.back();
    return s;
}

Record finish(const File& f, std::vector<double> accel, double dt, RecordSource source)
{
    Record record = finished_record(f.text, std::move(accel), dt, std::move(source));
    if (!f.header.name.empty()) record.name = printable(f.header.name);
    for (const std::size_t line : f.table.skipped_lines)
        if (std::find(f.header.understood.begin(), f.header.understood.end(), line) == f.header.understood.end())
            record.warnings.push_back(
                fmt::format("line {} skipped: {}", line, in_quotes(trimmed(f.text.lines[line - 1]))));
    record.warnings.insert(record.warnings.end(), f.remarks.begin(), f.remarks.end());
    if (!f.table.open_end.empty()) record.warnings.push_back(f.table.open_end);
    if (f.header.peak)
        check_stated_peak(f.text, record,
                          {f.header.peak->value, 1e-4 * std::abs(f.header.peak->value), f.header.peak->line});
    return record;
}

std::vector<double> column_values(const NumberTable& table, std::size_t column)
{
    std::vector<double> values(table.rows());
    for (std::size_t row = 0; row < values.size(); ++row) values[row] = table.values[table.row_begin[row] + column];
    return values;
}

std::vector<double> samples_of_column(const File& f, std::size_t column, const AccelerationUnit& unit)
{
    std::vector<double> accel = column_values(f.table, column);
    for (std::size_t row = 0; row < accel.size(); ++row) {
        const double value = accel[row] * unit.factor;
        accel[row] = std::abs(value) <= largest_sample
                         ? value
                         : checked_sample(f.text, accel[row], unit, f.table.place(row, column, f.text));
    }
    if (f.header.samples) check_count(f.text, *f.header.samples, accel.size(), "n");
    return accel;
}

std::size_t printed_digits(const File& f, std::size_t row, std::size_t column)
{
    const auto fields = fields_of(f.text.lines[f.table.row_line[row] - 1], f.table.dialect);
    return column < fields.size() ? significant_digits(fields[column]) : 0;
}

/// One acceleration column, with the time column if there is one.
Record record_of_column(const File& f, std::optional<std::size_t> time_column, double time_factor, std::size_t column,
                        const AccelerationUnit& unit, RecordSource source)
{
    std::vector<double> accel = samples_of_column(f, column, unit);
    if (!time_column) return finish(f, std::move(accel), *f.stated_dt, std::move(source));
    std::vector<double> time = column_values(f.table, *time_column);
    for (double& t : time) t *= time_factor;
    TimeColumn times{time, 0, [&](std::size_t k) { return f.table.place(k, *time_column, f.text); }};
    for (std::size_t row = 0; row < f.table.rows(); ++row)
        times.digits = std::max(times.digits, printed_digits(f, row, *time_column));
    double dt = 0.0;
    std::vector<std::string> resampled;
    const auto stated = f.options.survey ? std::nullopt : f.stated_dt; // a survey's step stands for none
    accel = at_even_times(f.text, times, std::move(accel), stated, f.options, dt, resampled);
    Record record = finish(f, std::move(accel), dt, std::move(source));
    record.warnings.insert(record.warnings.end(), resampled.begin(), resampled.end());
    if (std::abs(time.front()) > 0.5 * dt && std::abs(time.front() - dt) > 0.5 * dt)
        record.warnings.push_back(
            fmt::format("the times start at {} s; the first sample is taken as time 0", time.front()));
    return record;
}

/// The first column is a time: it rises, or stands where it is rounded.
bool is_time(const File& f)
{
    const std::vector<double> first = column_values(f.table, 0);
    if (is_rising(first)) return true;
    const bool falls = std::adjacent_find(first.begin(), first.end(), std::greater<>{}) != first.end();
    return !falls && first.size() >= 20 && first[first.size() / 4] < first[first.size() / 2] &&
           first[first.size() / 2] < first.back();
}

std::string list_of(const std::vector<std::string>& headings)
{
    std::string list;
    for (std::size_t k = 0; k < headings.size(); ++k)
        list += fmt::format("{}{} {}", k ? ", " : "", k + 1, in_quotes(headings[k]));
    return list;
}

/// Index of the column that options.column names, by heading, name without unit, or number.
std::size_t chosen_column(const File& f)
{
    const std::string_view wanted = trimmed(f.options.column);
    const auto& headings = f.table.headings;
    for (std::size_t k = 0; k < headings.size(); ++k)
        if (wanted == headings[k] || wanted == read_heading(headings[k]).name) return k;
    const auto number = parse_whole_number_text(wanted);
    const double count = static_cast<double>(f.width);
    if (number && *number >= 1.0 && *number <= count && *number == std::floor(*number))
        return static_cast<std::size_t>(*number) - 1;
    refuse(f.text, {f.table.heading_line, 0}, fmt::format("there is no column {}.", in_quotes(wanted)),
           headings.empty() ? fmt::format("1 to {}", f.width) : list_of(headings),
           "correct --column (in a scene: motion.record.column, vertical_column)");
}

/// Unit of a column: its heading's, else the file's or the user's.
AccelerationUnit unit_of(const File& f, const ColumnHeading& heading)
{
    std::optional<Stated<std::string>> stated = f.header.unit;
    if (heading.unit) {
        const Stated<std::string> in_heading{*heading.unit, f.table.heading_line};
        const AccelerationUnit unit = settle_unit(f.text, in_heading, f.options);
        if (stated && settle_unit(f.text, stated, f.options).factor != unit.factor)
            refuse(f.text, {stated->line, 0},
                   fmt::format("unit {} here, but {} in the heading of line {}.", in_quotes(stated->value),
                               in_quotes(*heading.unit), f.table.heading_line),
                   "one unit", "correct one of them");
        return unit;
    }
    // "UD NS EW (gal)": the one unit of the headings is that of all.
    for (const std::string& name : f.table.headings)
        if (const auto unit = read_heading(name).unit; unit && !stated && acceleration_unit(*unit))
            stated = Stated<std::string>{*unit, f.table.heading_line};
    return settle_unit(f.text, stated, f.options);
}

std::vector<Record> read_headed(const File& f)
{
    const auto& names = f.table.headings;
    std::optional<std::size_t> time;
    std::vector<std::size_t> accelerations, others;
    for (std::size_t k = 0; k < names.size(); ++k) {
        const ColumnKind kind = read_heading(names[k]).kind;
        if (kind == ColumnKind::time && !time)
            time = k;
        else
            (kind == ColumnKind::acceleration || kind == ColumnKind::component ? accelerations : others).push_back(k);
    }
    if (!f.options.column.empty()) accelerations = {chosen_column(f)};
    // A lone unnamed column beside the time can be nothing else; its unit must still be stated.
    if (accelerations.empty() && others.size() == 1 && read_heading(names[others[0]]).kind == ColumnKind::other)
        accelerations = others;
    if (accelerations.empty() || (time && accelerations[0] == *time))
        refuse(f.text, {f.table.heading_line, 0}, fmt::format("no column of acceleration among {}.", list_of(names)),
               "a heading such as accel_m_s2, accel_g or \"acc [cm/s2]\"",
               "rename the heading, or choose by --column (in a scene: motion.record.column, vertical_column)");
    if (!time && !f.stated_dt)
        refuse(f.text, {f.table.heading_line, 0},
               fmt::format("no time column among {}, and no time step is stated.", list_of(names)),
               "a heading such as time_s, or a time step", std::string(say_dt));
    const double time_factor = time && read_heading(names[*time]).unit.value_or("s") == "ms" ? 1e-3 : 1.0;
    std::vector<Record> records;
    for (const std::size_t k : accelerations) {
        const ColumnHeading heading = read_heading(names[k]);
        const AccelerationUnit unit = unit_of(f, heading);
        std::string component = accelerations.size() > 1 || !f.options.column.empty() ? std::string(names[k]) : "";
        records.push_back(
            record_of_column(f, time, time_factor, k, unit, source_of(f, "CSV", unit, std::move(component))));
    }
    return records;
}

/// All numbers in reading order.
Record read_stream(const File& f)
{
    const AccelerationUnit unit = settle_unit(f.text, f.header.unit, f.options);
    std::vector<double> accel(f.table.values.size());
    for (std::size_t row = 0; row < f.table.rows(); ++row)
        for (std::size_t k = f.table.row_begin[row]; k < f.table.row_begin[row + 1]; ++k) {
            const double value = f.table.values[k] * unit.factor;
            accel[k] = std::abs(value) <= largest_sample
                           ? value
                           : checked_sample(f.text, f.table.values[k], unit,
                                            f.table.place(row, k - f.table.row_begin[row], f.text));
        }
    if (f.header.samples) check_count(f.text, *f.header.samples, accel.size(), "n");
    return finish(f, std::move(accel), *f.stated_dt, source_of(f, "one column", unit, ""));
}

/// Column `column` of a file without headings, its time the first column where that rises.
Record read_column(const File& f, bool first_is_time, std::size_t column, bool alone)
{
    const AccelerationUnit unit = settle_unit(f.text, f.header.unit, f.options);
    const std::string name = alone ? "" : fmt::format("{}", column + 1);
    return record_of_column(f, first_is_time ? std::optional<std::size_t>(0) : std::nullopt, 1.0, column, unit,
                            source_of(f, alone ? "two columns" : "columns", unit, name));
}

constexpr std::string_view say_columns =
    "choose by --column (motion.record.column), or name them in a heading line (time_s, accel_g)";

/// Rows that have other numbers of values than the first ones: a header of numbers, or a file that was changed.
[[noreturn]] void refuse_ragged(const File& f)
{
    std::size_t row = 1;
    while (f.table.width(row) == f.table.width(0)) ++row;
    refuse(f.text, {f.table.row_line[row], 0},
           fmt::format("lines of different numbers of values: {} in line {}, {} here.", f.table.width(0),
                       f.table.row_line.front(), f.table.width(row)),
           "as many numbers in every line but the last",
           "put # before header lines; if every number is a sample, state how many there are: \"# n: 400\"");
}

/// Whole numbers above numbers with decimals: a header, not samples. Zeros may be written either way.
void refuse_whole_numbers_above(const File& f)
{
    constexpr std::size_t least_of_record = 10;
    const auto is_whole = [&](std::size_t row) { // 0: zeros, 1: whole numbers, 2: with decimals
        int kind = 0;
        for (const std::string_view field : fields_of(f.text.lines[f.table.row_line[row] - 1], f.table.dialect)) {
            if (field.find_first_of(".,eEdD") != std::string_view::npos) return 2;
            if (field.find_first_of("123456789") != std::string_view::npos) kind = 1;
        }
        return kind;
    };
    if (is_whole(0) != 1) return;
    std::size_t row = 1;
    while (row < f.table.rows() && is_whole(row) == 1) ++row;
    const std::size_t first = row;
    for (; row < f.table.rows(); ++row)
        if (is_whole(row) == 1) return; // this file writes whole numbers elsewhere, too
    if (f.table.rows() - first < least_of_record) return;
    refuse(f.text, {f.table.row_line.front(), 0},
           fmt::format("whole numbers stand above the numbers with decimals that begin in line {}.",
                       f.table.row_line[first]),
           "samples, or time and acceleration, from the first line of numbers on",
           "put # before the lines of the header; if they are samples, write them with a decimal point");
}

/// Do neighbours in a column differ much less than neighbours in reading order? Then these are components side by side.
bool looks_side_by_side(const File& f)
{
    constexpr std::size_t least_rows = 20;
    constexpr double much_less = 0.6;
    const std::vector<double>& v = f.table.values;
    if (f.width < 2 || f.table.rows() < least_rows) return false;
    double along = 0.0, down = 0.0;
    for (std::size_t k = f.width; k < v.size(); ++k)
        along += std::abs(v[k] - v[k - 1]), down += std::abs(v[k] - v[k - f.width]);
    return down < much_less * along;
}

std::vector<Record> read_unheaded(const File& f)
{
    const std::size_t total = f.table.values.size(), rows = f.table.rows(), line = f.table.row_line.front();
    const bool counted = f.header.samples && f.header.samples->value == total;
    if (f.width == 0 && !f.last_is_shorter && !counted) refuse_ragged(f);
    if (!counted) refuse_whole_numbers_above(f);
    const bool first_is_time = f.width >= 2 && is_time(f);
    if (!f.options.column.empty()) {
        const std::size_t column = chosen_column(f);
        if (first_is_time && column == 0)
            refuse(f.text, {line, 0}, "column 1 rises like a time.", fmt::format("2 to {}", f.width),
                   "correct --column");
        if (first_is_time || f.stated_dt) return {read_column(f, first_is_time, column, false)};
    }
    if (f.width == 2 && (first_is_time || !f.stated_dt)) return {read_column(f, true, 1, true)};
    if (first_is_time)
        refuse(f.text, {line, 0},
               fmt::format("{} numbers a line without headings, and the first rises like a time.", f.width),
               fmt::format("a choice: the columns 2 to {}", f.width), std::string(say_columns));
    const bool columns_counted = f.width > 1 && !counted && f.header.samples && f.header.samples->value == rows;
    const std::string one_record = fmt::format("\"# n: {}\" if they are one record in reading order", total);
    if (!f.stated_dt && f.width == 1)
        refuse(f.text, {line, 0}, "one number a line and no time step.", "a time step", std::string(say_dt));
    if (!f.stated_dt)
        refuse(f.text, {line, 0},
               fmt::format("{} numbers a line, without headings and without a time step.", f.table.width(0)),
               "a time step, and a choice of a column; or " + one_record, std::string(say_columns));
    if (columns_counted) {
        std::vector<Record> records;
        for (std::size_t k = 0; k < f.width; ++k) records.push_back(read_column(f, false, k, false));
        return records;
    }
    if (!counted && looks_side_by_side(f))
        refuse(f.text, {line, 0},
               fmt::format("{} numbers a line look like {} components side by side.", f.width, f.width),
               fmt::format("a choice: the columns 1 to {}; or {}", f.width, one_record), std::string(say_columns));
    return {read_stream(f)};
}

/// A line above the numbers is a heading only if it names what a record file holds: the time; or nothing but known names; or, where
/// no blanks separate it, any of them. Else it is a remark.
bool names_a_quantity(const std::vector<std::string>& headings, bool separated)
{
    const auto kind = [](const std::string& heading) { return read_heading(heading).kind; };
    const auto known = [&](const std::string& heading) { return kind(heading) != ColumnKind::other; };
    if (separated) return std::any_of(headings.begin(), headings.end(), known);
    // "Acceleration time series in m/s/s" is a sentence.
    static constexpr std::array<std::string_view, 12> of_sentences{
        "series", "history", "histories", "of", "in", "the", "for", "from", "record", "data", "and", "at"};
    const bool sentence = std::any_of(headings.begin(), headings.end(), [](const std::string& heading) {
        return std::find(of_sentences.begin(), of_sentences.end(), lower(heading)) != of_sentences.end();
    });
    if (sentence) return false;
    return std::all_of(headings.begin(), headings.end(), known) ||
           std::any_of(headings.begin(), headings.end(),
                       [&](const std::string& heading) { return kind(heading) == ColumnKind::time; });
}

/// The headings that a comment holds: the list of the header ("DataSequence: Time U N E"), or the last comment above the numbers, if it names
/// all columns and one of them is the time or all are components.
void read_commented_headings(const RecordText& text, const TextHeader& header, NumberTable& table)
{
    const std::size_t width = table.width(table.rows() > 2 ? 1 : 0);
    if (width < 2) return;
    if (header.columns) {
        std::string list = header.columns->value;
        std::replace_if(
            list.begin(), list.end(), [](char c) { return c == ';' || c == ','; }, ' ');
        const auto names = fields_of(list, {});
        if (names.size() == width) {
            table.headings.assign(names.begin(), names.end());
            table.heading_line = header.columns->line;
            return;
        }
    }
    std::size_t line = table.row_line.front() - 1;
    while (line > 0 && (trimmed(text.lines[line - 1]).empty() ||
                        std::find(header.understood.begin(), header.understood.end(), line) != header.understood.end()))
        --line;
    if (line == 0 || !is_comment(text.lines[line - 1])) return;
    bool separated = false;
    auto names = heading_fields(trimmed(text.lines[line - 1]).substr(1), table.dialect.separator, width, separated);
    if (names.empty() || !names_a_quantity(names, false)) return;
    table.headings = std::move(names);
    table.heading_line = line;
}

/// A line, or two, with the number of samples and perhaps the step above as many samples (SHAKE, DEEPSOIL, RSPMatch, spectrum matching:
/// "400 0.0100"): taken for what it is.
void take_count_and_step(const RecordText& text, TextHeader& header, NumberTable& table,
                         std::vector<std::string>& remarks)
{
    const auto value = [&](std::size_t row, std::size_t k) {
        return row < table.rows() && k < table.width(row) ? table.values[table.row_begin[row] + k] : -1.0;
    };
    const auto is_step = [](double v) { return v >= 1e-6 && v <= 1.0; };
    constexpr double least = 10.0; // samples: fewer may be samples themselves
    // In one line, in either order, or in two lines of one number.
    struct Guess {
        double count, dt;
        std::size_t rows;
    };
    const bool two_lines = table.width(0) == 1 && table.rows() > 1 && table.width(1) == 1;
    for (const Guess& guess :
         {Guess{value(0, 0), value(0, 1), 1}, Guess{value(0, 1), value(0, 0), 1},
          Guess{value(0, 0), two_lines ? value(1, 0) : -1.0, two_lines ? 2u : 1u}, Guess{value(0, 0), -1.0, 1}}) {
        if (guess.rows >= table.rows() || guess.count < least || guess.count != std::floor(guess.count)) continue;
        const bool has_step = is_step(guess.dt);
        if (!has_step && (guess.rows > 1 || table.width(0) > 1)) continue;
        const std::size_t below = table.rows() - guess.rows, values = table.values.size() - table.row_begin[guess.rows];
        if (guess.count != static_cast<double>(below) && guess.count != static_cast<double>(values)) continue;
        const std::size_t line = table.row_line.front();
        if (header.samples && header.samples->value != static_cast<std::size_t>(guess.count))
            refuse(text, {line, 0},
                   fmt::format("{} samples here, but {} in line {}.", guess.count, header.samples->value,
                               header.samples->line),
                   "one number of samples", "correct one of them");
        header.samples = Stated<std::size_t>{static_cast<std::size_t>(guess.count), line};
        if (has_step && header.dt && std::abs(header.dt->value - guess.dt) > 1e-6 * guess.dt)
            refuse(text, {line, 0},
                   fmt::format("dt = {} s here, but {} s in line {}.", guess.dt, header.dt->value, header.dt->line),
                   "one time step", "correct one of them");
        if (has_step) header.dt = Stated<double>{guess.dt, line};
        remarks.push_back(fmt::format("line {} is the number of samples{}: {}{}", line,
                                      has_step ? " and the time step" : "", guess.count,
                                      has_step ? fmt::format(", {} s", guess.dt) : ""));
        table.drop_first_rows(guess.rows);
        return;
    }
}

/// Numbers per row where all rows have the same; 0 otherwise. Under headings every row must have as many.
std::size_t common_width(const RecordText& text, const NumberTable& table, bool& last_is_shorter)
{
    const std::size_t width = table.width(0);
    last_is_shorter = false;
    for (std::size_t row = 1; row < table.rows(); ++row) {
        if (table.width(row) == width) continue;
        if (!table.headings.empty() && width > 1)
            refuse(text, {table.row_line[row], 0}, fmt::format("{} values under {} headings.", table.width(row), width),
                   "as many values as headings", "fill the line in, or cut the record before it");
        last_is_shorter = row + 1 == table.rows() && table.width(row) < width;
        return 0;
    }
    return width;
}

} // namespace

/// The file has lines of numbers.
bool looks_like_columns(const RecordText& text)
{
    return has_numbers(text);
}

/// Plain text: labelled lines (units, dt, n, component, title: header.hpp), perhaps a heading line, then numbers
/// separated by blanks, tabs, commas or semicolons, with decimal points or commas.
///   - with headings (time_s, accel_m_s2, "acc [g]", "N-S", ...): columns by name; a time column or a stated dt; one record
///   per acceleration column
///   - without: two numbers a line are time and acceleration, unless dt is stated and the first is no time; with dt
///   stated, all numbers in reading order are samples, where all lines but the last have as many numbers, or a stated number of samples
///   is that of all numbers, and where the columns do not look like components side by side
///   - a number of samples, perhaps with the step, above as many samples is taken for what it is
std::vector<Record> read_columns(const RecordText& text, const ReadOptions& options)
{
    NumberTable table = read_number_table(text);
    TextHeader header = read_text_header(text, table.row_line.front());
    std::vector<std::string> remarks;
    take_count_and_step(text, header, table, remarks);
    if (!table.headings.empty() && table.width(0) > 1 &&
        !names_a_quantity(table.headings, table.heading_is_separated) &&
        (options.column.empty() ||
         std::find(table.headings.begin(), table.headings.end(), options.column) == table.headings.end())) {
        table.skipped_lines.push_back(table.heading_line);
        table.headings.clear();
    }
    if (table.headings.empty()) read_commented_headings(text, header, table);
    const auto dt = settle_dt(text, header.dt, options);
    bool last_is_shorter = false;
    const std::size_t width = common_width(text, table, last_is_shorter);
    const File f{text, options, std::move(header), std::move(table), dt, width, last_is_shorter, std::move(remarks)};
    if (!f.table.headings.empty() && f.width > 0) return read_headed(f);
    return read_unheaded(f);
}

RecordFormat columns_format()
{
    return {"columns", looks_like_columns, read_columns};
}

} // namespace damslip::records
