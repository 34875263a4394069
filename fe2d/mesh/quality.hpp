#pragma once

#include "fe2d/mesh/mesh.hpp"
#include "scene/scene.hpp"

namespace damslip::fe2d {

/// Shape figures of a mesh. The scaled Jacobian of a corner is the sine of its angle (for triangles divided by sin 60
/// degrees): 1 is ideal, 0 is flat, negative is inverted.
struct MeshQuality {
    double smallest_edge = 0.0;  ///< [m]
    double largest_edge = 0.0;   ///< [m]
    double largest_aspect = 0.0; ///< longest over shortest edge of one element [-]
    double smallest_angle = 0.0; ///< [rad]
    double smallest_scaled_jacobian = 0.0;
    int worst_element = -1; ///< where the smallest scaled Jacobian is
    int quadrilaterals = 0, triangles = 0;
};

MeshQuality measure_quality(const Mesh& mesh);

/// Refuses a mesh with a flat, inverted or non-convex element (scaled Jacobian below 0.01).
/// @throws InputError with the region, the place of the element and the section's vertices beside it.
void check_quality(const Mesh& mesh, const Scene& scene);

} // namespace damslip::fe2d
