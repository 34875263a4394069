#pragma once

#include "scene/scene.hpp"

#include <functional>

namespace damslip {

/// Puts the settings of `scene.analysis.preset` where `open` allows it. goldgruber-2015 (Goldgruber 2015, chapters 4 and 6):
/// penalty with slip tolerance 0.005, no separation, massless rock on fixed edges, damper and still bottom of acoustic
/// water, relative mass damping, HHT alpha = -1/3 and whole steps of 0.01 s.
/// @param open  may this key, as "time.dt", be set?
void apply_preset(Scene& scene, const std::function<bool(const char* key)>& open);

} // namespace damslip
