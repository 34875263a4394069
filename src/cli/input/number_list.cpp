#include "cli/input/number_list.hpp"

#include "core/number.hpp"
#include "core/usage_error.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace damslip::cli {

namespace {

std::vector<std::string> split(const std::string& text, char separator)
{
    std::vector<std::string> parts{""};
    for (const char c : text)
        if (c == separator)
            parts.emplace_back();
        else
            parts.back() += c;
    return parts;
}

[[noreturn]] void fail(const std::string& flag, const std::string& text, const std::string& why)
{
    throw UsageError(
        Diagnostic{"", 0, 0, fmt::format("{} {}: {}", flag, text, why),
                   "numbers with a decimal point, 1.00,0.84,0.77, or a range first:last:step 0.65:1.0:0.05",
                   fmt::format("for example  {} 0.65:1.0:0.05", flag)});
}

void append_range(const std::vector<std::string>& parts, const std::string& flag, const std::string& text,
                  std::vector<double>& out)
{
    const auto first = parse_whole_number_text(parts[0]), last = parse_whole_number_text(parts[1]),
               step = parse_whole_number_text(parts[2]);
    if (!first || !last || !step) fail(flag, text, "a range needs three numbers.");
    if (*step == 0.0 || (*last - *first) / *step < 0.0) fail(flag, text, "the step does not lead from first to last.");
    const double count = std::floor((*last - *first) / *step + 1e-9) + 1.0;
    if (count > 1e5) fail(flag, text, "more than 100 000 values.");
    const double decimals = std::pow(10.0, 12.0); // 0.65 + 3 * 0.05 reads 0.8, not 0.8000000000000002
    for (double i = 0; i < count; ++i) {
        const double value = *first + i * *step;
        out.push_back(std::abs(value) < 1e3 ? std::round(value * decimals) / decimals : value);
    }
}

} // namespace

std::vector<double> number_list(const std::string& text, const std::string& flag)
{
    std::vector<double> values;
    for (const std::string& item : split(text, ',')) {
        const std::vector<std::string> parts = split(item, ':');
        if (parts.size() == 3) {
            append_range(parts, flag, text, values);
        } else if (const auto value = parts.size() == 1 ? parse_whole_number_text(item) : std::nullopt) {
            values.push_back(*value);
        } else {
            fail(flag, text, fmt::format("\"{}\" is not a number.", item));
        }
    }
    return values;
}

std::optional<double> decimal_comma(const std::string& text)
{
    const std::size_t comma = text.find(',');
    if (comma == std::string::npos || comma == 0 || comma + 1 == text.size()) return std::nullopt;
    if (text.find_first_not_of("0123456789", comma + 1) != std::string::npos) return std::nullopt;
    if (text.find_first_not_of("0123456789") != comma) return std::nullopt;
    return parse_whole_number_text(text.substr(0, comma) + "." + text.substr(comma + 1));
}

std::vector<std::string> word_list(const std::string& text, const std::string& flag,
                                   const std::vector<std::string>& allowed)
{
    std::vector<std::string> words = split(text, ',');
    for (const std::string& word : words) {
        if (!word.empty() && (allowed.empty() || std::find(allowed.begin(), allowed.end(), word) != allowed.end()))
            continue;
        const std::string_view near = nearest(word, allowed);
        throw UsageError(
            Diagnostic{"", 0, 0,
                       fmt::format("{} {}: \"{}\" is not known.{}", flag, text, word,
                                   near.empty() ? "" : fmt::format(" Did you mean {}?", near)),
                       fmt::format("{}", fmt::join(allowed, ", ")),
                       fmt::format("for example  {} {}", flag, allowed.empty() ? "a,b" : allowed.front())});
    }
    return words;
}

} // namespace damslip::cli
