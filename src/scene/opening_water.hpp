#pragma once

#include "scene/scene.hpp"

#include <string>
#include <utility>
#include <vector>

namespace damslip {

/// Words of uplift.opening, in the order of the guidelines that are for them.
const std::vector<std::pair<std::string, OpeningWater>>& opening_waters();

/// As written in a scene file: "full".
const std::string& word(OpeningWater rule);

/// The uplift hangs on drains that shear off while the base slips.
bool drains_shear_off(const Scene& scene);
/// The water under the base does not stay as it is: it follows the opening, or its drains shear off.
bool base_water_changes(const Scene& scene);

} // namespace damslip
