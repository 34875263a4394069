#pragma once

#include "scene/scene.hpp"

namespace damslip {

/// The scene with another peak friction; a residual value above it is lowered to it. Of a wedge it is the friction of the first
/// plane, and the second keeps its share of it (without friction on the first plane: both get it). @throws UsageError for a
/// scene with a friction table
Scene with_friction(Scene scene, double friction);
/// The same in place.
void set_friction(Scene& scene, double friction);

} // namespace damslip
