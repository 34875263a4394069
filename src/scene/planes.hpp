#pragma once

#include "scene/scene.hpp"

#include <vector>

/// Where the planes beside the base lie, as the scene says.
namespace damslip {

/// Above this level a lift crosses the dam from face to face: the higher end of the base [m].
double lowest_lift(const Section& section);

/// Elevations of [lifts] as its keys say them, from the bottom up [m].
std::vector<double> made_lifts(const Lifts& lifts, const Section& section);
/// The same with those of [[lift_joint]], each once [m].
std::vector<double> lift_elevations(const Scene& scene);
inline constexpr double same_level = 1e-6; ///< lifts that close to each other are one [m]

/// Level of the base line at x, beyond its ends too [m].
double base_level(const Section& section, double x);

/// The surface on which the rock ends: foundation.ground_m up- and downstream of the dam, the base from heel to toe.
Polyline ground_line(const Scene& scene);
/// Its level at x; constant beyond its ends [m].
double ground_level(const Polyline& ground, double x);

/// Path of a seam from upstream to downstream: points_m as they are; a straight seam from below the heel to the kink of its
/// wedge, to below the toe, or to where it comes to the ground (100 base lengths at most).
Polyline seam_path(const Scene& scene, const Seam& seam);

/// FE: strength of what the dam slides on, the base or the seam of its body.
const Contact& base_strength(const Scene& scene);
/// FE: joints in the order of the mesh, the lift joints, then the interfaces of a seam's body.
std::vector<LiftJoint> joints_of(const Scene& scene);

} // namespace damslip
