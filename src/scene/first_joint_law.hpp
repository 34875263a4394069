#pragma once

#include "scene/scene.hpp"

#include <string>

namespace damslip {

/// Key of the first joint law in the scene that goes beyond Coulomb friction; empty where there is none.
std::string first_joint_law(const Scene& scene);

} // namespace damslip
