#pragma once

#include "core/geometry.hpp"

#include <optional>
#include <string>
#include <vector>

/// A rock wedge on two planes, cut off by the face of a slope and the ground above it. Hoek & Bray (1981), Rock Slope
/// Engineering, ch. 8. Angles in rad, azimuths clockwise from north.
namespace damslip {

/// One of the two planes the wedge rests on.
struct RockPlane {
    std::string name;
    double dip = 0.0;                     ///< from the horizontal, 0 ... pi/2 [rad]
    double dip_direction = 0.0;           ///< [rad]
    double friction = 0.0;                ///< tan phi [-]
    double cohesion = 0.0;                ///< c [Pa], on the whole area
    std::optional<double> area;           ///< [m^2]; none: from the shape
    std::optional<double> water_pressure; ///< mean over the plane [Pa]; none: as RockWedge::water says
};

/// Force on the wedge besides weight and water: an anchor, a surcharge, water in a tension crack.
struct WedgeForce {
    std::string name;
    double force = 0.0;  ///< [N]
    double trend = 0.0;  ///< it pushes this way [rad]
    double plunge = 0.0; ///< positive down [rad]
};

enum class WedgeWater {
    dry,
    full ///< the planes are full of water that seeps out of the face: mean pressure gamma_w H/6 on both
};

struct RockWedge {
    double density = 0.0;         ///< of the rock [kg/m^3]
    std::optional<double> height; ///< H between the ends of the line of intersection, vertically [m]; with the surfaces
    std::optional<double> face_dip, face_dip_direction;   ///< of the slope's face [rad]
    std::optional<double> upper_dip, upper_dip_direction; ///< of the ground above it [rad]; default level
    std::optional<double> volume; ///< given instead of the surfaces, with the planes' areas [m^3]
    WedgeWater water = WedgeWater::dry;
    bool cohesion_lost_at_slip = true; ///< cohesion is gone from the first slip on
    std::optional<double>
        motion_azimuth;            ///< positive a_h drives the wedge this way [rad]; none: its own way of sliding
    std::vector<RockPlane> planes; ///< two
    std::vector<WedgeForce> forces;
};

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
