#include "pages/scene/report_provenance.hpp"

#include "core/version.hpp"
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

TitleBlock title_block(const Project& project)
{
    TitleBlock block;
    const auto entry = [&block](const char* name, const std::string& value) {
        if (!value.empty()) block.entries.emplace_back(name, value);
    };
    entry("project", project.name);
    entry("client", project.client);
    entry("date", project.date);
    entry("revision", project.revision);
    if (!project.author.empty()) block.signers.emplace_back("prepared by", project.author);
    if (!project.checker.empty()) block.signers.emplace_back("checked by", project.checker);
    block.notes = project.notes;
    return block;
}

} // namespace

nlohmann::ordered_json json_header(const std::string& what, const Scene& scene, const std::string& hash)
{
    nlohmann::ordered_json j = json_header(what);
    const std::string resolved = scene_hash(scene);
    j["scene"] = {{"title", scene.title},
                  {"file", scene.file.string()},
                  {"hash", hash.empty() ? resolved : hash},
                  {"resolved_hash", resolved}};
    return j;
}

Page begin_page(const Scene& scene, const std::string& about, const std::string& hash)
{
    const std::string words =
        ", scene " + (hash.empty() ? scene_hash(scene) : hash).substr(0, 12) + ", damslip " + program_version();
    const std::string file = scene.file.filename().string();
    Page page;
    page.title = scene.title.empty() ? file : scene.title;
    page.title_block = title_block(scene.project);
    page.footer =
        page.title + (scene.project.revision.empty() ? "" : ", revision " + scene.project.revision) + words;
    page.subtitle = about + file + words;
    return page;
}

Listing scene_listing(const Scene& scene)
{
    return {"The resolved scene, all defaults written out (TOML)", resolved_toml(scene)};
}

std::vector<std::pair<std::string, std::string>> scene_provenance(const Scene& scene, const std::string& hash)
{
    const std::string resolved = scene_hash(scene);
    std::vector<std::pair<std::string, std::string>> list{{"program", "damslip " + program_version()},
                                                          {"scene", scene.file.string()},
                                                          {"scene hash", hash.empty() ? resolved : hash}};
    if (list.back().second != resolved) list.emplace_back("hash of the resolved scene", resolved);
    return list;
}

void add_record_provenance(const std::vector<RecordPair>& records,
                           std::vector<std::pair<std::string, std::string>>& list)
{
    for (const RecordPair& pair : records) {
        if (!pair.parts.empty()) {
            add_record_provenance(pair.parts, list);
            continue;
        }
        const std::string scaled = pair.files.scale == 1.0 ? "" : fmt::format(", times {:.6g}", pair.files.scale);
        list.emplace_back("record " + pair.files.name, component_text(pair.horizontal) + scaled);
        if (pair.vertical)
            list.emplace_back("record " + pair.files.name + ", vertical", component_text(*pair.vertical) + scaled);
    }
}

std::vector<std::string> record_warnings(const std::vector<RecordPair>& records)
{
    std::vector<std::string> list;
    for (const RecordPair& pair : records) {
        if (!pair.parts.empty()) {
            for (std::string& warning : record_warnings(pair.parts)) list.push_back(std::move(warning));
            continue;
        }
        for (const Record* r : {&pair.horizontal, pair.vertical ? &*pair.vertical : nullptr})
            if (r)
                for (const std::string& w : r->warnings) list.push_back(pair.files.name + ": " + w);
    }
    return list;
}

} // namespace damslip::pages
