#pragma once

#include "scene/scene.hpp"

namespace damslip {

/// Makes the elements `factor` times as large everywhere but in the far rock; they grow as fast with the distance from the
/// contact plane, and the water's follow.
void scale_mesh(double factor, Scene& scene);

inline constexpr double least_elements = 8.0; ///< on the base, of the coarsest mesh that says anything of a slip

/// On the base, by the scene's size there.
double elements_on_base(const Scene& scene);

} // namespace damslip
