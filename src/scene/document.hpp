#pragma once

#include <string>

namespace damslip {

/// JSON Schema (draft 7) of the scene file, for editors and checkers.
std::string scene_schema();

/// Every key with unit, range, default and meaning, as Markdown.
std::string scene_keys_markdown();

} // namespace damslip
