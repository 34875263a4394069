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

/// A table of commas: a heading, then rows; blanks around a cell do not count, nor do empty lines and those that start with "#". Cells hold
/// no commas and no quotes.
struct CsvTable {
    CsvLine heading; ///< without cells: the text has no line
    std::vector<CsvLine> rows;
};

CsvTable parse_csv(std::string_view text);

} // namespace damslip
