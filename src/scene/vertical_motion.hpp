#pragma once

#include "scene/scene.hpp"

namespace damslip {

/// Some record of the scene has a vertical component.
bool any_vertical_record(const Scene& scene);

} // namespace damslip
