#pragma once

#include <string>
#include <string_view>

namespace damslip::pages {

/// For text and double-quoted attributes of HTML and SVG: & < > " ' as entities, control characters other than tab and
/// newline left out.
std::string html_text(std::string_view text);

/// A JSON string, quoted; "<" as \u003c so that no text can end a <script>; bytes that are not UTF-8 as U+FFFD.
std::string json_text(std::string_view text);

enum class LineEnds {
    kept,    ///< newline and tab stay: whole pages of text
    replaced ///< one line: a name, a title, a cell
};

/// For a terminal: control characters, with which a name could move the cursor, colour or hide text, as their pictures
/// (U+2400 ... U+2421: "␛"), those of U+0080 ... U+009F and those that turn the direction of writing as U+FFFD.
std::string visible(std::string_view text, LineEnds ends);

/// Bytes at the end of `text` that begin a character visible() would replace, but do not complete it: 0, 1 or 2.
std::size_t unfinished_bytes(std::string_view text);

} // namespace damslip::pages
