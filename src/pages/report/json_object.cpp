#include "pages/report/json_object.hpp"

#include "core/version.hpp"
#include "pages/report/table_text.hpp"

#include <nlohmann/json.hpp>

namespace damslip::pages {

nlohmann::ordered_json json_of(const Table& table)
{
    return nlohmann::ordered_json::parse(json_rows(table));
}

nlohmann::ordered_json json_header(const std::string& what)
{
    nlohmann::ordered_json j;
    j["schema"] = "damslip." + what + "/1";
    j["program"] = {{"name", "damslip"}, {"version", program_version()}};
    return j;
}

} // namespace damslip::pages
