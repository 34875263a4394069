#include "records/read/number_table.hpp"

#include "core/number.hpp"
#include "records/read/cut_end.hpp"
#include "records/read/header.hpp"
#include "records/read/samples.hpp"
#include "records/transform/transform.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <optional>

namespace damslip::records {

namespace {

constexpr std::size_t lines_looked_at = 60;          // for the first numbers
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

std::optional<std::size_t> first_number_line(const RecordText& text)
{
    std::size_t words = 0;
    for (std::size_t k = 0; k < text.lines.size() && words < lines_looked_at; ++k) {
        if (is_comment(text.lines[k]) || trimmed(text.lines[k]).empty()) continue;
        if (is_number_line(text.lines[k])) return k + 1;
        ++words;
    }
    return std::nullopt;
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
        std::size_t used = 0;
        double value = 0.0;
        if (table.dialect.decimal_comma) {
            copy = field;
            if (contains(copy, ".") && contains(copy, ","))
                refuse(text, place, fmt::format("{} has both a comma and a point.", in_quotes(field)),
                       "one decimal sign, no thousands separators", "rewrite the number");
            std::replace(copy.begin(), copy.end(), ',', '.');
            value = number_at(text, copy, place, used);
        } else {
            value = number_at(text, field, place, used);
        }
        if (used != field.size())
            refuse(text, place, fmt::format("{} is not a number.", in_quotes(field)), "a finite decimal number",
                   "correct it, or start the line with # if it is a remark");
        table.values.push_back(value);
    }
    table.row_begin.push_back(table.values.size());
    table.row_line.push_back(static_cast<std::uint32_t>(line));
    if (table.values.size() > most_values)
        refuse(text, {line, 0}, fmt::format("more than {} numbers.", most_values),
               fmt::format("at most {} samples", max_samples), "cut the record");
}

/// A line of words right above the numbers that has as many fields as they have is their heading.
void read_headings(const RecordText& text, std::size_t first, std::size_t width, NumberTable& table)
{
    std::size_t nearest = 0;
    for (std::size_t line = 1; line < first; ++line) {
        if (is_comment(text.lines[line - 1]) || trimmed(text.lines[line - 1]).empty()) continue;
        if (nearest) table.skipped_lines.push_back(nearest);
        nearest = line;
    }
    if (!nearest) return;
    for (const char separator : {table.dialect.separator, ',', ';', ' '}) {
        const auto fields = fields_of(text.lines[nearest - 1], {separator, false});
        if (fields.size() != width) continue;
        for (const std::string_view field : fields) { // a broken first row must not pass for a heading
            const std::string word = lower(field);
            const bool value = parse_number(word).has_value() || word == "nan" || word.starts_with("inf") ||
                               word.find_first_not_of("*") == std::string::npos;
            std::size_t used = 0;
            if (value)
                (void)number_at(text, field,
                                {nearest, static_cast<std::size_t>(field.data() - text.lines[nearest - 1].data()) + 1},
                                used);
            if (value)
                refuse(text, {nearest, 0},
                       fmt::format("{} is neither a row of numbers nor a heading.",
                                   in_quotes(trimmed(text.lines[nearest - 1]))),
                       "names of columns, or numbers only", "correct the line, or start it with # if it is a remark");
        }
        table.headings = fields;
        table.heading_line = nearest;
        return;
    }
    table.skipped_lines.push_back(nearest);
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
    const auto add = [&](std::string_view field) {
        field = trimmed(field);
        if (field.size() >= 2 && field.front() == '"' && field.back() == '"')
            field = trimmed(field.substr(1, field.size() - 2));
        fields.push_back(field);
    };
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
    read_headings(text, *first, table.width(0), table);
    refuse_cut_end(text, *first);
    return table;
}

} // namespace damslip::records
