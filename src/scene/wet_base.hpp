#pragma once

#include "scene/scene.hpp"

namespace damslip {

/// Water stands on the dam in the scene or in one of its load combinations, so that it can press up under the base.
bool water_on_dam(const Scene& scene);

/// Water stands on the dam, but there is no uplift: the base is taken as dry.
bool base_taken_as_dry(const Scene& scene);

} // namespace damslip
