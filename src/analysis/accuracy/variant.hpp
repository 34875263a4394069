#pragma once

#include "analysis/accuracy/rung.hpp"
#include "scene/scene.hpp"

namespace damslip {

/// The scene that a rung runs; `fe` and `screen` run it alone to the same slip.
Scene scene_of(const Scene& scene, const Rung& rung);

} // namespace damslip
