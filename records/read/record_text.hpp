#pragma once

#include <cstddef>
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

} // namespace damslip::records
