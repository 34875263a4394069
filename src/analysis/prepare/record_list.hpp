#pragma once

#include "scene/scene.hpp"

#include <string>
#include <vector>

namespace damslip {

/// Which component of the motion a file holds, as its name says.
struct ComponentName {
    enum class Kind { horizontal, vertical, none };
    Kind kind = Kind::none; ///< none: the name does not say; it is taken as horizontal
    std::string base;       ///< the name without it: what the components of one station in one earthquake share
};

/// Reads "RSN6_ELC180.AT2", "ELC-UP.AT2", "rock_1.0_h.csv", "AKT001.UD1": a direction at the end of the stem, after a separator or
/// a station's number, as an azimuth of three digits, or as the extension (K-NET). Horizontal: H, H1, H2, N, E, NS, EW, X, Y, L, T, azimuths; vertical: V, Z, UP, UD, DN, DWN,
/// VER, VERT, VRT.
ComponentName component_of_name(const std::filesystem::path& file);

/// Records of a folder, a pattern or a list, their components paired by their names.
struct RecordList {
    std::vector<RecordFiles> records;
    std::vector<std::string> events; ///< of each record: what its horizontal components share
    std::vector<double> weights;     ///< of each record
    std::vector<std::string> notes;  ///< verticals without a horizontal one, which are left out
    std::filesystem::path
        folder; ///< that was named, that of the list, or that of the records made: what is known of them is kept there
    std::string made; ///< of a list of seeds whose records were not there: what was made, and where
};

/// @param pattern  a folder; a pattern such as "suite/*.AT2"; or a CSV with the column horizontal and, as far as they are wanted,
/// vertical, other_horizontal, event, weight, magnitude, scale, paths in it from its folder; or a list of seeds (records/generate/seed_list.hpp),
/// whose records are made when they are not there yet. Without records where nothing fits. In a folder, files whose
/// extension is that of a page, picture, scene or list are passed over.
/// @throws InputError for a CSV with other columns, missing files or numbers that are none; with file and line
RecordList record_list(const std::string& pattern);

} // namespace damslip
