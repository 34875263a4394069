#pragma once

#include "analysis/prepare/records.hpp"
#include "pages/report/json_object.hpp"

#include <string>
#include <utility>
#include <vector>

/// What every answer says of where it comes from.
namespace damslip::pages {

/// How the --json object of a command on a scene begins: schema, program, the scene's title, file and hash.
/// @param given  as read: the hash is of it
nlohmann::ordered_json json_header(const std::string& what, const Scene& given);

/// File, format, samples and checksum of each component, after what the list holds.
void add_record_provenance(const std::vector<RecordPair>& records,
                           std::vector<std::pair<std::string, std::string>>& list);

/// What reading them found, with their names.
std::vector<std::string> record_warnings(const std::vector<RecordPair>& records);

} // namespace damslip::pages
