#pragma once

#include "scene/effect_row.hpp"

namespace damslip {

/// EffectRow::decide for a scene of a rock wedge. @pre scene.wedge
Decision decide_of_wedge(Effect effect, const Scene& scene);

} // namespace damslip
