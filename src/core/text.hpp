#pragma once

#include <string>
#include <string_view>

/// Texts of files and names on their way in and out.
namespace damslip {

bool is_utf8(std::string_view bytes);

/// The text itself where it is UTF-8; else its bytes taken as Latin-1, which old headers of records are written in.
std::string utf8_text(std::string bytes);

enum class LineEnds {
    kept,    ///< newline and tab stay: whole pages of text
    replaced ///< one line: a name, a title, a cell
};

/// For a terminal: control characters, with which a name could move the cursor, colour or hide text, as their pictures
/// (U+2400 ... U+2421: "␛"), those of U+0080 ... U+009F and those that turn the direction of writing as U+FFFD.
std::string visible(std::string_view text, LineEnds ends);

/// For text and double-quoted attributes of XML: visible() with & < > " as entities.
std::string xml_text(std::string_view text);

/// Bytes at the end of `text` that begin a character visible() would replace, but do not complete it: 0, 1 or 2.
std::size_t unfinished_bytes(std::string_view text);

} // namespace damslip
