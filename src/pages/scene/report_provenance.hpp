#pragma once

#include "analysis/prepare/records.hpp"

#include <string>
#include <utility>
#include <vector>

/// What every report says of where its records come from.
namespace damslip::pages {

/// File, format, samples and checksum of each component, after what the list holds.
void add_record_provenance(const std::vector<RecordPair>& records,
                           std::vector<std::pair<std::string, std::string>>& list);

/// What reading them found, with their names.
std::vector<std::string> record_warnings(const std::vector<RecordPair>& records);

} // namespace damslip::pages
