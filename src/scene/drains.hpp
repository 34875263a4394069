#pragma once

#include "scene/scene.hpp"

/// What reads [drains] and [curtain]; beside anything else they change nothing.
namespace damslip {

/// The profile of the uplift model is lower where the scene has [drains].
bool reads_drains(UpliftModel model);

/// [drains] is given, and lowers the water pressure under the base or in a seam.
bool drains_lower_uplift(const Scene& scene);

/// The same, or it is read by finite elements alone: by the water in the rock, or the flow along a joint that opens.
bool drains_are_read(const Scene& scene);

/// [curtain] is given and read: by the uplift, the rock's stiffness, the water in the rock, or as the measure of a depth.
/// @param depth_given  foundation.depth_m stands in the scene file
bool curtain_is_read(const Scene& scene, bool depth_given);

} // namespace damslip
