#pragma once

#include "analysis/prepare/records.hpp"
#include "pages/report/json_object.hpp"
#include "pages/report/page.hpp"

#include <string>
#include <utility>
#include <vector>

/// What every answer says of where it comes from.
namespace damslip::pages {

/// How the --json object of a command on a scene begins: schema, program, the scene's title, file and hash.
/// @param hash  of the scene as it was given (EffectPlan::scene_hash); empty: `scene` is that. The hash of `scene` as it stands, with
/// what was chosen for it, is resolved_hash
nlohmann::ordered_json json_header(const std::string& what, const Scene& scene, const std::string& hash = {});

/// A page with the scene's title, and below it what the page is about, the scene's file and hash, the version.
/// @param about  sentences: "What accuracy costs. "
Page begin_page(const Scene& scene, const std::string& about, const std::string& hash = {});

/// The resolved scene, folded.
Listing scene_listing(const Scene& scene);

/// Program, scene, its hash and that of the resolved scene. @param hash  as of json_header()
std::vector<std::pair<std::string, std::string>> scene_provenance(const Scene& scene, const std::string& hash = {});

/// File, format, samples and checksum of each component, after what the list holds.
void add_record_provenance(const std::vector<RecordPair>& records,
                           std::vector<std::pair<std::string, std::string>>& list);

/// What reading them found, with their names.
std::vector<std::string> record_warnings(const std::vector<RecordPair>& records);

} // namespace damslip::pages
