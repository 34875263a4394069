#include "records/read/record_text.hpp"

#include "core/input_error.hpp"

#include <algorithm>
#include <fmt/format.h>

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

} // namespace damslip::records
