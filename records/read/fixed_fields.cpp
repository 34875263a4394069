#include "records/read/fixed_fields.hpp"

#include "core/number.hpp"
#include "records/read/samples.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace damslip::records {

namespace {

bool digit(char c)
{
    return c >= '0' && c <= '9';
}

/// Whole number of at most 3 digits at `at`, which moves behind it.
std::optional<std::size_t> small_number(std::string_view s, std::size_t& at)
{
    std::size_t value = 0, begin = at;
    for (; at < s.size() && digit(s[at]) && at < begin + 3; ++at)
        value = 10 * value + static_cast<std::size_t>(s[at] - '0');
    if (at == begin) return std::nullopt;
    return value;
}

/// A format that starts behind the bracket at `at`.
std::optional<FieldFormat> format_at(std::string_view s, std::size_t at)
{
    const auto count = small_number(s, at);
    if (!count) return std::nullopt;
    if (at < s.size() && s[at] == '(') ++at;
    if (s.substr(at).starts_with("1p")) at += 2; // a scale factor for printing
    if (at >= s.size() || std::string_view("ifeg").find(s[at]) == std::string_view::npos) return std::nullopt;
    const auto width = small_number(s, ++at);
    if (!width || *count < 1 || *count > 100 || *width < 1 || *width > 60) return std::nullopt;
    return FieldFormat{*count, *width};
}

} // namespace

std::optional<FieldFormat> field_format(std::string_view line)
{
    std::optional<FieldFormat> found;
    const std::string s = lower(line.substr(0, 200));
    for (std::size_t at = 0; (at = s.find('(', at)) != std::string::npos;)
        if (const auto format = format_at(s, ++at)) found = format;
    return found;
}

std::optional<FieldFormat> format_of_length(std::string_view line, std::size_t per_line)
{
    while (!line.empty() && (line.back() == ' ' || line.back() == '\t')) line.remove_suffix(1);
    if (line.size() % per_line != 0 || line.size() / per_line < 5 || line.size() / per_line > 25) return std::nullopt;
    return FieldFormat{per_line, line.size() / per_line};
}

Place place_of(const FieldFormat& format, std::size_t first, std::size_t k)
{
    return {first + k / format.per_line, 1 + k % format.per_line * format.width};
}

bool has_words(std::string_view line)
{
    return std::any_of(line.begin(), line.end(), [](char c) {
        const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
        return letter && std::string_view("eEdD").find(c) == std::string_view::npos;
    });
}

std::vector<double> read_fields(const RecordText& text, std::size_t first, std::size_t count, const FieldFormat& format)
{
    std::vector<double> values;
    values.reserve(std::min(count, 20 * text.lines.size()));
    for (std::size_t line = first; line <= text.lines.size() && values.size() < count; ++line) {
        const std::string_view s = text.lines[line - 1];
        const std::string word = lower(trimmed(s).substr(0, 4));
        if (word.starts_with('/')) break; // "/&" ends a channel
        if (has_words(s) && !contains(word, "nan") && !contains(word, "inf")) break;
        for (std::size_t k = 0; k < format.per_line && values.size() < count; ++k) {
            const std::size_t at = std::min(k * format.width, s.size());
            const std::string_view field = s.substr(at, format.width);
            if (trimmed(field).empty() && trimmed(s.substr(at)).empty()) {
                if (k == 0 || line == text.lines.size() || values.size() + format.per_line > count) return values;
                // A line that ends early in the middle of the block: the next one must not follow unnoticed.
                const std::string_view next = text.lines[line];
                if (has_words(next) || trimmed(next).empty()) return values;
            }
            std::size_t used = 0;
            const Place place{line, at + 1};
            const double value = number_at(text, field, place, used);
            if (!trimmed(field.substr(used)).empty())
                refuse(text, place, in_quotes(field) + " is not one number.",
                       std::to_string(format.per_line) + " fields of " + std::to_string(format.width) +
                           " characters a line",
                       "check that the line was not changed: these fields are read by their columns");
            const bool ends_file = line == text.lines.size() && at + field.size() == s.size();
            if (ends_file && !text.last_line_ended && field.size() < format.width)
                refuse(text, place,
                       fmt::format("the last number, {}, ends in the middle of its field.", in_quotes(trimmed(field))),
                       std::to_string(format.width) + " characters", "the file looks cut: get it anew from its source");
            values.push_back(value);
        }
    }
    return values;
}

std::size_t line_after(const FieldFormat& format, std::size_t first, std::size_t count)
{
    return first + (count + format.per_line - 1) / format.per_line;
}

} // namespace damslip::records
