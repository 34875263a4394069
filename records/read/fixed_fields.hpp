#pragma once

#include "records/read/record_text.hpp"

#include <optional>
#include <vector>

/// Numbers in columns of fixed width, as Fortran programs write them: neighbours may touch, so blanks do not separate.
namespace damslip::records {

/// "(8F10.5)": 8 fields of 10 characters a line. "(10I8)", "(5E15.7)" and "(8(1PE10.4E1))" likewise.
struct FieldFormat {
    std::size_t per_line = 8; ///< 1 ... 100
    std::size_t width = 10;   ///< [characters] 1 ... 60
};

/// The last such format a line names; nothing for none.
std::optional<FieldFormat> field_format(std::string_view line);

/// The width of `per_line` fields from the length of a full line; nothing where it is no multiple.
std::optional<FieldFormat> format_of_length(std::string_view line, std::size_t per_line);

/// Where field k of a block stands whose first line is `first` (from 1).
Place place_of(const FieldFormat& format, std::size_t first, std::size_t k);

/// Up to `count` numbers from line `first` on. Stops early, without an error, at the end of the file, at a line of
/// words and at the blank rest of a line: the caller knows what a smaller number means.
/// @throws InputError for a blank field before a filled one and for what is no number in a line of numbers.
std::vector<double> read_fields(const RecordText& text, std::size_t first, std::size_t count,
                                const FieldFormat& format);

/// Line after a block of `count` fields.
std::size_t line_after(const FieldFormat& format, std::size_t first, std::size_t count);

/// The line has a letter that no number has (other than E and D, which stand in exponents).
bool has_words(std::string_view line);

} // namespace damslip::records
