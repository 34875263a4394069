#include "records/read/number_table.hpp"

#include "core/text.hpp"
#include "records/read/agency_samples.hpp"
#include "records/read/header.hpp"
#include "records/read/read_record.hpp"
#include "records/transform/transform.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <optional>

namespace damslip::records {

namespace {

constexpr std::size_t lines_looked_at = 200;         // for the first numbers
constexpr std::size_t most_values = 6 * max_samples; // of all columns

bool is_number_character(char c)
{
    return (c >= '0' && c <= '9') || std::string_view("+-.,;eEdD \t").find(c) != std::string_view::npos;
}

/// Digits, signs, points and separators only, at least one digit, no letter but an exponent's.
bool is_number_line(std::string_view line)
{
    const std::string_view s = trimmed(line);
    if (s.empty() || !std::all_of(s.begin(), s.end(), is_number_character)) return false;
    const char first = s.front();
    return s.find_first_of("0123456789") != std::string_view::npos &&
           std::string_view("eEdD,;").find(first) == std::string_view::npos;
}

/// Where numbers begin that go on: up to five lines of numbers with words below them belong to the header.
std::optional<std::size_t> first_number_line(const RecordText& text)
{
    constexpr std::size_t most_in_header = 5, least_of_record = 10;
    std::optional<std::size_t> first; // of the present run of numbers
    std::size_t words = 0, run = 0;
    for (std::size_t k = 0; k < text.lines.size() && words < lines_looked_at; ++k) {
        if (is_comment(text.lines[k]) || trimmed(text.lines[k]).empty()) continue;
        if (is_number_line(text.lines[k])) {
            if (run++ == 0) first = k + 1;
            if (run > most_in_header) return first;
        } else {
            std::size_t below = 0; // lines of numbers, as far as they count
            for (std::size_t next = k; run > 0 && next < text.lines.size() && below < least_of_record; ++next)
                below += is_number_line(text.lines[next]);
            if (run > 0 && below < least_of_record) return first;
            run = 0, ++words;
        }
    }
    return run > 0 ? first : std::nullopt;
}

struct CommaCount {
    std::size_t commas = 0, points = 0, rows_with_one_comma = 0, rows = 0;
    bool comma_and_blank = false; ///< ", " somewhere: a separator
    bool each_token_has_one = true;
};

CommaCount count_commas(const RecordText& text, std::size_t first)
{
    CommaCount n;
    for (std::size_t line = first; line <= text.lines.size() && n.rows < 50; ++line) {
        const std::string_view s = trimmed(text.lines[line - 1]);
        if (!is_number_line(s)) continue;
        ++n.rows;
        const auto commas = static_cast<std::size_t>(std::count(s.begin(), s.end(), ','));
        n.commas += commas;
        n.points += static_cast<std::size_t>(std::count(s.begin(), s.end(), '.'));
        n.rows_with_one_comma += commas == 1;
        n.comma_and_blank |= contains(s, ", ") || contains(s, ",\t") || contains(s, " ,");
        for (const std::string_view token : fields_of(s, {}))
            n.each_token_has_one &= std::count(token.begin(), token.end(), ',') == 1;
    }
    return n;
}

Dialect dialect_of(const RecordText& text, std::size_t first)
{
    const CommaCount n = count_commas(text, first);
    const std::string_view row = text.lines[first - 1];
    if (contains(row, ";")) return {';', n.commas > 0};
    if (n.commas == 0) return {};
    if (n.points > 0 || n.comma_and_blank) return {',', false};
    if (trimmed(row).find_first_of(" \t") != std::string_view::npos) return {' ', n.each_token_has_one};
    const bool heading_has_comma =
        first >= 2 && !is_comment(text.lines[first - 2]) && contains(text.lines[first - 2], ",");
    if (heading_has_comma || n.rows_with_one_comma < n.rows) return {',', false};
    refuse(text, {first, 1},
           fmt::format("{} may be one number with a decimal comma or two numbers.", in_quotes(trimmed(row))),
           "decimal points, or columns separated by semicolons, tabs or blanks",
           "rewrite the file either way, or put a heading line above the columns");
}

/// Appends the numbers of one line; `fields` is scratch.
void read_row(const RecordText& text, std::size_t line, std::vector<std::string_view>& fields, NumberTable& table)
{
    const std::string_view whole = text.lines[line - 1];
    std::string copy;
    fields_of(whole, table.dialect, fields);
    for (const std::string_view field : fields) {
        const Place place{line, static_cast<std::size_t>(field.data() - whole.data()) + 1};
        std::string_view rest = field;
        if (table.dialect.decimal_comma) {
            copy = field;
            if (contains(copy, ".") && contains(copy, ","))
                refuse(text, place, fmt::format("{} has both a comma and a point.", in_quotes(field)),
                       "one decimal sign, no thousands separators", "rewrite the number");
            std::replace(copy.begin(), copy.end(), ',', '.');
            rest = copy;
        }
        do {
            std::size_t used = 0;
            const double value = number_at(text, rest, place, used);
            const bool touches = used < rest.size() && (rest[used] == '-' || rest[used] == '+') &&
                                 contains(rest.substr(0, used), ".") && table.dialect.separator == ' ';
            if (used != rest.size() && !touches)
                refuse(text, place, fmt::format("{} is not a number.", in_quotes(field)), "a finite decimal number",
                       "correct it, or start the line with # if it is a remark");
            table.values.push_back(value);
            rest.remove_prefix(used);
        } while (!rest.empty());
    }
    table.row_begin.push_back(table.values.size());
    table.row_line.push_back(static_cast<std::uint32_t>(line));
    if (table.values.size() > most_values)
        refuse(text, {line, 0}, fmt::format("more than {} numbers.", most_values),
               fmt::format("at most {} samples", max_samples), "cut the record");
}

/// A broken first row of numbers must not pass for a heading.
void refuse_row_of_numbers(const RecordText& text, std::size_t line, const std::vector<std::string>& fields)
{
    for (const std::string& field : fields) {
        const std::string word = lower(field);
        const bool value = parse_number(word).has_value() || word == "nan" || word.starts_with("inf") ||
                           word.find_first_not_of("*") == std::string::npos;
        if (!value) continue;
        std::size_t used = 0;
        (void)number_at(text, field, {line, text.lines[line - 1].find(field) + 1}, used);
        refuse(text, {line, 0},
               fmt::format("{} is neither a row of numbers nor a heading.", in_quotes(trimmed(text.lines[line - 1]))),
               "names of columns, or numbers only", "correct the line, or start it with # if it is a remark");
    }
}

/// "(s)", "[g]", "sec", "cm/s2": units alone.
bool are_units(const std::vector<std::string>& fields)
{
    return !fields.empty() && std::all_of(fields.begin(), fields.end(), [](std::string field) {
        std::erase_if(field, [](char c) { return c == '(' || c == ')' || c == '[' || c == ']'; });
        return field == "s" || field == "sec" || acceleration_unit(field).has_value();
    });
}

/// A line of words right above the numbers that has as many fields as they have is their heading; a line of units alone belongs to the
/// names above it.
void read_headings(const RecordText& text, std::size_t first, std::size_t width, NumberTable& table)
{
    std::vector<std::size_t> words; // lines above the numbers
    for (std::size_t line = 1; line < first; ++line)
        if (!is_comment(text.lines[line - 1]) && !trimmed(text.lines[line - 1]).empty()) words.push_back(line);
    table.skipped_lines = words;
    if (words.empty()) return;
    const auto fields = [&](std::size_t line) {
        return heading_fields(text.lines[line - 1], table.dialect.separator, width, table.heading_is_separated);
    };
    std::vector<std::string> headings = fields(words.back());
    if (headings.empty()) return;
    refuse_row_of_numbers(text, words.back(), headings);
    table.skipped_lines.pop_back();
    table.heading_line = words.back();
    if (width > 1 && are_units(headings) && words.size() > 1)
        if (std::vector<std::string> names = fields(words[words.size() - 2]); !names.empty()) {
            for (std::size_t k = 0; k < width; ++k) {
                std::erase_if(headings[k], [](char c) { return c == '(' || c == ')' || c == '[' || c == ']'; });
                headings[k] = names[k] + " [" + headings[k] + "]";
            }
            table.skipped_lines.pop_back();
        }
    table.headings = std::move(headings);
}

} // namespace

namespace {

/// A field without the double quotes around it.
std::string_view unquoted(std::string_view field)
{
    const bool quoted = field.size() >= 2 && field.front() == '"' && field.back() == '"';
    return quoted ? trimmed(field.substr(1, field.size() - 2)) : field;
}

} // namespace

std::vector<std::string_view> fields_of(std::string_view line, const Dialect& dialect)
{
    std::vector<std::string_view> fields;
    fields_of(line, dialect, fields);
    return fields;
}

void fields_of(std::string_view line, const Dialect& dialect, std::vector<std::string_view>& fields)
{
    fields.clear();
    const auto add = [&](std::string_view field) { fields.push_back(unquoted(trimmed(field))); };
    if (dialect.separator == ' ') {
        for (std::size_t at = 0; (at = line.find_first_not_of(" \t", at)) != std::string_view::npos;) {
            const std::size_t end = std::min(line.find_first_of(" \t", at), line.size());
            add(line.substr(at, end - at));
            at = end;
        }
        return;
    }
    for (std::size_t at = 0; at <= line.size();) {
        const std::size_t end = std::min(line.find(dialect.separator, at), line.size());
        if (end == line.size() && !fields.empty() && trimmed(line.substr(at)).empty()) break;
        add(line.substr(at, end - at));
        at = end + 1;
    }
}

std::vector<std::string> heading_fields(std::string_view line, char separator, std::size_t width, bool& separated)
{
    for (const char by : {separator, '\t', ',', ';', ' '}) {
        auto fields = fields_of(line, {by, false});
        if (by == ' ' && fields.size() > width) { // "Time [sec]", in quotes or without: the unit belongs to the name
            std::vector<std::string_view> joined;
            for (const std::string_view field : fields) {
                const bool in_brackets = !joined.empty() &&
                                         joined.back().find_first_of("([") != std::string_view::npos &&
                                         joined.back().find_last_of(")]") == std::string_view::npos;
                const bool open = in_brackets || (!joined.empty() && joined.back().front() == '"' &&
                                                  (joined.back().size() == 1 || joined.back().back() != '"'));
                if (!joined.empty() && (open || field.front() == '(' || field.front() == '['))
                    joined.back() = {joined.back().data(),
                                     static_cast<std::size_t>(field.data() + field.size() - joined.back().data())};
                else
                    joined.push_back(field);
            }
            fields = std::move(joined);
        }
        if (fields.size() != width) continue;
        separated = by != ' ';
        for (std::string_view& field : fields) field = unquoted(field);
        return {fields.begin(), fields.end()};
    }
    return {};
}

void NumberTable::drop_first_rows(std::size_t count)
{
    const std::size_t values_gone = row_begin[count];
    values.erase(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values_gone));
    row_line.erase(row_line.begin(), row_line.begin() + static_cast<std::ptrdiff_t>(count));
    row_begin.erase(row_begin.begin(), row_begin.begin() + static_cast<std::ptrdiff_t>(count));
    for (std::size_t& begin : row_begin) begin -= values_gone;
}

