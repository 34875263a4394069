#pragma once

#include "records/record.hpp"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace damslip::records {

/// A file's content as lines, without byte-order mark and line ends (LF, CRLF or CR). Views into the content.
struct RecordText {
    std::string_view file_name;
    std::vector<std::string_view> lines;
    bool last_line_ended = true; ///< by a line end: a file that was cut mostly has none
};

/// Place in a RecordText, both from 1; 0: the line or the file as a whole.
struct Place {
    std::size_t line = 0;
    std::size_t column = 0;
};

/// @throws InputError for content that is no text: empty, UTF-16, NUL bytes, compressed, or more than 6 million lines.
RecordText split_lines(std::string_view content, std::string_view file_name);

/// Throws InputError{file:line:column: problem, expected, fix}.
[[noreturn]] void refuse(const RecordText& text, Place place, std::string problem, std::string expected,
                         std::string fix);

std::string_view trimmed(std::string_view s); ///< without blanks and tabs at both ends
std::string lower(std::string_view s);        ///< ASCII letters only
std::string printable(std::string_view s);    ///< control characters and bytes that are not UTF-8 become '?'
std::string in_quotes(std::string_view s);    ///< "'...'", at most 40 printable characters, for messages
bool contains(std::string_view s, std::string_view part);

/// A file that was cut within its last number still holds a number, and a count that fits: "4.8E-17" becomes "4.8E-1",
/// "-0.01234" becomes "-0.01". Signs of it, from the 50 lines before the end: the exponent has fewer digits than all
/// others have; and, where the file does not end with a line end, fewer decimals than all others have, or an end before
/// the column in which this number of all lines before ends. Files whose numbers differ in length and that have no last
/// line end leave it open: that is a remark.
/// @param first_line  of the numbers
/// @returns the remark; empty where the number is whole
/// @throws InputError at the last number
std::string refuse_cut_end(const RecordText& text, std::size_t first_line);

/// What to do with a time column of unequal steps (more than 1e-3 of the mean step apart from it).
enum class UnevenTime {
    refuse,
    resample ///< linear interpolation at `ReadOptions::dt`, or at the smallest step of the file
};

/// What the file may leave unsaid. A value that contradicts the file is an error that names both.
struct ReadOptions {
    std::string unit; ///< of files that do not say: "g", "m/s2", "cm/s2", "gal", "mg", "mm/s2"; empty: the file says
    std::optional<double> dt; ///< of files without one [s], 1e-6 ... 1
    UnevenTime uneven = UnevenTime::refuse;
    std::string column; ///< heading, or number from 1, of the acceleration column where a file holds several; empty:
                        ///< the only one
    bool survey =
        false; ///< only what the file holds is asked: where nobody says unit or step, 1 m/s2 and 0.01 s stand for them
};

/// One accelerogram from a file, recognised by its content, never by its name. Formats: docs/records.md.
/// @throws InputError naming file, line and column, what is there, what is allowed and what to do. Nothing is guessed:
/// not the unit, not the time step, not which of several columns.
Record read_record(const std::filesystem::path& path, const ReadOptions& options = {});

/// The accelerograms of a file's content, one per acceleration column (or the one that `options.column` names).
/// @param file_name  for messages and provenance
/// Every record returned has dt in 1e-6 ... 1 s and 2 ... 5 million finite samples of at most 1e4 m/s^2.
std::vector<Record> parse_record(std::string_view content, std::string_view file_name, const ReadOptions& options = {});

/// A file format: how its content is known and how it is read. To add one: docs/recipes.md.
struct RecordFormat {
    std::string_view name;
    bool (*recognises)(const RecordText& text);
    std::vector<Record> (*read)(const RecordText& text,
                                const ReadOptions& options); ///< null: known by sight, not read yet
};

/// All formats, in the order they are tried; plain columns come last.
std::span<const RecordFormat> record_formats();

} // namespace damslip::records
