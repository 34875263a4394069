#pragma once

#include "analysis/prepare/wedge_model.hpp"
#include "pages/report/page.hpp"

#include <optional>

namespace damslip::pages {

/// Lower hemisphere, equal area: great circles of planes, face and upper ground, line of intersection, way of sliding, direction of
/// the records. @pre scene.wedge
Drawing stereonet(const Scene& scene, const RigidWedge& wedge);

/// The wedge in its slope, seen from before the face; nothing where the scene gives no surfaces.
std::optional<Drawing> wedge_drawing(const Scene& scene, const RigidWedge& wedge);

} // namespace damslip::pages