Place NumberTable::place(std::size_t row, std::size_t field, const RecordText& text) const
{
    const std::string_view line = text.lines[row_line[row] - 1];
    const auto fields = fields_of(line, dialect);
    return {row_line[row],
            field < fields.size() ? static_cast<std::size_t>(fields[field].data() - line.data()) + 1 : 0};
}

bool has_numbers(const RecordText& text)
{
    return first_number_line(text).has_value();
}

NumberTable read_number_table(const RecordText& text)
{
    const auto first = first_number_line(text);
    if (!first)
        refuse(text, {}, "no line of numbers was found.", "an accelerogram as text",
               "check that this is the right file");
    NumberTable table;
    table.dialect = dialect_of(text, *first);
    table.row_begin.push_back(0);
    std::vector<std::string_view> fields; // of one line, kept for its memory
    for (std::size_t line = *first; line <= text.lines.size(); ++line)
        if (!is_comment(text.lines[line - 1]) && !trimmed(text.lines[line - 1]).empty())
            read_row(text, line, fields, table);
    // The first row may be no sample (number and step above one column): the heading names what all others hold.
    read_headings(text, *first, table.width(table.rows() > 2 ? 1 : 0), table);
    table.open_end = refuse_cut_end(text, *first);
    return table;
}

namespace {

double mean_step(std::span<const double> time)
{
    return (time.back() - time.front()) / static_cast<double>(time.size() - 1);
}

/// Row whose step from the row before deviates most from the mean, and that deviation relative to the mean.
std::pair<std::size_t, double> worst_step(std::span<const double> time)
{
    const double mean = mean_step(time);
    std::size_t row = 1;
    double worst = 0.0;
    for (std::size_t k = 1; k < time.size(); ++k) {
        const double deviation = std::abs(time[k] - time[k - 1] - mean);
        if (deviation > worst) worst = deviation, row = k;
    }
    return {row, worst / mean};
}

void refuse_falling(const RecordText& text, const TimeColumn& column)
{
    const auto time = column.time;
    for (std::size_t k = 1; k < time.size(); ++k)
        if (!(time[k] > time[k - 1]))
            refuse(text, column.place(k), fmt::format("the time {} s does not follow {} s.", time[k], time[k - 1]),
                   "times that rise from line to line; two numbers a line are time and acceleration",
                   "correct the times; if all numbers are samples, state the time step (\"# dt: 0.01 s\" or --dt)");
}

/// 0.0199999999999 -> 0.02: the division of printed times leaves round-off that the file does not mean.
double tidy(double dt)
{
    const double round = parse_number(fmt::format("{:.9e}", dt)).value_or(dt);
    return std::abs(round - dt) <= 1e-10 * dt ? round : dt;
}

/// Half of the last printed digit of the largest time, or what single precision leaves of it [s].
double rounding_of(const TimeColumn& column)
{
    constexpr double single_precision = 1.2e-7;
    constexpr std::size_t digits_of_single = 7;
    const double largest = std::max(std::abs(column.time.front()), std::abs(column.time.back()));
    const double before_point = std::floor(std::log10(largest)) + 1.0;
    const double printed = 0.5 * std::pow(10.0, before_point - static_cast<double>(column.digits));
    return column.digits >= digits_of_single ? std::max(printed, single_precision * largest) : printed;
}

/// Steps that are none at all, or two and more of the step that all others have.
struct OddSteps {
    std::size_t row = 0; ///< at the end of the first of them
    std::size_t count = 0;
    double usual = 0.0; ///< [s]
};

/// A few such steps: lines that are missing or stand twice. A step that is rounded to one unit of the last digit leaves the same traces, but
/// at equal distances: more than ten tell the two apart. Nothing where steps differ in any other way.
std::optional<OddSteps> odd_steps(const TimeColumn& column)
{
    constexpr std::size_t least_steps = 20, most_odd = 10, others_of_one = 100;
    constexpr double longest = 100.0; // in usual steps: beyond it a time is wrong
    const auto time = column.time;
    if (time.size() <= least_steps) return std::nullopt;
    std::vector<double> steps(time.size() - 1);
    for (std::size_t k = 1; k < time.size(); ++k) steps[k - 1] = time[k] - time[k - 1];
    std::vector<double> sorted = steps;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    OddSteps odd{0, 0, *middle};
    if (!(odd.usual > 0.0)) return std::nullopt;
    const double same = (1.0 + 1e-6) * std::min(2.0 * rounding_of(column), 0.5 * odd.usual);
    for (std::size_t k = 0; k < steps.size(); ++k) {
        if (std::abs(steps[k] - odd.usual) <= same) continue;
        const double times = std::round(steps[k] / odd.usual);
        if (times < 0.0 || times == 1.0 || times > longest || std::abs(steps[k] - times * odd.usual) > same)
            return std::nullopt;
        if (odd.count++ == 0) odd.row = k + 1;
    }
    const bool few = odd.count == 1 || (odd.count <= most_odd && odd.count * others_of_one <= steps.size());
    return odd.count > 0 && few ? std::optional(odd) : std::nullopt;
}

[[noreturn]] void refuse_odd(const RecordText& text, const TimeColumn& column, const OddSteps& odd, bool step_is_stated)
{
    const double step = column.time[odd.row] - column.time[odd.row - 1];
    const double missing = std::round(step / odd.usual) - 1.0;
    const bool twice = missing < 0.0, one = missing == 1.0;
    const std::string what = twice ? "this line stands twice"
                             : one ? "a line is missing above this one"
                                   : fmt::format("{} lines are missing above this one", missing);
    const std::size_t others = column.time.size() - 1 - odd.count;
    const std::string more = odd.count == 1   ? ""
                             : odd.count == 2 ? ", and one step more is odd"
                                              : fmt::format(", and {} steps more are odd", odd.count - 1);
    refuse(text, column.place(odd.row),
           fmt::format("one step of {:.6g} s among {} of {:.6g} s: {}{}.", step, others, odd.usual, what, more),
           "one time step from line to line",
           fmt::format("{}{}",
                       twice ? "delete the line that is too many"
                             : "put in what is missing, or have it interpolated (`damslip record convert --resample`)",
                       step_is_stated || !(twice || one)
                           ? ""
                           : "; if all lines are there and only rounded, state their step (motion.record.dt_s, --dt)"));
}

/// All times are t_0 + k dt within the rounding, t_0 being the first one or, of many times, any near it.
bool fits(std::span<const double> time, double dt, double rounding)
{
    constexpr std::size_t many = 20;
    double low = 0.0, high = 0.0;
    for (std::size_t k = 0; k < time.size(); ++k) {
        const double off = time[k] - time.front() - static_cast<double>(k) * dt;
        low = std::min(low, off), high = std::max(high, off);
    }
    const double slack = 1e-6 * rounding + 1e-12 * std::abs(time.back());
    return std::max(-low, high) <= rounding + slack || (time.size() >= many && high - low < 1.999 * rounding);
}

/// The step of times that are rounded: the stated one; else the one with a whole number of samples a second, or the roundest.
/// @throws InputError where the rounding leaves it open
std::optional<double> rounded_step(const RecordText& text, const TimeColumn& column, std::optional<double> stated)
{
    constexpr double open = 0.05; // relative: beyond it the times are uneven rather than rounded
    const double dt = mean_step(column.time), rounding = rounding_of(column);
    const double half_width = 2.0 * rounding / static_cast<double>(column.time.size() - 1);
    if (!(dt > 0.0) || half_width > open * dt) return std::nullopt;
    if (stated) return fits(column.time, *stated, rounding) ? stated : std::nullopt;
    std::vector<double> candidates{1.0 / std::round(1.0 / dt)};
    for (int digits = 2; digits <= 8; ++digits)
        candidates.push_back(parse_number(fmt::format("{:.{}e}", dt, digits - 1)).value_or(dt));
    for (const double candidate : candidates)
        if (fits(column.time, candidate, rounding)) {
            if (half_width > even_tolerance * dt)
                refuse(text, column.place(0),
                       fmt::format("the times are rounded: their step lies between {:.6g} and {:.6g} s.",
                                   dt - half_width, dt + half_width),
                       fmt::format("a step that is known within {:.1f} %", 100.0 * even_tolerance),
                       fmt::format("state it (motion.record.dt_s, or  --dt {:.8g}  if that is the step)", candidate));
            return candidate;
        }
    return std::nullopt;
}

/// Per cent, never rounded down to the tolerance that it is beyond.
std::string per_cent_off(double relative)
{
    const double per_cent = 100.0 * relative, unit = std::pow(10.0, std::floor(std::log10(per_cent)) - 1.0);
    return fmt::format("{:.3g} % off", std::ceil(per_cent / unit * (1.0 - 1e-12)) * unit);
}

} // namespace

