#pragma once

#include <string>
#include <string_view>
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

} // namespace damslip
