#include "core/xml_text.hpp"

namespace damslip {

std::string xml_text(std::string_view text)
{
    std::string out;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (c == '&')
            out += "&amp;";
        else if (c == '<')
            out += "&lt;";
        else if (c == '>')
            out += "&gt;";
        else if (c == '"')
            out += "&quot;";
        else if ((byte < 0x20 && c != '\t' && c != '\n') || byte == 0x7F) // U+2400 + c, U+2421
            out += std::string("\xE2\x90") + static_cast<char>(byte == 0x7F ? 0xA1 : 0x80 + byte);
        else
            out += c;
    }
    return out;
}

} // namespace damslip
