#pragma once

#include "core/csv.hpp"

#include <string>
#include <vector>

namespace damslip::pages {

/// Characters as a terminal counts them: UTF-8 continuation bytes take no place.
std::size_t text_width(const std::string& s);

/// One value for people: significant digits, "–" for nothing, "yes" and "no".
std::string cell_text(const Cell& cell, int digits);

/// A number or nothing: right-aligned.
bool is_number(const Cell& cell);

/// A sentence in lines of at most 110 characters, each after the indent.
std::string broken_lines(const std::string& sentence, const std::string& indent);

/// For a terminal: title, aligned columns with a unit line, notes. Numbers right-aligned with the column's digits; "–" for nothing.
/// Columns beyond 110 characters follow below, each part with the first column (and the polarity beside it) again; the
/// verdict is in the first part.
std::string text(const Table& table);

/// With the verdict behind the first `names` columns, where it is seen first.
Table verdict_after(Table table, std::size_t names);

/// Slips that files hold in metres, in millimetres: one unit for one quantity where people read.
Table with_slips_in_millimetres(Table table);

/// Several, an empty line between them.
std::string texts(const std::vector<Table>& tables);

/// The same turned by a quarter, for tables of many quantities and few rows: one line per column with its unit, one column per row,
/// in parts of at most 110 characters; a rule below the first `labels` lines.
std::string text_by_columns(const Table& table, std::size_t labels);

/// Header row of keys, one row per line, numbers as shortest exact text, RFC 4180 quoting; `comments` become "# ..." lines on top.
/// Text that begins with = + - @ gets an apostrophe in front, so that a spreadsheet does not take it for a formula;
/// control characters are shown as their pictures. Numbers stay as they are.
std::string csv(const Table& table, const std::vector<std::string>& comments = {});

/// Comments and the header row of csv().
std::string csv_head(const std::vector<Column>& columns, const std::vector<std::string>& comments = {});

/// The rows of csv() one by one. A value that stands in the row above, or beside it, is not written anew but copied.
class CsvLines {
public:
    /// @param row  of as many cells each time  @param out  its line comes at the end
    void add(const std::vector<Cell>& row, std::string& out);

private:
    struct Field {
        Cell cell;
        std::string text;
    };
    std::vector<Field> last_; ///< of each column, where it had a value
};

} // namespace damslip::pages
