#pragma once

#include "scene/scene.hpp"

#include <string>

namespace damslip {

enum class RecordPaths {
    absolute,  ///< the file can be read from anywhere on this machine
    file_names ///< the same text wherever the scene lies: for the scene hash
};

/// The scene with all defaults as TOML, sizes of elements and what else the program chooses by itself included. Reading it back gives the same results, bit for bit.
std::string resolved_toml(const Scene& scene, RecordPaths paths = RecordPaths::absolute);

/// SHA-256 of the resolved scene; the same for the same model wherever its file lies, whatever its name and title and
/// however it was written.
std::string scene_hash(const Scene& scene);

} // namespace damslip
