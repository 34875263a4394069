#include "pages/scene/report_provenance.hpp"

#include "scene/write.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace damslip::pages {

namespace {

std::string component_text(const Record& r)
{
    return fmt::format("{} ({}{}, {} samples, {:.4g} s), sha256 {}", r.source.file, r.source.format,
                       r.source.unit.empty() ? "" : ", " + r.source.unit, r.acceleration.size(), r.dt, r.source.sha256);
}

} // namespace

nlohmann::ordered_json json_header(const std::string& what, const Scene& given)
{
    nlohmann::ordered_json j = json_header(what);
    j["scene"] = {{"title", given.title}, {"file", given.file.string()}, {"hash", scene_hash(given)}};
    return j;
}

void add_record_provenance(const std::vector<RecordPair>& records,
                           std::vector<std::pair<std::string, std::string>>& list)
{
    for (const RecordPair& pair : records) {
        list.emplace_back("record " + pair.files.name, component_text(pair.horizontal));
        if (pair.vertical)
            list.emplace_back("record " + pair.files.name + ", vertical", component_text(*pair.vertical));
    }
}

std::vector<std::string> record_warnings(const std::vector<RecordPair>& records)
{
    std::vector<std::string> list;
    for (const RecordPair& pair : records)
        for (const Record* r : {&pair.horizontal, pair.vertical ? &*pair.vertical : nullptr})
            if (r)
                for (const std::string& w : r->warnings) list.push_back(pair.files.name + ": " + w);
    return list;
}

} // namespace damslip::pages
