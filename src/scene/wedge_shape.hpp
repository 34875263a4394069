#pragma once

#include "core/vector3.hpp"
#include "scene/rock_wedge.hpp"

#include <optional>

namespace damslip {

/// The tetrahedron between both planes, face and upper ground; the lower end of the line of intersection, in the face,
/// is the origin.
struct WedgeShape {
    Vector3 top{};          ///< upper end of the line of intersection [m]
    Vector3 first_crest{};  ///< where the first plane meets the crest, the edge of face and upper ground [m]
    Vector3 second_crest{}; ///< the second plane
    double volume = 0.0;    ///< [m^3]
    double first_area = 0.0, second_area = 0.0; ///< of the planes [m^2]
};

/// Corners from the line of intersection, height H: each is where three of the four planes meet. Nothing where they
/// bound no body above both planes, behind the face and below the upper ground (the line of intersection does not come
/// out in the face, or runs into it), or where the scene gives no surfaces.
/// @pre two planes
std::optional<WedgeShape> wedge_shape(const RockWedge& wedge);

/// How far the wedge can slide on its planes [m]: the line of intersection. None where the scene gives no surfaces.
std::optional<double> line_length(const RockWedge& wedge);

/// How far it can slide on one of them alone: the plane's longest edge [m]; none as above.
std::optional<double> plane_length(const RockWedge& wedge, std::size_t plane);

/// Of the scene: from the shape, else as given [m^3], [m^2].
double wedge_volume(const RockWedge& wedge);
double wedge_area(const RockWedge& wedge, std::size_t plane);

/// Mean water pressure on a plane [Pa]: as given, else gamma_w H/6 where the planes are full of water (pressure rises
/// from zero at the surfaces to gamma_w H/2 half-way down the line of intersection: a pyramid), Hoek & Bray (1981), ch. 8.
double wedge_water_pressure(const RockWedge& wedge, std::size_t plane, double gravity);

} // namespace damslip
