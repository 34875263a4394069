#include "pages/report/table_text.hpp"

#include "core/text.hpp"
#include "pages/report/answer.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace damslip::pages {

std::size_t text_width(const std::string& s)
{
    return static_cast<std::size_t>(std::ranges::count_if(s, [](char c) { return (c & 0xC0) != 0x80; }));
}

namespace {

/// Fixed notation for everyday magnitudes, scientific beyond: 0.0123, 12.3, 1230, 1.23e+07.
std::string number_text(double value, int digits)
{
    if (std::isnan(value)) return "–";
    if (std::isinf(value)) return value > 0 ? "∞" : "−∞";
    if (value == 0.0) return "0";
    const int exponent = static_cast<int>(std::floor(std::log10(std::abs(value))));
    if (exponent < -5 || exponent > 7) return fmt::format("{:.{}e}", value, digits - 1);
    return fmt::format("{:.{}f}", value, std::max(0, digits - 1 - exponent));
}

std::string padded(const std::string& s, std::size_t to, bool right)
{
    const std::string fill(to - std::min(to, text_width(s)), ' ');
    return right ? fill + s : s + fill;
}

using TextLine = std::vector<std::string>;

constexpr std::size_t widest = 110; ///< line of a table in a terminal [characters]

/// Of each column its widest entry.
std::vector<std::size_t> widths_of(const std::vector<TextLine>& lines, std::size_t columns)
{
    std::vector<std::size_t> widths(columns, 0);
    for (const TextLine& line : lines)
        for (std::size_t j = 0; j < line.size(); ++j) widths[j] = std::max(widths[j], text_width(line[j]));
    return widths;
}

/// The columns in groups that fit a line, each with the first `again` columns in front.
std::vector<std::vector<std::size_t>> column_groups(const std::vector<std::size_t>& widths, std::size_t again)
{
    std::vector<std::vector<std::size_t>> groups(1);
    std::size_t used = 0, repeated = 0;
    for (std::size_t j = 0; j < widths.size(); ++j) {
        const std::size_t wanted = widths[j] + 2;
        if (j < again) repeated += wanted;
        if (j > again && used + wanted > widest + 2) {
            groups.emplace_back();
            for (std::size_t k = 0; k < again; ++k) groups.back().push_back(k);
            used = repeated;
        }
        groups.back().push_back(j);
        used += wanted;
    }
    return groups;
}

/// Columns padded to their widest entry, a rule below the first `header` lines; columns beyond the widest line go below.
/// @param again  columns that every part begins with
std::string aligned(const std::vector<TextLine>& lines, std::size_t header, const std::vector<bool>& right,
                    std::size_t again)
{
    const std::vector<std::size_t> widths = widths_of(lines, right.size());
    std::string out;
    for (const std::vector<std::size_t>& group : column_groups(widths, again)) {
        if (!out.empty()) out += "\n";
        std::size_t total = 0;
        for (const std::size_t j : group) total += widths[j] + 2;
        for (std::size_t i = 0; i < lines.size(); ++i) {
            std::string line;
            for (const std::size_t j : group)
                line += (line.empty() ? "" : "  ") + padded(lines[i][j], widths[j], right[j]);
            while (!line.empty() && line.back() == ' ') line.pop_back();
            if (!line.empty() || i == 0 || i >= header) out += line + "\n"; // a part without units has no line for them
            if (i + 1 != header) continue;
            for (std::size_t k = 2; k < total; ++k) out += "─";
            out += "\n";
        }
    }
    return out;
}

/// Title above, notes below.
std::string framed(const Table& table, const std::string& body)
{
    std::string out = (table.title.empty() ? "" : visible(table.title, LineEnds::replaced) + "\n") + body;
    for (const std::string& note : table.notes) out += broken_lines(visible(note, LineEnds::replaced), "  ");
    return out;
}

} // namespace

std::string broken_lines(const std::string& sentence, const std::string& indent)
{
    std::string out, line;
    for (std::size_t from = 0; from <= sentence.size();) {
        const std::size_t end = std::min(sentence.find(' ', from), sentence.size());
        const std::string next = sentence.substr(from, end - from);
        if (!line.empty() && text_width(line) + 1 + text_width(next) > widest) {
            out += line + "\n";
            line.clear();
        }
        line += (line.empty() ? indent : " ") + next;
        from = end + 1;
    }
    return out + line + "\n";
}

