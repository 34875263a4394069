#include "records/read/read_record.hpp"

#include "core/file.hpp"
#include "core/input_error.hpp"
#include "core/text.hpp"
#include "records/read/header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

namespace damslip::records {

namespace {

constexpr std::size_t most_lines = 6'000'000;

/// SMC files may have NUL bytes in the station code, within their 11 text lines.
bool smc_with_nul_in_text(std::string_view content)
{
    const std::size_t last = content.rfind('\0');
    const auto lines_before = std::count(content.begin(), content.begin() + static_cast<std::ptrdiff_t>(last), '\n');
    return contains(content.substr(0, content.find('\n')), "CORRECTED ACCELEROGRAM") && lines_before < 11;
}

void refuse_what_is_no_text(std::string_view content, const RecordText& text)
{
    const auto fail = [&](std::string problem, std::string fix) {
        refuse(text, {}, std::move(problem), "an accelerogram as text: PEER AT2, CSV, two columns or one column",
               std::move(fix));
    };
    if (content.starts_with("PK\x03\x04") || content.starts_with("\x1f\x8b"))
        fail("this is a compressed file.", "unpack it and name the file inside");
    if (content.starts_with("\xff\xfe") || content.starts_with("\xfe\xff"))
        fail("this is UTF-16 text.", "save it as plain or UTF-8 text");
    if (content.find('\0') != std::string_view::npos && !smc_with_nul_in_text(content))
        fail("the file holds NUL bytes: it is binary, not text.", "export the record as text");
    if (content.find_first_not_of(" \t\r\n") == std::string_view::npos)
        fail("the file is empty.", "check that it was downloaded completely");
}

} // namespace

RecordText split_lines(std::string_view content, std::string_view file_name)
{
    RecordText text{file_name, {}, true};
    if (content.starts_with("\xef\xbb\xbf")) content.remove_prefix(3);
    // Programs of DOS end a file with Ctrl-Z and fill its last block with NUL bytes.
    while (content.size() > 1 && (content.back() == '\0' || content.back() == '\x1a')) content.remove_suffix(1);
    refuse_what_is_no_text(content, text);
    // Lines end with LF or CRLF; a file without any LF may use CR alone.
    const char line_end = content.find('\n') == std::string_view::npos ? '\r' : '\n';
    text.last_line_ended = content.ends_with(line_end);
    std::size_t begin = 0;
    while (begin < content.size()) {
        const std::size_t end = std::min(content.find(line_end, begin), content.size());
        if (text.lines.size() == most_lines)
            refuse(text, {}, fmt::format("the file has more than {} lines.", most_lines), "at most 5 million samples",
                   "cut the record");
        std::string_view line = content.substr(begin, end - begin);
        if (line.ends_with('\r')) line.remove_suffix(1);
        text.lines.push_back(line);
        begin = end + 1;
    }
    return text;
}

void refuse(const RecordText& text, Place place, std::string problem, std::string expected, std::string fix)
{
    throw InputError(Diagnostic{std::string(text.file_name), static_cast<int>(place.line),
                                static_cast<int>(place.column), std::move(problem), std::move(expected),
                                std::move(fix)});
}

std::string_view trimmed(std::string_view s)
{
    const auto blank = [](char c) { return c == ' ' || c == '\t'; };
    while (!s.empty() && blank(s.front())) s.remove_prefix(1);
    while (!s.empty() && blank(s.back())) s.remove_suffix(1);
    return s;
}

std::string lower(std::string_view s)
{
    std::string out(s);
    for (char& c : out)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return out;
}

std::string printable(std::string_view s)
{
    std::string out;
    for (std::size_t k = 0; k < s.size();) {
        const auto byte = [&](std::size_t at) { return at < s.size() ? static_cast<unsigned char>(s[at]) : 0u; };
        const unsigned lead = byte(k);
        const std::size_t length = lead >= 0xF0 && lead < 0xF5   ? 4
                                   : lead >= 0xE0 && lead < 0xF0 ? 3
                                   : lead >= 0xC2 && lead < 0xE0 ? 2
                                                                 : 1;
        bool valid = length > 1 || (lead >= 32 && lead < 127);
        for (std::size_t j = 1; j < length; ++j) valid &= (byte(k + j) & 0xC0u) == 0x80u;
        // Not UTF-8: overlong forms, surrogates, beyond U+10FFFF.
        if ((lead == 0xE0 && byte(k + 1) < 0xA0) || (lead == 0xED && byte(k + 1) > 0x9F) ||
            (lead == 0xF0 && byte(k + 1) < 0x90) || (lead == 0xF4 && byte(k + 1) > 0x8F))
            valid = false;
        if (valid)
            out += s.substr(k, length);
        else
            out += '?';
        k += valid ? length : 1;
    }
    return out;
}

std::string in_quotes(std::string_view s)
{
    constexpr std::size_t most = 40;
    return "'" + printable(s.substr(0, most)) + (s.size() > most ? "...'" : "'");
}

bool contains(std::string_view s, std::string_view part)
{
    return s.find(part) != std::string_view::npos;
}

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

namespace {

constexpr std::string_view read_formats = "PEER AT2, COSMOS, CSMIP, BHRC, GeoNet, SMC, K-NET, ESM, CSV with a header "
                                          "row, time and acceleration in two columns, or samples "
                                          "with \"# dt: 0.01 s\"";

const RecordFormat& recognise(const RecordText& text)
{
    for (const RecordFormat& format : record_formats()) {
        if (!format.recognises(text)) continue;
        if (!format.read)
            refuse(text, {1, 0}, fmt::format("this looks like {}, which is not read.", format.name),
                   std::string(read_formats),
                   "convert the acceleration to one of these, or download the record in one of them");
        return format;
    }
    refuse(
        text, {1, 0},
        fmt::format("no accelerogram is recognised; the file starts with {}.", in_quotes(trimmed(text.lines.front()))),
        std::string(read_formats), "convert it to one of these");
}

} // namespace

std::vector<Record> parse_record(std::string_view content, std::string_view file_name, const ReadOptions& options)
{
    RecordText text = split_lines(content, file_name); // refuses what is no text by its first bytes as they are
    const std::string converted = is_utf8(content) ? std::string() : utf8_text(std::string(content));
    if (!converted.empty()) text = split_lines(converted, file_name);
    std::vector<Record> records = recognise(text).read(text, options);
    const std::string digest = sha256(content);
    for (Record& record : records) record.source.sha256 = digest;
    return records;
}

Record read_record(const std::filesystem::path& path, const ReadOptions& options)
{
    const std::string content = read_file(path);
    std::vector<Record> records = parse_record(content, path.string(), options);
    if (records.size() > 1) {
        std::string names;
        for (const Record& record : records) names += (names.empty() ? "" : ", ") + record.source.component;
        throw InputError(Diagnostic{
            path.string(), 0, 0, fmt::format("the file holds {} accelerograms: {}.", records.size(), names),
            "one, or a choice among them", "choose by --column (in a scene: motion.record.column, vertical_column)"});
    }
    return std::move(records.front());
}

} // namespace damslip::records
