#include "core/text.hpp"

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

} // namespace damslip
