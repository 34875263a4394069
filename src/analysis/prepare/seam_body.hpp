#pragma once

#include "scene/scene.hpp"

#include <string>

namespace damslip {

/// The scene whose finite elements slide on the seam that planes.slides_on names, with what of the rock moves along (Scene::seam_body);
/// a wedge that is searched for has the angle of the least yield acceleration. The base of the dam is a joint on that rock. Without
/// a name the scene as it is.
/// @throws UsageError where no seam has the name; InputError for what finite elements cannot follow on a seam
Scene with_seam_body(Scene scene);

} // namespace damslip
