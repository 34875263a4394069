#include "pages/report/json_object.hpp"

#include "core/version.hpp"

#include <nlohmann/json.hpp>

namespace damslip::pages {

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

} // namespace damslip::pages
