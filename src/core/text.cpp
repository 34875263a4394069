#include "core/text.hpp"

#include <charconv>
#include <cmath>
#include <fmt/format.h>

namespace damslip {

namespace {

/// Bytes of the UTF-8 character that `s` begins with; 0: none, or a longer form than needed, or half of a pair.
std::size_t character_length(std::string_view s)
{
    const auto byte = [&](std::size_t k) { return k < s.size() ? static_cast<unsigned char>(s[k]) : 0u; };
    const unsigned first = byte(0);
    if (first < 0x80) return 1;
    const std::size_t length = first >= 0xC2 && first <= 0xDF   ? 2
                               : first >= 0xE0 && first <= 0xEF ? 3
                               : first >= 0xF0 && first <= 0xF4 ? 4
                                                                : 0;
    for (std::size_t k = 1; k < length; ++k)
        if ((byte(k) & 0xC0u) != 0x80u) return 0;
    const unsigned second = byte(1);
    if ((first == 0xE0 && second < 0xA0) || (first == 0xED && second > 0x9F) || (first == 0xF0 && second < 0x90) ||
        (first == 0xF4 && second > 0x8F))
        return 0;
    return length;
}

} // namespace

bool is_utf8(std::string_view bytes)
{
    while (!bytes.empty()) {
        const std::size_t length = character_length(bytes);
        if (length == 0) return false;
        bytes.remove_prefix(length);
    }
    return true;
}

std::string utf8_text(std::string bytes)
{
    if (is_utf8(bytes)) return bytes;
    std::string text;
    for (const char c : bytes) {
        const auto code = static_cast<unsigned char>(c);
        if (code >= 0x80) text += static_cast<char>(0xC0 | code >> 6);
        text += code >= 0x80 ? static_cast<char>(0x80 | (code & 0x3F)) : c;
    }
    return text;
}

namespace {

/// Length of the character of C1 or of a change of direction that starts here; 0: none does.
std::size_t hidden_character(std::string_view s)
{
    const auto byte = [&](std::size_t k) { return k < s.size() ? static_cast<unsigned char>(s[k]) : 0u; };
    if (byte(0) == 0xC2) return byte(1) >= 0x80 && byte(1) <= 0x9F ? 2 : 0;
    if (byte(0) != 0xE2) return 0;
    const bool embedding = byte(1) == 0x80 && byte(2) >= 0xAA && byte(2) <= 0xAE; // U+202A ... U+202E
    const bool isolate = byte(1) == 0x81 && byte(2) >= 0xA6 && byte(2) <= 0xA9;   // U+2066 ... U+2069
    return embedding || isolate ? 3 : 0;
}

} // namespace

std::string visible(std::string_view text, LineEnds ends)
{
    std::string out;
    out.reserve(text.size());
    for (std::size_t k = 0; k < text.size(); ++k) {
        const auto c = static_cast<unsigned char>(text[k]);
        if (const std::size_t length = hidden_character(text.substr(k)); length > 0) {
            out += "\uFFFD";
            k += length - 1;
        } else if (c == 0x7F) {
            out += "\u2421";
        } else if (c >= 0x20 || (ends == LineEnds::kept && (c == '\n' || c == '\t'))) {
            out += text[k];
        } else { // U+2400 + c
            out += "\xE2\x90";
            out += static_cast<char>(0x80 + c);
        }
    }
    return out;
}

std::string xml_text(std::string_view text)
{
    std::string out;
    for (const char c : visible(text, LineEnds::kept)) {
        if (c == '&')
            out += "&amp;";
        else if (c == '<')
            out += "&lt;";
        else if (c == '>')
            out += "&gt;";
        else if (c == '"')
            out += "&quot;";
        else
            out += c;
    }
    return out;
}

std::size_t unfinished_bytes(std::string_view text)
{
    if (text.ends_with("\xC2") || text.ends_with("\xE2")) return 1;
    return text.ends_with("\xE2\x80") || text.ends_with("\xE2\x81") ? 2 : 0;
}

namespace {
bool blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r';
}
} // namespace

std::optional<double> parse_number(std::string_view text, std::size_t* used)
{
    std::size_t at = 0;
    while (at < text.size() && blank(text[at])) ++at;
    if (at < text.size() && text[at] == '+') {
        ++at;
        if (at < text.size() && (text[at] == '-' || text[at] == '+')) return std::nullopt;
    }
    const std::string_view body = text.substr(at);
    const std::size_t digits_from = !body.empty() && body[0] == '-' ? 1 : 0;
    if (digits_from >= body.size() ||
        !(body[digits_from] == '.' || (body[digits_from] >= '0' && body[digits_from] <= '9')))
        return std::nullopt;

    double value = 0.0;
    auto [end, error] = std::from_chars(body.data(), body.data() + body.size(), value);
    auto length = static_cast<std::size_t>(end - body.data());
    if (error == std::errc::result_out_of_range) {
        // Underflow reads as zero, overflow is no number.
        const std::string_view token = body.substr(0, length);
        const std::size_t e = token.find_first_of("eE");
        if (e == std::string_view::npos || e + 1 >= token.size() || token[e + 1] != '-') return std::nullopt;
        value = 0.0;
    } else if (error != std::errc{}) {
        return std::nullopt;
    }
    if (length < body.size() && (body[length] == 'D' || body[length] == 'd')) { // Fortran double exponent
        std::size_t e = length + 1;
        if (e < body.size() && (body[e] == '+' || body[e] == '-')) ++e;
        const std::size_t exponent_from = e;
        while (e < body.size() && body[e] >= '0' && body[e] <= '9') ++e;
        if (e > exponent_from) {
            if (e > 64) return std::nullopt;
            std::string copy(body.substr(0, e));
            copy[length] = 'E';
            std::size_t inner = 0;
            const auto with_exponent = parse_number(copy, &inner);
            if (!with_exponent) return std::nullopt;
            value = *with_exponent;
            length = e;
        }
    }
    if (!std::isfinite(value)) return std::nullopt;
    if (used) *used = at + length;
    return value;
}

std::optional<double> parse_whole_number_text(std::string_view text)
{
    std::size_t used = 0;
    const auto value = parse_number(text, &used);
    if (!value) return std::nullopt;
    while (used < text.size() && blank(text[used])) ++used;
    return used == text.size() ? value : std::nullopt;
}

std::string shortest(double value)
{
    std::string text;
    append_shortest(text, value);
    return text;
}

std::string factor_text(double factor)
{
    return std::isinf(factor) && factor > 0.0 ? "∞ (no thrust)" : fmt::format("{:.3g}", factor);
}

} // namespace damslip
