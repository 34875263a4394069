#pragma once

#include "fe2d/mesh/mesh.hpp"
#include "scene/scene.hpp"

#include <optional>

namespace damslip::fe2d {

/// A line of relief wells below the base, held at one head.
struct DrainLine {
    double distance = 0.0; ///< from the heel along the base [m]
    double depth = 0.0;    ///< below the base [m]
    double head = 0.0;     ///< [m] above the heel
};

/// Rock box in which the water flows.
struct SeepageBox {
    double width = 0.0; ///< centred on the base [m]
    double depth = 0.0; ///< below the heel [m]
};

/// The scene's foundation; without one 300/45 x 100/45 base lengths, the proportions of the thesis' foundation.
SeepageBox seepage_box(const Scene& scene);

struct SeepageMeshOptions {
    double finest =
        1.0 / 450.0;      ///< element size where the flow is singular (heel, toe, curtain, drain foot), of the base [-]
    double growth = 1.15; ///< ratio of neighbouring sizes [-], > 1
    double largest = 1.0 / 20.0; ///< largest element size, of the box depth [-]
};

/// Rock alone, for the flow: columns and rows refined towards heel, toe, both sides and foot of the curtain (where it
/// changes the flow), and the drain line. Its contact plane stands on nodes of its own; there are no dam elements.
/// @throws InputError when the base, curtain or drains do not fit into the box
Mesh seepage_mesh(const Scene& scene, const std::optional<DrainLine>& drains, const SeepageMeshOptions& options = {});

} // namespace damslip::fe2d
