#pragma once

#include "scene/scene.hpp"

/// The section that both the rigid block and the FE model use.
namespace damslip {

// Concrete per metre of dam: of a section with a thickness its share of the outline.
double area(const Section& section);                     ///< [m^2], positive
Point centroid(const Section& section);                  ///< [m]
double polar_moment(const Section& section);             ///< second moment of area about the centroid [m^4]

/// Levels between which the share of Section::thickness is linear: constant + slope y. The first begins at -infinity, the
/// last ends at infinity; without a thickness there is one, of share 1.
struct ShareBand {
    double from, to, constant, slope;
    double at(double y) const { return constant + slope * y; }
};
std::vector<ShareBand> share_bands(const Polyline& thickness);
double share_above(const Section& section, double y);                 ///< just above a level [-]
double mean_share(const Section& section, double from, double to);    ///< over levels [-]
double base_share(const Section& section);                            ///< of the joint that the section stands on [-]

/// Integrals over the section of share times a factor over the height, of 1, x, y and x^2 + y^2.
struct SectionSums {
    double area = 0.0, x = 0.0, y = 0.0, polar = 0.0;
    Point centre() const { return {x / area, y / area}; }
};
/// @param factor  as Section::thickness
SectionSums section_sums(const Section& section, const Polyline& factor = {});

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
