#pragma once

#include <algorithm>
#include <array>
#include <charconv>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

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

/// A finite decimal number at the start of `text`, locale-free: leading blanks and `+` skipped, Fortran `D` exponents
/// read as `E`.
/// @param used  characters consumed, blanks included; untouched when nothing is found.
/// @returns nothing for no number, NaN, infinity, overflow or `****`.
std::optional<double> parse_number(std::string_view text, std::size_t* used = nullptr);

/// The whole of `text`, blanks around it allowed, as one finite number.
std::optional<double> parse_whole_number_text(std::string_view text);

/// Shortest text that reads back as the same double ("0.1", "1e-05"); "nan" and "inf" as such.
std::string shortest(double value);

/// A factor of safety in a sentence: three digits; "∞ (no thrust)" where nothing drives.
std::string factor_text(double factor);

/// shortest(value) at the end of a text that is made of many numbers.
inline void append_shortest(std::string& text, double value)
{
    std::array<char, 32> buffer;
    const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
    text.append(buffer.data(), end);
}

/// The word that a list of all values has beside this one.
template <class Value>
const char* word_in(Value value, std::initializer_list<std::pair<std::type_identity_t<Value>, const char*>> words)
{
    const auto at = std::find_if(words.begin(), words.end(), [&](const auto& each) { return each.first == value; });
    return at == words.end() ? "" : at->second;
}

} // namespace damslip
