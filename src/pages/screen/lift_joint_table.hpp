#pragma once

#include "core/table.hpp"
#include "scene/scene.hpp"

namespace damslip::pages {

/// The rigid block above each lift joint: static safety and yield acceleration. Empty without lift joints.
Table lift_joint_table(const Scene& scene);

} // namespace damslip::pages
