#pragma once

#include "scene/read.hpp"

#include <toml++/toml.h>

namespace damslip {

/// The second half of parse_scene(): of a text that is TOML. @throws InputError
Scene scene_of_table(toml::table root, const std::filesystem::path& file, FileCheck check);

/// The first half. @throws InputError with the line that is no TOML
toml::table toml_of(std::string_view text, const std::filesystem::path& file);

} // namespace damslip
