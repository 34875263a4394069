#pragma once

#include "random/draw.hpp"

#include <filesystem>
#include <string>

namespace damslip::random {

/// A scene as a user would write it: text, and its accelerograms in two CSV files.
struct SceneFiles {
    std::string scene;      ///< TOML; names horizontal.csv and, where there is one, vertical.csv
    std::string horizontal; ///< CSV
    std::string vertical;   ///< empty: none
    bool spoilt = false;    ///< one of its values has been made wrong on purpose
};

/// A dam or block of 1 ... 80 m with a mesh of some ten to a hundred elements, any of the keys that a run can meet, and a
/// motion of a few pulses. Most are such that they can be run; values at the ends of their ranges are common, some
/// scenes contradict themselves, and one in twelve has a value that is wrong on purpose.
/// @param radiating  share that radiates of the rock that would be massless; the others keep their scene whatever it is [-]
SceneFiles random_scene(Draw& draw, double radiating = 0.3);

/// Writes scene.toml and its records. @returns the scene file
std::filesystem::path write(const SceneFiles& files, const std::filesystem::path& folder);

} // namespace damslip::random
