#pragma once

#include "scene/scene.hpp"

#include <string>
#include <vector>

namespace damslip {

/// The scene with the joints that [lifts] makes for finite elements, and without [lifts]: as lift joints with
/// active = "all", as tied lifts with "adaptive", neither with "none". A mesh from a file has no lines for them: the scene
/// stays as it is.
/// @throws InputError  where other keys do not go with lift joints
Scene with_joints_of_lifts(Scene scene);

/// @throws InputError where other keys do not go with traced cracks (`dam.crack`), or f_t is missing
void check_traced(const Scene& scene);

/// The scene in which the tied lifts of these names are lift joints.
Scene with_awake_lifts(Scene scene, const std::vector<std::string>& names);

} // namespace damslip