std::string cell_text(const Cell& cell, int digits)
{
    struct Show {
        int digits;
        std::string operator()(std::monostate) const { return "–"; }
        std::string operator()(double v) const { return number_text(v, digits); }
        std::string operator()(std::int64_t v) const { return std::to_string(v); }
        std::string operator()(const std::string& v) const { return visible(v, LineEnds::replaced); }
        std::string operator()(bool v) const { return v ? "yes" : "no"; }
    };
    return std::visit(Show{digits}, cell);
}

bool is_number(const Cell& cell)
{
    return std::holds_alternative<double>(cell) || std::holds_alternative<std::int64_t>(cell) ||
           std::holds_alternative<std::monostate>(cell);
}

Table verdict_after(Table table, std::size_t names)
{
    const auto at = std::ranges::find_if(table.columns, [](const Column& column) { return column.key == "verdict"; });
    const auto k = at - table.columns.begin(), first = static_cast<std::ptrdiff_t>(names);
    if (at == table.columns.end() || k <= first) return table;
    std::rotate(table.columns.begin() + first, at, at + 1);
    for (std::vector<Cell>& row : table.rows) std::rotate(row.begin() + first, row.begin() + k, row.begin() + k + 1);
    return table;
}

std::string text(const Table& table)
{
    const std::size_t n = table.columns.size();
    std::vector<TextLine> lines(2, TextLine(n));
    std::vector<bool> right(n, true);
    for (std::size_t j = 0; j < n; ++j) {
        lines[0][j] = table.columns[j].heading;
        lines[1][j] = table.columns[j].unit;
        right[j] = std::ranges::all_of(table.rows, [&](const auto& row) { return is_number(row[j]); });
    }
    if (std::all_of(lines[1].begin(), lines[1].end(), [](const auto& s) { return s.empty(); })) lines.pop_back();
    const std::size_t header = lines.size();
    for (const auto& row : table.rows) {
        lines.emplace_back(n);
        for (std::size_t j = 0; j < n; ++j) lines.back()[j] = cell_text(row[j], table.columns[j].digits);
    }
    const std::size_t names = n > 1 && !right[0] && table.columns[1].key == "polarity" ? 2 : 1;
    const std::vector<std::size_t> widths = widths_of(lines, n);
    if (column_groups(widths, std::min(n, names)).size() > 1)
        if (const Table first = verdict_after(table, names); first.columns[names].key != table.columns[names].key)
            return text(first);
    return framed(table, aligned(lines, header, right, std::min(n, names)));
}

Table with_slips_in_millimetres(Table table)
{
    for (std::size_t j = 0; j < table.columns.size(); ++j) {
        Column& column = table.columns[j];
        if (column.unit != "m" || column.key.find("slip") == std::string::npos) continue;
        column.unit = "mm";
        for (std::vector<Cell>& row : table.rows)
            if (double* value = std::get_if<double>(&row[j])) *value *= 1e3;
    }
    return table;
}

std::string texts(const std::vector<Table>& tables)
{
    std::string all;
    for (const Table& table : tables) all += (all.empty() ? "" : "\n") + text(table);
    return all;
}

std::string text_by_columns(const Table& table, std::size_t labels)
{
    std::vector<TextLine> lines;
    for (std::size_t j = 0; j < table.columns.size(); ++j) {
        const Column& column = table.columns[j];
        TextLine line{column.heading, column.unit};
        for (const auto& row : table.rows) line.push_back(cell_text(row[j], column.digits));
        lines.push_back(std::move(line));
    }
    std::vector<bool> right(2 + table.rows.size(), true);
    right[0] = right[1] = false;
    return framed(table, aligned(lines, labels, right, 2));
}

std::string csv(const Table& table, const std::vector<std::string>& comments)
{
    std::string out = csv_head(table.columns, comments);
    CsvLines lines;
    for (const std::vector<Cell>& row : table.rows) lines.add(row, out);
    return out;
}

} // namespace damslip::pages
