#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace damslip {

/// One line of a table with its number in the file.
struct CsvLine {
    int number = 0; ///< from 1
    std::vector<std::string> cells;
};

/// A table of commas: a heading, then rows; blanks around a cell do not count, nor do empty lines and those that start with "#". A cell in
/// quotes ("a ""b"", c") may hold commas, quotes and blanks at its ends; the apostrophe of csv_cell() is taken off. Bytes that are no UTF-8
/// are taken as Latin-1.
struct CsvTable {
    CsvLine heading; ///< without cells: the text has no line
    std::vector<CsvLine> rows;
};

CsvTable parse_csv(std::string_view text);

/// A text as a cell that parse_csv() reads back: in quotes where it needs them, one line, control characters as their pictures. What begins
/// with = + - @ has an apostrophe in front: a spreadsheet would take it for a formula and run it.
std::string csv_cell(std::string_view text);

/// Does a column stand in the answer in brief?
enum class Brief {
    no,
    shown,
    ranks ///< shown; where not all rows have room, those with its largest numbers stay
};

/// A named result column: the key carries the unit in files ("slip_m"), heading and unit are what people read.
struct Column {
    std::string key;       ///< CSV header and JSON key, unit as suffix: "yield_acceleration_m_s2"
    std::string heading;   ///< terminal and report: "yield acceleration"
    std::string unit = {}; ///< "m/s²", "mm", "–"; empty for text columns
    int digits = 4;        ///< significant digits for people; files always carry the full double
    Brief brief = Brief::no;
    std::string brief_heading = {}; ///< in the answer in brief, where the heading is long; empty: the heading
};

/// The column as one of the answer in brief. @param heading  there; empty: its own
inline Column in_brief(Column column, std::string heading = {})
{
    column.brief = Brief::shown;
    column.brief_heading = std::move(heading);
    return column;
}

/// The same, and the rows with its largest numbers stay.
inline Column ranking(Column column, std::string heading = {})
{
    column = in_brief(std::move(column), std::move(heading));
    column.brief = Brief::ranks;
    return column;
}

/// Nothing (not defined here; printed as "–", null in JSON, empty in CSV), a number, a count, a word, yes/no.
using Cell = std::variant<std::monostate, double, std::int64_t, std::string, bool>;

/// The number in a unit; nothing where it is not finite.
inline Cell finite_cell(double x, double unit = 1.0)
{
    return std::isfinite(x) ? Cell(x / unit) : Cell();
}

/// The value; nothing for none.
template <class Value>
Cell optional_cell(const std::optional<Value>& value)
{
    return value ? Cell(*value) : Cell();
}

/// The number in a unit; nothing for none.
inline Cell optional_cell(const std::optional<double>& value, double unit)
{
    return value ? Cell(*value / unit) : Cell();
}

inline Cell count_cell(std::size_t n)
{
    return static_cast<std::int64_t>(n);
}

/// A value of any kind; nothing for an optional without one.
template <class Value>
Cell cell_of(Value&& value)
{
    using Plain = std::remove_cvref_t<Value>;
    if constexpr (std::is_same_v<Plain, Cell>)
        return std::forward<Value>(value);
    else if constexpr (std::is_convertible_v<Plain, std::string_view>)
        return std::string(std::forward<Value>(value));
    else if constexpr (std::is_integral_v<Plain> && !std::is_same_v<Plain, bool>)
        return static_cast<std::int64_t>(value);
    else if constexpr (requires { value.has_value(); })
        return value ? cell_of(*value) : Cell();
    else
        return value;
}

/// Results by name and unit; made by the modules' callers, rendered by pages/.
struct Table {
    std::string title;
    std::vector<Column> columns;
    std::vector<std::vector<Cell>> rows; ///< each of columns.size() cells
    std::vector<std::string> notes;      ///< sentences printed under the table
};

/// A column, and how an item's value in it is read.
template <class Item>
struct ColumnOf {
    Column column;
    std::function<Cell(const Item&)> value;

    /// @param get  a getter, or a member of the item
    template <class Get>
    ColumnOf(Column column, Get get)
        : column(std::move(column)), value([get](const Item& item) { return cell_of(std::invoke(get, item)); })
    {
    }

    /// @param get  of a number, or an optional one, in SI @param unit  of the column
    template <class Get>
    ColumnOf(Column column, Get get, double unit)
        : column(std::move(column)), value([get, unit](const Item& item) {
              return optional_cell(std::optional<double>(std::invoke(get, item)), unit);
          })
    {
    }
};

/// One row per item: the columns are written once, for terminal, report, CSV and JSON.
template <class Item, class Items>
Table table_of(std::string title, const std::vector<ColumnOf<Item>>& columns, Items&& items,
               std::vector<std::string> notes = {})
{
    Table table{std::move(title), {}, {}, std::move(notes)};
    for (const ColumnOf<Item>& c : columns) table.columns.push_back(c.column);
    for (const Item& item : items) {
        std::vector<Cell>& row = table.rows.emplace_back();
        for (const ColumnOf<Item>& c : columns) row.push_back(c.value(item));
    }
    return table;
}

} // namespace damslip
