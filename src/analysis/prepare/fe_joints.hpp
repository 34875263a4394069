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

/// The scene whose finite elements slide on the seam that planes.slides_on names, with what of the rock moves along (Scene::seam_body);
/// a wedge that is searched for has the angle of the least yield acceleration. The base of the dam is a joint on that rock. Without
/// a name the scene as it is.
/// @throws UsageError where no seam has the name; InputError for what finite elements cannot follow on a seam
Scene with_seam_body(Scene scene);

} // namespace damslip
