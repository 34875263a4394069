#include "pages/report/json.hpp"

#include "core/version.hpp"

#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

namespace damslip::pages {

std::string html_text(std::string_view text)
{
    static const std::map<char, const char*> entities{
        {'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}, {'\'', "&#39;"}};
    std::string out;
    out.reserve(text.size());
    for (const char c : text)
        if (const auto entity = entities.find(c); entity != entities.end())
            out += entity->second;
        else if (static_cast<unsigned char>(c) >= 0x20 || c == '\t' || c == '\n')
            out += c;
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

struct JsonOf {
    nlohmann::ordered_json operator()(std::monostate) const { return nullptr; }
    template <class Value>
    nlohmann::ordered_json operator()(const Value& value) const
    {
        return value;
    }
};

} // namespace

nlohmann::ordered_json json_of(const Table& table)
{
    auto rows = nlohmann::ordered_json::array();
    for (const std::vector<Cell>& row : table.rows) {
        auto& object = rows.emplace_back(nlohmann::ordered_json::object());
        for (std::size_t j = 0; j < row.size(); ++j) object[table.columns[j].key] = std::visit(JsonOf{}, row[j]);
    }
    return rows;
}

nlohmann::ordered_json json_header(const std::string& what)
{
    nlohmann::ordered_json j;
    j["schema"] = "damslip." + what + "/1";
    j["program"] = {{"name", "damslip"}, {"version", program_version()}};
    return j;
}

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