bool is_rising(std::span<const double> values)
{
    return values.size() >= 3 &&
           std::adjacent_find(values.begin(), values.end(), std::greater_equal<>{}) == values.end();
}

std::size_t significant_digits(std::string_view number)
{
    number = number.substr(0, number.find_first_of("eEdD"));
    const std::size_t first = number.find_first_of("123456789");
    if (first == std::string_view::npos) return 0;
    return static_cast<std::size_t>(std::count_if(number.begin() + static_cast<std::ptrdiff_t>(first), number.end(),
                                                  [](char c) { return c >= '0' && c <= '9'; }));
}

std::optional<double> step_of(const RecordText& text, const TimeColumn& column, std::optional<double> stated,
                              const ReadOptions& options)
{
    const auto time = column.time;
    if (time.size() < 2)
        refuse(text, {column.place(0).line, 0}, "there is one line of numbers only.", "at least 2 samples",
               "check that the file is complete");
    const bool rises = std::adjacent_find(time.begin(), time.end(), std::greater_equal<>{}) == time.end();
    const bool falls = std::adjacent_find(time.begin(), time.end(), std::greater<>{}) != time.end();
    const double dt = mean_step(time);
    const auto [row, deviation] = worst_step(time);
    const bool even = rises && deviation <= even_tolerance * (1.0 + 1e-9), // the round-off of printed times aside
        as_stated = !stated || std::abs(*stated - dt) <= 1e-4 * dt;
    if (!falls && !(even && as_stated)) {
        // A stated step settles what is rounded; without one, a line that is missing looks like rounding.
        const auto odd = options.survey ? std::nullopt : odd_steps(column);
        if (!odd || stated)
            if (const auto rounded = rounded_step(text, column, stated)) return rounded;
        if (odd && (!rises || options.uneven == UnevenTime::refuse)) refuse_odd(text, column, *odd, stated.has_value());
    }
    refuse_falling(text, column);
    if (!even) {
        if (options.uneven == UnevenTime::resample) return std::nullopt;
        refuse(text, column.place(row),
               fmt::format("the time step is uneven: {:.6g} s here, {:.6g} s on average ({}).",
                           time[row] - time[row - 1], dt, per_cent_off(deviation)),
               fmt::format("steps equal within {:.1f} % or rounded to the printed digits (digitised film is uneven)",
                           100.0 * even_tolerance),
               "correct the times, or have the record resampled (`damslip record convert --resample --dt 0.005`)");
    }
    if (!as_stated)
        refuse(text, {column.place(0).line, 0},
               fmt::format("the time column steps by {:.6g} s, but dt = {} s is stated.", dt, *stated), "one time step",
               "leave the stated one out (\"# dt:\", motion.record.dt_s, --dt) or correct the times");
    return stated ? *stated : tidy(dt);
}

