#include "core/csv.hpp"

namespace damslip {

namespace {

std::string without_blanks(std::string_view text)
{
    const std::size_t first = text.find_first_not_of(" \t\r"), last = text.find_last_not_of(" \t\r");
    return first == std::string_view::npos ? std::string() : std::string(text.substr(first, last - first + 1));
}

std::vector<std::string> cells_of(std::string_view line)
{
    std::vector<std::string> cells;
    while (true) {
        const std::size_t comma = line.find(',');
        cells.push_back(without_blanks(line.substr(0, comma)));
        if (comma == std::string_view::npos) return cells;
        line.remove_prefix(comma + 1);
    }
}

} // namespace

CsvTable parse_csv(std::string_view text)
{
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

} // namespace damslip
