#pragma once

#include <array>
#include <charconv>
#include <string>

namespace damslip {

/// shortest(value) at the end of a text that is made of many numbers.
inline void append_shortest(std::string& text, double value)
{
    std::array<char, 32> buffer;
    const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
    text.append(buffer.data(), end);
}

} // namespace damslip
