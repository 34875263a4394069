#include "core/number.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <fmt/format.h>

namespace damslip {

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
    std::array<char, 32> buffer;
    const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
    return {buffer.data(), end};
}

std::string factor_text(double factor)
{
    return std::isinf(factor) && factor > 0.0 ? "∞ (no thrust)" : fmt::format("{:.3g}", factor);
}

} // namespace damslip
