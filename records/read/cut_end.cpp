#include "records/read/cut_end.hpp"

#include "core/number.hpp"
#include "records/read/header.hpp"

#include <algorithm>
#include <string>
#include <vector>

namespace damslip::records {

namespace {

constexpr std::size_t lines_before = 50, least_others = 3, whole_in_any_case = 4; // "-0.3"

/// How a number is written.
struct Written {
    std::string_view text;
    std::size_t begin = 0, end = 0; ///< columns of its line, from 0
    std::size_t decimals = 0;       ///< digits after the point
    std::size_t exponent_digits = 0;
};

bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

Written written(std::string_view text, std::size_t begin)
{
    Written w{text, begin, begin + text.size(), 0, 0};
    const std::size_t exponent = std::min(text.find_first_of("eEdD"), text.size());
    if (const std::size_t point = text.find('.'); point < exponent) w.decimals = exponent - point - 1;
    const std::string_view power = text.substr(exponent);
    w.exponent_digits = static_cast<std::size_t>(std::count_if(power.begin(), power.end(), is_digit));
    return w;
}

/// The numbers of a line, those that stick together ("1.2-5.6") apart.
std::vector<Written> numbers_of(std::string_view line)
{
    std::vector<Written> numbers;
    for (std::size_t at = 0; (at = line.find_first_of("+-.0123456789", at)) != std::string_view::npos;) {
        std::size_t used = 0;
        if (!parse_number(line.substr(at), &used) || used == 0) {
            ++at;
            continue;
        }
        numbers.push_back(written(line.substr(at, used), at));
        at += used;
    }
    return numbers;
}

/// Has every one of `others` a larger value of this? At least three are needed to say so.
template <class Value>
bool less_than_all(const Written& last, const std::vector<Written>& others, Value value)
{
    return others.size() >= least_others &&
           std::all_of(others.begin(), others.end(), [&](const Written& w) { return value(w) > value(last); });
}

/// Do all have the same value of this?
template <class Value>
bool all_same(const std::vector<Written>& numbers, Value value)
{
    return std::all_of(numbers.begin(), numbers.end(),
                       [&](const Written& w) { return value(w) == value(numbers.front()); });
}

} // namespace

std::string refuse_cut_end(const RecordText& text, std::size_t first_line)
{
    std::size_t last_line = text.lines.size();
    while (last_line >= first_line && last_line > 0 && trimmed(text.lines[last_line - 1]).empty()) --last_line;
    if (last_line < first_line || last_line == 0 || is_comment(text.lines[last_line - 1])) return "";
    const std::vector<Written> of_last_line = numbers_of(text.lines[last_line - 1]);
    if (of_last_line.empty()) return "";
    const Written& last = of_last_line.back();
    const std::size_t place = of_last_line.size() - 1;

    std::vector<Written> same_place; // in the lines before
    std::size_t width = of_last_line.size();
    const std::size_t from = last_line > first_line + lines_before ? last_line - lines_before : first_line;
    std::vector<Written> all(of_last_line.begin(), of_last_line.end() - 1);
    for (std::size_t line = from; line < last_line; ++line) {
        if (is_comment(text.lines[line - 1])) continue;
        const std::vector<Written> numbers = numbers_of(text.lines[line - 1]);
        if (numbers.size() > place) same_place.push_back(numbers[place]);
        width = std::max(width, numbers.size());
        all.insert(all.end(), numbers.begin(), numbers.end());
    }
    // A column of its own has its own way of writing (time beside acceleration); numbers in reading order have one.
    const bool columns = width == of_last_line.size() && same_place.size() >= least_others;
    const std::vector<Written>& others = columns ? same_place : all;

    const auto exponent = [](const Written& w) { return w.exponent_digits; };
    const auto decimals = [](const Written& w) { return w.decimals; };
    const auto end = [](const Written& w) { return w.end; };
    const bool open_end = !text.last_line_ended && last_line == text.lines.size();
    const bool one_form = last.exponent_digits > 0 && all_same(others, exponent);
    const bool cut_exponent = less_than_all(last, others, exponent) && (open_end || one_form);
    const bool cut_decimals =
        open_end && less_than_all(last, others, decimals) && all_same(others, decimals) && decimals(others.front()) > 1;
    const bool cut_column = open_end && less_than_all(last, same_place, end) && all_same(same_place, end);
    if (!cut_exponent && !cut_decimals && !cut_column) {
        const auto as_last = [&](auto value) {
            return all_same(others, value) && value(others.front()) == value(last);
        };
        const bool whole = others.size() >= least_others && as_last(decimals) && as_last(exponent);
        // Cut short, a number loses its exponent first.
        const auto as_long_power = [&](const Written& w) {
            return w.exponent_digits == 0 || exponent(w) == exponent(last);
        };
        const bool whole_power = last.exponent_digits > 0 && std::all_of(others.begin(), others.end(), as_long_power) &&
                                 std::any_of(others.begin(), others.end(), exponent);
        const bool short_enough = last.text.size() <= whole_in_any_case;
        if (!open_end || whole || whole_power || short_enough) return "";
        return "the file does not end with a line end: its last number, " + std::string(last.text) +
               ", may have been cut";
    }
    refuse(text, {last_line, last.begin + 1},
           "the last number, " + in_quotes(last.text) + ", is shorter than all before it: the file looks cut here.",
           cut_exponent ? "an exponent of as many digits as the others have" : "as many digits as the others have",
           "get the file anew from its source; if the number is right, write it as long as the others");
}

} // namespace damslip::records
