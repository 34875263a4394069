#pragma once

#include "records/read/header.hpp"
#include "scene/scene.hpp"

#include <string>
#include <vector>

namespace damslip {

/// Which component of the motion a file holds.
struct ComponentName {
    records::Component kind = records::Component::none; ///< none: nothing says; it is taken as horizontal
    std::string base; ///< the name without the component: what the components of one station in one earthquake share
    bool alone =
        true; ///< false: a reading of the name that counts only where another file has the same base ("LOSUP" beside "LOS000")
};

/// What the name of a file says of its component, the likeliest reading first, none at all last: a direction as a part of the name between
/// separators ("XX.STA..HNZ.D.ASC", "ELC-UP", "UD_elcentro"), after a station's number ("65036EW"), as an azimuth of three digits at the end
/// ("ELC180"; with `alone` false after digits, "E06140"), as the extension (K-NET: .EW, .UD2), or (`alone` false) stuck to the end.
std::vector<ComponentName> component_names(const std::filesystem::path& file);

/// Records of a folder, a pattern or a list, their components paired.
struct RecordList {
    std::vector<RecordFiles> records;
    std::vector<std::string> events; ///< of each record: what its horizontal components share
    std::vector<double> weights;     ///< of each record
    std::vector<std::string>
        notes; ///< components that are left out, unpaired, unknown, or named otherwise by header and name
    std::filesystem::path
        folder; ///< that was named, that of the list, or that of the records made: what is known of them is kept there
    std::string made; ///< of a list of seeds whose records were not there: what was made, and where
};

/// @param pattern  a folder; a pattern such as "suite/*.AT2"; or a CSV with the column horizontal and, as far as they are wanted,
/// vertical, other_horizontal, column, vertical_column, event, weight, magnitude, scale, paths in it from its folder; or a list of seeds
/// (records/generate/generate.hpp), whose records are made when they are not there yet. Without records where nothing fits. In a folder, files whose
/// extension is that of a page, picture, scene or list are passed over.
/// The component of a file is what its header says, else what its name says. A file with a horizontal channel or two and at most one vertical
/// is a station: a motion for each horizontal channel, with its vertical one. @param stations  false: such a file is taken as it is, because
/// its column is chosen otherwise
/// @throws InputError for a CSV with other columns, missing files or numbers that are none; with file and line
RecordList record_list(const std::string& pattern, bool stations = true);

} // namespace damslip
