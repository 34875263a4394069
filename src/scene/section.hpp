#pragma once

#include "scene/scene.hpp"

/// The section that both the rigid block and the FE model use.
namespace damslip {

double area(const Section& section);                     ///< [m^2], positive
Point centroid(const Section& section);                  ///< [m]
double polar_moment(const Section& section);             ///< second moment of area about the centroid [m^4]
Point heel(const Section& section);                      ///< first vertex
Point toe(const Section& section);                       ///< second vertex
double base_length(const Section& section);              ///< heel to toe, along the base [m]
double base_inclination(const Section& section);         ///< theta [rad], positive: dips downstream (toe below heel)
double crest_level(const Section& section);              ///< highest y [m]
double width_at_level(const Section& section, double y); ///< from the first to the last crossing of the level y [m]
Polyline upstream_face(const Section& section);          ///< from the heel up to the crest's upstream end
Polyline downstream_face(const Section& section);        ///< from the toe up to the crest's downstream end

/// What slides, as a sentence calls it: "dam", "block" of a rock slope, "wedge".
const char* sliding_body(const Scene& scene);

} // namespace damslip
