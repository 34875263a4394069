#pragma once

#include "core/input_error.hpp"
#include "scene/scene.hpp"

#include <string_view>
#include <vector>

namespace damslip {

enum class FileCheck {
    must_exist, ///< record files named by the scene have to be there
    skip        ///< they are not looked for (fuzzing, parsing from memory)
};

/// Reads and checks a scene file: TOML, keys of keys.cpp, consistency between keys (check_*.cpp), defaults filled in, SI.
/// @throws InputError with everything that is wrong at once, each with file, line, column, value, what is allowed, and
/// a fix.
Scene read_scene(const std::filesystem::path& file);

/// The same from memory. @param file  name for messages; record files are relative to its folder.
Scene parse_scene(std::string_view toml_text, const std::filesystem::path& file,
                  FileCheck check = FileCheck::must_exist);

/// The diagnostic of a scene with the line of the first key or table that it names ("contact.sliding", "seam[2].exit", "[lifts]"), where
/// it has none: what is found wrong once a scene is read knows its keys, not their places.
Diagnostic with_line(Diagnostic diagnostic);

/// "x (2)", "x (3)" for records whose name another one has already: tables and files tell records apart by their names.
void number_names(std::vector<RecordFiles>& records);

} // namespace damslip
