#include "pages/report/escape.hpp"

#include <nlohmann/json.hpp>

namespace damslip::pages {

std::string html_text(std::string_view text)
{
    std::string out;
    out.reserve(text.size());
    for (const char c : text) {
        switch (c) {
        case '&':
            out += "&amp;";
            break;
        case '<':
            out += "&lt;";
            break;
        case '>':
            out += "&gt;";
            break;
        case '"':
            out += "&quot;";
            break;
        case '\'':
            out += "&#39;";
            break;
        default:
            if (static_cast<unsigned char>(c) >= 0x20 || c == '\t' || c == '\n') out += c;
        }
    }
    return out;
}

std::string json_text(std::string_view text)
{
    const std::string quoted =
        nlohmann::json(std::string(text)).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    std::string out;
    out.reserve(quoted.size());
    for (const char c : quoted) {
        if (c == '<')
            out += "\\u003c";
        else
            out += c;
    }
    return out;
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

std::size_t unfinished_bytes(std::string_view text)
{
    if (text.ends_with("\xC2") || text.ends_with("\xE2")) return 1;
    return text.ends_with("\xE2\x80") || text.ends_with("\xE2\x81") ? 2 : 0;
}

} // namespace damslip::pages
