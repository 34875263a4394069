#include "cli/terminal/streams.hpp"

#include "report/table_text.hpp"

#include <nlohmann/json.hpp>

namespace damslip::cli {

nlohmann::ordered_json json_of(const Table& table)
{
    return nlohmann::ordered_json::parse(report::json_rows(table));
}

nlohmann::ordered_json json_header(const std::string& what)
{
    nlohmann::ordered_json j;
    j["schema"] = "damslip." + what + "/1";
    j["program"] = {{"name", "damslip"}, {"version", program_version()}};
    return j;
}

std::string program_version()
{
    return DAMSLIP_VERSION;
}

} // namespace damslip::cli
