#pragma once

#include "scene/scene.hpp"

namespace damslip {

/// As written in a scene file: "curtain".
const char* word(UpliftModel model);

} // namespace damslip
