#pragma once

#include "core/table.hpp"
#include "pages/report/json_object.hpp"

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace damslip::pages {

/// Table rows as a JSON array of objects, by column key, for a command's --json object; nothing and non-finite numbers are null.
nlohmann::ordered_json json_of(const Table& table);

/// {"schema": "damslip.<what>/1", "program": {...}}: how each --json object begins.
nlohmann::ordered_json json_header(const std::string& what);

} // namespace damslip::pages
