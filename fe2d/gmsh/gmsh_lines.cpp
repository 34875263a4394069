#include "fe2d/gmsh/gmsh_lines.hpp"

#include "core/input_error.hpp"
#include "core/number.hpp"

#include <fmt/format.h>

#include <charconv>

namespace damslip::fe2d {

namespace {

constexpr std::string_view blanks = " \t\r\v\f";
constexpr std::size_t shown = 60; ///< characters of the file in a message

std::string_view trimmed(std::string_view text)
{
    const std::size_t from = text.find_first_not_of(blanks);
    if (from == std::string_view::npos) return {};
    return text.substr(from, text.find_last_not_of(blanks) - from + 1);
}

/// What the file has, as far as a terminal can show it.
std::string printable(std::string_view text)
{
    std::string out;
    for (const char c : text.substr(0, shown)) out += c < ' ' || c > '~' ? '?' : c;
    return text.size() > shown ? out + "..." : out;
}

} // namespace

bool GmshLines::next()
{
    while (!rest_.empty()) {
        const std::size_t end = rest_.find('\n');
        line_ = trimmed(rest_.substr(0, end));
        rest_ = end == std::string_view::npos ? std::string_view{} : rest_.substr(end + 1);
        ++number_;
        if (!line_.empty()) return true;
    }
    return false;
}

void GmshLines::need(const std::string& section)
{
    if (!next())
        refuse("the file ends inside $" + section + ".", "a line $End" + section + " after as many lines as announced",
               "the file looks cut: write it again");
}

void GmshLines::refuse(std::string problem, std::string expected, std::string fix) const
{
    throw InputError(Diagnostic{.file = file_,
                                .line = number_,
                                .column = 0,
                                .problem = std::move(problem),
                                .expected = std::move(expected),
                                .fix = std::move(fix)});
}

std::string_view GmshWords::word(const char* what)
{
    const std::size_t from = rest_.find_first_not_of(blanks);
    if (from == std::string_view::npos)
        lines_.refuse(fmt::format("{} is missing: the line \"{}\" ends too early.", what, printable(lines_.line())),
                      what, "write the mesh again with Gmsh, or complete the line");
    const std::size_t end = rest_.find_first_of(blanks, from);
    const std::string_view word = rest_.substr(from, end == std::string_view::npos ? end : end - from);
    rest_ = end == std::string_view::npos ? std::string_view{} : rest_.substr(end);
    return word;
}

std::int64_t GmshWords::whole(const char* what, std::int64_t low, std::int64_t high)
{
    const std::string_view text = word(what);
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || value < low || value > high)
        lines_.refuse(fmt::format("{} = {} is not allowed.", what, printable(text)),
                      fmt::format("a whole number {} ... {}", low, high),
                      "write the mesh again, or correct the number");
    return value;
}

double GmshWords::number(const char* what)
{
    const std::string_view text = word(what);
    const auto value = parse_whole_number_text(text);
    if (!value)
        lines_.refuse(fmt::format("{} = {} is not allowed.", what, printable(text)), "a finite number",
                      "write the mesh again, or correct the number");
    return *value;
}

std::string GmshWords::quoted(const char* what)
{
    const std::string_view text = trimmed(rest_);
    if (text.size() < 2 || text.front() != '"' || text.back() != '"' || text.find('"', 1) != text.size() - 1)
        lines_.refuse(fmt::format("{} = {} is not allowed.", what, printable(text)), "a text in double quotes",
                      "for example  2 1 \"dam\"");
    rest_ = {};
    return std::string(text.substr(1, text.size() - 2));
}

void GmshWords::end() const
{
    if (const std::string_view text = trimmed(rest_); !text.empty())
        lines_.refuse(fmt::format("\"{}\" is too much in the line \"{}\".", printable(text), printable(lines_.line())),
                      "no more entries on this line", "write the mesh again, or delete what is too much");
}

} // namespace damslip::fe2d
