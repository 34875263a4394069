#pragma once

#include "scene/joint_laws.hpp"

#include <string>
#include <utility>
#include <vector>

namespace damslip {

/// Words of uplift.opening, in the order of the guidelines that are for them.
const std::vector<std::pair<std::string, OpeningWater>>& opening_waters();

/// As written in a scene file: "full".
const std::string& word(OpeningWater rule);

} // namespace damslip
