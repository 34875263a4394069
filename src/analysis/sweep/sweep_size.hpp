#pragma once

#include "scene/scene.hpp"

namespace damslip {

/// The scene geometrically `factor` times as large: section, rock box, curtain, drains, water and silt levels, uplift
/// points, lift joints, element sizes and where forces act. Materials, slips, point forces and ice thrust stay.
///
/// A rigid block on friction with water alone has the same yield acceleration at every size: weight, thrust and uplift
/// grow with the square of the factor, and so does the added mass.
Scene sized(Scene scene, double factor);

} // namespace damslip
