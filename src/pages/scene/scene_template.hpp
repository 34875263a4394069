#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace damslip::pages {

/// What a new scene is made of. What is not given is assumed and said so in the file.
struct SceneTemplate {
    std::string title = "My dam";
    double height = 0.0;             ///< [m]
    std::optional<double> base;      ///< [m]; default: 0.8 of the height
    std::optional<double> crest;     ///< width [m]; default: a tenth of the height
    std::optional<double> level;     ///< of the reservoir above the heel [m]; default: 95 % of the height
    std::optional<double> friction;  ///< of the base [-]; default: 0.8
    std::optional<double> allowable; ///< slip [mm]; default: 50
    std::vector<std::filesystem::path> records, verticals; ///< as many verticals as records, or none
};

/// A scene file with a comment for each line. Paths are written as given.
std::string scene_text(const SceneTemplate& dam);

} // namespace damslip::pages
