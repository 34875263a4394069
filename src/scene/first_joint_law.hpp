#pragma once

#include "scene/scene.hpp"

#include <string>

namespace damslip {

/// The law of a joint beyond Coulomb's that a scene names first, as its key; empty: none.
std::string first_joint_law(const Scene& scene);

} // namespace damslip
