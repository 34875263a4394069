#pragma once

#include "records/read/read_record.hpp"

#include <cstdint>
#include <functional>
#include <span>
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

/// Largest relative deviation of a step from the mean step that still counts as even.
inline constexpr double even_tolerance = 1e-3;

/// At least 3 values, each larger than the one before: no accelerogram does so.
bool is_rising(std::span<const double> values);

/// Times that stand in a file.
struct TimeColumn {
    std::span<const double> time;              ///< [s]
    std::size_t digits = 0;                    ///< most significant digits that one of them is printed with
    std::function<Place(std::size_t k)> place; ///< of time k
};

/// Digits of a printed number from its first that is not zero to its last, exponent left out: 3 of "0.0120".
std::size_t significant_digits(std::string_view number);

/// The uniform step of these times. They are even where all steps are equal within even_tolerance, and where all times are t_0 + k dt within
/// the rounding of their printed digits or of single precision; `stated` (file or user) is kept when it agrees within 1e-4, or within that
/// rounding.
/// @throws InputError: not rising, uneven (unless options.uneven is resample: then nothing is returned), with a few steps of none or of two and
/// more among equal ones (a line that stands twice or is missing), rounded so that the step stays open by more than even_tolerance, or not the
/// stated step.
std::optional<double> step_of(const RecordText& text, const TimeColumn& column, std::optional<double> stated,
                              const ReadOptions& options);

/// Samples that stand beside their times at equal steps: as they are, or interpolated linearly at multiples of the stated step, else of the
/// smallest. @param stated  file or user @param dt  the step [s] @param warnings  what was interpolated
/// @throws InputError as step_of(), and when more than max_samples result
std::vector<double> at_even_times(const RecordText& text, const TimeColumn& column, std::vector<double> accel,
                                  std::optional<double> stated, const ReadOptions& options, double& dt,
                                  std::vector<std::string>& warnings);

} // namespace damslip::records
