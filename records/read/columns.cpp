#include "records/read/format.hpp"

#include "core/number.hpp"
#include "records/read/samples.hpp"
#include "records/read/time_column.hpp"
#include "records/read/unit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace damslip::records {

namespace {

enum class ColumnKind { time, acceleration, other };

/// What a heading such as "time_s", "acc [cm/s2]", "a_h (g)", "NS" says.
struct ColumnHeading {
    ColumnKind kind = ColumnKind::other; ///< `other`: velocity, displacement, or a name without a unit of acceleration
    std::string name;                    ///< without the unit
    std::optional<std::string> unit;     ///< as written; time: "s" or "ms"
};

/// Splits "name [unit]", "name (unit)", "name_unit" and "name unit".
ColumnHeading split(std::string_view heading)
{
    ColumnHeading out;
    const std::size_t open = heading.find_first_of("[(");
    if (open != std::string_view::npos && heading.size() > open + 1 &&
        (heading.back() == ']' || heading.back() == ')')) {
        out.name = trimmed(heading.substr(0, open));
        out.unit = std::string(trimmed(heading.substr(open + 1, heading.size() - open - 2)));
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
    return out;
}

ColumnHeading read_heading(std::string_view heading)
{
    ColumnHeading out = split(trimmed(heading));
    const std::string name = lower(out.name);
    const std::string unit = out.unit ? lower(*out.unit) : "";
    const bool time_unit = unit.empty() || unit == "s" || unit == "sec" || unit == "ms";
    if ((name == "t" || name.starts_with("time")) && time_unit) {
        out.kind = ColumnKind::time;
        return out;
    }
    const bool motion = name.starts_with("vel") || name.starts_with("dis") || name.starts_with("slip");
    const bool named = name == "a" || name.starts_with("a_") || name.starts_with("acc") || contains(name, "accel");
    const bool by_unit = out.unit && acceleration_unit(*out.unit);
    if (!motion && (named || by_unit)) out.kind = ColumnKind::acceleration;
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
    std::size_t width; ///< numbers in every row; 0: rows differ
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
        record.warnings.push_back(fmt::format("line {} skipped: {}", line, in_quotes(trimmed(f.text.lines[line - 1]))));
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

/// One acceleration column, with the time column if there is one.
Record record_of_column(const File& f, std::optional<std::size_t> time_column, double time_factor, std::size_t column,
                        const AccelerationUnit& unit, RecordSource source)
{
    std::vector<double> accel = samples_of_column(f, column, unit);
    if (!time_column) return finish(f, std::move(accel), *f.stated_dt, std::move(source));
    std::vector<double> time = column_values(f.table, *time_column);
    for (double& t : time) t *= time_factor;
    const auto even = step_of(f.text, f.table, *time_column, time, f.stated_dt, f.options);
    double dt = even ? *even : f.stated_dt.value_or(0.0);
    const std::size_t before = accel.size();
    if (!even) accel = at_even_times(f.text, time, accel, dt);
    Record record = finish(f, std::move(accel), dt, std::move(source));
    if (!even)
        record.warnings.push_back(fmt::format("uneven times resampled: {} samples became {} at {} s", before,
                                              record.acceleration.size(), dt));
    if (std::abs(time.front()) > 0.5 * dt && std::abs(time.front() - dt) > 0.5 * dt)
        record.warnings.push_back(
            fmt::format("the times start at {} s; the first sample is taken as time 0", time.front()));
    return record;
}

std::string list_of(const std::vector<std::string_view>& headings)
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
        else if (kind == ColumnKind::acceleration)
            accelerations.push_back(k);
        else
            others.push_back(k);
    }
    if (!f.options.column.empty()) accelerations = {chosen_column(f)};
    // A lone unnamed column beside the time can be nothing else; its unit must still be stated.
    const std::string lone = others.size() == 1 ? lower(names[others[0]]) : "";
    if (accelerations.empty() && others.size() == 1 && !lone.starts_with("vel") && !lone.starts_with("dis"))
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

Record read_two_columns(const File& f)
{
    const AccelerationUnit unit = settle_unit(f.text, f.header.unit, f.options);
    return record_of_column(f, std::size_t{0}, 1.0, 1, unit, source_of(f, "two columns", unit, ""));
}

std::vector<Record> read_unheaded(const File& f)
{
    const bool first_is_time = f.width >= 2 && is_rising(column_values(f.table, 0));
    if (f.stated_dt && !first_is_time && f.options.column.empty()) return {read_stream(f)};
    if (f.width == 2) return {read_two_columns(f)};
    if (!f.options.column.empty() && f.width > 0 && f.stated_dt) {
        const AccelerationUnit unit = settle_unit(f.text, f.header.unit, f.options);
        return {record_of_column(f, std::nullopt, 1.0, chosen_column(f), unit,
                                 source_of(f, "columns", unit, f.options.column))};
    }
    if (first_is_time)
        refuse(f.text, {f.table.row_line.front(), 0},
               fmt::format("{} numbers a line without headings, and the first rises like a time.", f.width),
               "time and acceleration; or columns with a heading line",
               "name the columns in a heading line (time_s, accel_g)");
    if (f.width == 1)
        refuse(f.text, {f.table.row_line.front(), 0}, "one number a line and no time step.", "a time step",
               std::string(say_dt));
    refuse(f.text, {f.table.row_line.front(), 0},
           f.width ? fmt::format("{} numbers a line, without headings and without a time step.", f.width)
                   : std::string("lines of different numbers of values, without a time step."),
           "time and acceleration; or columns with a heading line; or samples in reading order with a time step",
           "name the columns in a heading line (time_s, accel_g); or, if all numbers are samples, " +
               std::string(say_dt));
}

/// A line above the numbers is a heading only if it names a quantity that a record file holds; else it is a remark.
bool names_a_quantity(const std::vector<std::string_view>& headings)
{
    return std::any_of(headings.begin(), headings.end(), [](std::string_view heading) {
        const std::string name = lower(heading);
        return read_heading(heading).kind != ColumnKind::other || name.starts_with("vel") || name.starts_with("dis");
    });
}

/// Numbers per row where all rows have the same; 0 otherwise. Under headings every row must have as many.
std::size_t common_width(const RecordText& text, const NumberTable& table)
{
    const std::size_t width = table.width(0);
    for (std::size_t row = 1; row < table.rows(); ++row) {
        if (table.width(row) == width) continue;
        if (!table.headings.empty() && width > 1)
            refuse(text, {table.row_line[row], 0}, fmt::format("{} values under {} headings.", table.width(row), width),
                   "as many values as headings", "fill the line in, or cut the record before it");
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

/// Plain text: comment lines "# key: value" (units, dt, n, component, title), perhaps a heading line, then numbers
/// separated by blanks, tabs, commas or semicolons, with decimal points or commas.
///   - with headings (time_s, accel_m_s2, "acc [g]", ...): columns by name; a time column or a stated dt; one record
///   per acceleration column
///   - without: two numbers a line are time and acceleration, unless dt is stated and the first is no time; with dt
///   stated, all numbers
///     in reading order are samples, any number to a line
std::vector<Record> read_columns(const RecordText& text, const ReadOptions& options)
{
    TextHeader header = read_text_header(text);
    NumberTable table = read_number_table(text);
    if (!table.headings.empty() && options.column.empty() && table.width(0) > 1 && !names_a_quantity(table.headings)) {
        table.skipped_lines.push_back(table.heading_line);
        table.headings.clear();
    }
    const auto dt = settle_dt(text, header.dt, options);
    const std::size_t width = common_width(text, table);
    const File f{text, options, std::move(header), std::move(table), dt, width};
    if (!f.table.headings.empty() && f.width > 0) return read_headed(f);
    return read_unheaded(f);
}

RecordFormat columns_format()
{
    return {"columns", looks_like_columns, read_columns};
}

} // namespace damslip::records
