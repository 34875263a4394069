#include "pages/report/number_json.hpp"

#include <charconv>
#include <cmath>
#include <limits>

namespace damslip::pages {

void add_json_number(std::string& out, double value, int digits)
{
    if (!std::isfinite(value)) {
        out += "null";
        return;
    }
    char text[32];
    const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::general, digits).ptr;
    out.append(text, end);
}

std::string json_number(const std::optional<double>& value, int digits)
{
    std::string out;
    add_json_number(out, value.value_or(std::numeric_limits<double>::quiet_NaN()), digits);
    return out;
}

std::string json_numbers(const std::vector<double>& values, int digits)
{
    std::string out = "[";
    out.reserve(8 * values.size() + 2);
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (i) out += ',';
        add_json_number(out, values[i], digits);
    }
    return out + "]";
}

} // namespace damslip::pages