std::vector<double> at_even_times(const RecordText& text, const TimeColumn& column, std::vector<double> accel,
                                  std::optional<double> stated, const ReadOptions& options, double& dt,
                                  std::vector<std::string>& warnings)
{
    const auto time = column.time;
    if (const auto step = step_of(text, column, stated, options)) {
        dt = *step;
        return accel;
    }
    dt = stated.value_or(0.0);
    if (dt <= 0.0) {
        dt = time[1] - time[0];
        for (std::size_t k = 1; k < time.size(); ++k) dt = std::min(dt, time[k] - time[k - 1]);
        dt = tidy(dt);
    }
    const double count = std::floor((time.back() - time.front()) / dt * (1.0 + 1e-12)) + 1.0;
    if (!(count >= 2.0 && count <= static_cast<double>(max_samples)))
        refuse(text, {}, fmt::format("a time step of {:.3g} s makes {:.3g} samples of this file.", dt, count),
               fmt::format("2 to {} samples", max_samples), "give a time step (motion.record.dt_s, --dt)");
    std::vector<double> even(static_cast<std::size_t>(count));
    std::size_t left = 0;
    for (std::size_t k = 0; k < even.size(); ++k) {
        const double t = time.front() + static_cast<double>(k) * dt;
        while (left + 2 < time.size() && time[left + 1] <= t) ++left;
        const double x = std::clamp((t - time[left]) / (time[left + 1] - time[left]), 0.0, 1.0);
        even[k] = accel[left] + x * (accel[left + 1] - accel[left]);
    }
    warnings.push_back(
        fmt::format("uneven times resampled: {} samples became {} at {} s", accel.size(), even.size(), dt));
    return even;
}

} // namespace damslip::records
