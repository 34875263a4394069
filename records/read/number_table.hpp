#pragma once

#include "records/read/record_text.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace damslip::records {

/// How the numbers of a file are set apart.
struct Dialect {
    char separator = ' ';       ///< ',' or ';'; ' ' stands for any blanks and tabs
    bool decimal_comma = false; ///< "1,5" is 1.5
};

/// The numbers of a text file, comment lines (# or %) and blank lines left out, and the words above them.
struct NumberTable {
    Dialect dialect;
    std::vector<double> values;          ///< row after row
    std::vector<std::size_t> row_begin;  ///< index of the first value of each row; one more at the end
    std::vector<std::uint32_t> row_line; ///< line of each row, from 1
    std::vector<std::string> headings;   ///< fields of the heading line above the numbers; empty: none
    std::size_t heading_line = 0;
    bool heading_is_separated = false;      ///< by commas, semicolons or tabs: no sentence looks like that
    std::vector<std::size_t> skipped_lines; ///< other lines above the numbers
    std::string open_end;                   ///< remark of refuse_cut_end()

    std::size_t rows() const { return row_line.size(); }
    std::size_t width(std::size_t row) const { return row_begin[row + 1] - row_begin[row]; }
    Place place(std::size_t row, std::size_t field, const RecordText& text) const; ///< where a value stands
    void drop_first_rows(std::size_t count);
};

/// The file has a line of numbers among its first 60.
bool has_numbers(const RecordText& text);

/// Words are allowed above the numbers only, and a few lines of numbers among them; a heading line has as many fields as the rows below it
/// (a line of their units may follow it). Numbers with a decimal point may touch where a sign shows it ("1.5E-01-2.0E-01").
/// @throws InputError: nothing but numbers below the first row; commas that may be decimal or not; more than 5 million
/// rows' worth.
NumberTable read_number_table(const RecordText& text);

/// Fields of a line, blanks trimmed and double quotes taken off; one separator at the end of the line is ignored.
std::vector<std::string_view> fields_of(std::string_view line, const Dialect& dialect);
void fields_of(std::string_view line, const Dialect& dialect,
               std::vector<std::string_view>& fields); ///< the same into `fields`

/// The fields of a line that may be the heading of `width` columns, a unit in brackets being part of its name; empty: it has another number.
/// @param separated  set where commas, semicolons or tabs separate them
std::vector<std::string> heading_fields(std::string_view line, char separator, std::size_t width, bool& separated);

} // namespace damslip::records
