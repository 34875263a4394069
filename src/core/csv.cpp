#include "core/csv.hpp"

#include "core/text.hpp"

#include <optional>

namespace damslip {

namespace {

std::string without_blanks(std::string_view text)
{
    const std::size_t first = text.find_first_not_of(" \t\r"), last = text.find_last_not_of(" \t\r");
    return first == std::string_view::npos ? std::string() : std::string(text.substr(first, last - first + 1));
}

/// A sign that a spreadsheet takes for the beginning of a formula, behind any apostrophes.
bool begins_formula(std::string_view cell)
{
    const std::size_t at = cell.find_first_not_of('\'');
    return at != std::string_view::npos && std::string_view("=+-@").find(cell[at]) != std::string_view::npos;
}

/// Takes the first cell of the line, and its comma. @returns nothing: the line is at its end
std::optional<std::string> next_cell(std::string_view& line, bool& more)
{
    if (!more) return std::nullopt;
    std::string cell;
    const std::size_t first = line.find_first_not_of(" \t\r");
    const bool quoted = first != std::string_view::npos && line[first] == '"';
    if (quoted) {
        line.remove_prefix(first + 1);
        for (std::size_t end = line.find('"'); end != std::string_view::npos; end = line.find('"')) {
            cell += line.substr(0, end);
            line.remove_prefix(end + 1);
            if (!line.starts_with('"')) break;
            cell += '"';
            line.remove_prefix(1);
        }
    }
    const std::size_t comma = line.find(',');
    if (!quoted) cell = without_blanks(line.substr(0, comma));
    more = comma != std::string_view::npos;
    line.remove_prefix(more ? comma + 1 : line.size());
    if (cell.starts_with('\'') && begins_formula(cell)) cell.erase(0, 1);
    return cell;
}

std::vector<std::string> cells_of(std::string_view line)
{
    std::vector<std::string> cells;
    bool more = true;
    while (std::optional<std::string> cell = next_cell(line, more)) cells.push_back(std::move(*cell));
    return cells;
}

} // namespace

CsvTable parse_csv(std::string_view bytes)
{
    const std::string converted = is_utf8(bytes) ? std::string() : utf8_text(std::string(bytes));
    std::string_view text = converted.empty() ? bytes : converted;
    constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
    if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
    CsvTable table;
    for (int number = 1; !text.empty(); ++number) {
        const std::size_t end = text.find('\n');
        const std::string_view line = text.substr(0, end);
        text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
        if (without_blanks(line).empty() || line.starts_with("#")) continue;
        CsvLine read{number, cells_of(line)};
        if (table.heading.cells.empty())
            table.heading = std::move(read);
        else
            table.rows.push_back(std::move(read));
    }
    return table;
}

std::string csv_cell(std::string_view text)
{
    std::string cell = visible(text, LineEnds::replaced);
    if (cell.empty()) return cell;
    if (begins_formula(cell)) cell.insert(0, 1, '\'');
    if (cell.find_first_of(",\"") == std::string::npos && cell.front() != '#' && without_blanks(cell) == cell)
        return cell;
    std::string quoted = "\"";
    for (const char c : cell) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + '"';
}

} // namespace damslip
