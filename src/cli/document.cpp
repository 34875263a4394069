#include "cli/document.hpp"

#include "pages/report/json_object.hpp"

#include <nlohmann/json.hpp>
#include <ostream>

namespace damslip::cli {

bool put_json_document(const Streams& streams, const std::string& what,
                       std::initializer_list<std::pair<const char*, std::string>> members)
{
    if (streams.form != Form::json) return false;
    auto j = pages::json_header(what);
    for (const auto& [name, text] : members) j[name] = text;
    streams.out << j.dump(2) << "\n";
    return true;
}

} // namespace damslip::cli
