#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace damslip {

/// A named result column: the key carries the unit in files ("slip_m"), heading and unit are what people read.
struct Column {
    std::string key;     ///< CSV header and JSON key, unit as suffix: "yield_acceleration_m_s2"
    std::string heading; ///< terminal and report: "yield acceleration"
    std::string unit;    ///< "m/s²", "mm", "–"; empty for text columns
    int digits = 4;      ///< significant digits for people; files always carry the full double
};

/// Nothing (not defined here; printed as "–", null in JSON, empty in CSV), a number, a count, a word, yes/no.
using Cell = std::variant<std::monostate, double, std::int64_t, std::string, bool>;

/// The number in a unit; nothing where it is not finite.
inline Cell finite_cell(double x, double unit = 1.0)
{
    return std::isfinite(x) ? Cell(x / unit) : Cell();
}

/// Results by name and unit; made by the modules' callers, rendered by pages/.
struct Table {
    std::string title;
    std::vector<Column> columns;
    std::vector<std::vector<Cell>> rows; ///< each of columns.size() cells
    std::vector<std::string> notes;      ///< sentences printed under the table
};

} // namespace damslip
