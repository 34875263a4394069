#pragma once

#include "scene/keys.hpp"
#include "scene/scene.hpp"

#include <string>
#include <vector>

namespace damslip {

enum class RecordPaths {
    absolute,  ///< the file can be read from anywhere on this machine
    file_names ///< the same text wherever the scene lies: for the scene hash
};

/// The scene with all defaults as TOML, sizes of elements and what else the program chooses by itself included. Reading it back gives the same results, bit for bit.
std::string resolved_toml(const Scene& scene, RecordPaths paths = RecordPaths::absolute);

/// A number of the resolved scene that has a usual range.
struct UsualValue {
    std::string key;   ///< "contact.friction"; of several entries of a list with the place: "seam.friction (2)"
    std::string value; ///< of six digits, in the unit of the key
    Usual usual;
    UnitSuffix unit; ///< of the range
};

/// Loads, strengths, moduli, damping: what a dam is judged by. Left out are sizes of section and mesh, and ranges that are nobody's but
/// ours.
std::vector<UsualValue> usual_values(const Scene& scene);

/// SHA-256 of the resolved scene; the same for the same model wherever its file lies, whatever its name and title and
/// however it was written.
std::string scene_hash(const Scene& scene);

} // namespace damslip
