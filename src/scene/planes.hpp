#pragma once

#include "scene/scene.hpp"

#include <vector>

/// Where the planes beside the base lie, as the scene says.
namespace damslip {

/// Above this level a lift crosses the dam from face to face: the higher end of the base [m].
double lowest_lift(const Section& section);

/// Elevations of the lifts from the bottom up, those inside the section only [m].
std::vector<double> lift_elevations(const Lifts& lifts, const Section& section);

/// Level of the base line at x, beyond its ends too [m].
double base_level(const Section& section, double x);

/// Surface of the rock beside the dam: foundation.ground_m, else level at heel and toe. Between heel and toe: the base.
Polyline ground_line(const Scene& scene);
/// Its level at x; constant beyond its ends [m].
double ground_level(const Polyline& ground, double x);

/// Path of a seam from upstream to downstream: points_m as they are; a straight seam from below the heel to the kink of its
/// wedge, to below the toe, or to where it comes to the ground (100 base lengths at most).
Polyline seam_path(const Scene& scene, const Seam& seam);

} // namespace damslip
