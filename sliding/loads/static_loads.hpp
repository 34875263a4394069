#pragma once

#include "core/geometry.hpp"
#include "scene/scene.hpp"

#include <optional>
#include <string>
#include <vector>

namespace damslip::sliding {

/// A force per metre of dam length and its moment about the origin (the heel).
/// Signs: x downstream, y up, moment counter-clockwise: M = X Fy - Y Fx, so a downstream thrust above the heel has M <
/// 0.
struct Force {
    double x = 0.0;      ///< [N/m]
    double y = 0.0;      ///< [N/m]
    double moment = 0.0; ///< about the origin [N m/m]

    Force& operator+=(const Force& other)
    {
        x += other.x;
        y += other.y;
        moment += other.moment;
        return *this;
    }
    friend Force operator+(Force a, const Force& b) { return a += b; }
    friend Force operator*(double factor, const Force& f) { return {factor * f.x, factor * f.y, factor * f.moment}; }
    friend bool operator==(const Force&, const Force&) = default;
};

/// The force (x, y) [N/m] acting at a point [m].
inline Force force_at(Point at, double x, double y)
{
    return {x, y, at.x * y - at.y * x};
}

/// Moment of the force about another point [N m/m].
inline double moment_about(const Force& f, Point p)
{
    return f.moment - (p.x * f.y - p.y * f.x);
}

/// A distributed load in its horizontal and vertical part; each carries its own moment, so that stabilising and
/// overturning parts can be told apart.
struct FaceLoad {
    Force horizontal; ///< y = 0
    Force vertical;   ///< x = 0
    Force total() const { return horizontal + vertical; }
};

/// On which side of the face the dam lies when walking along it in the order of its points.
enum class DamSide {
    right, ///< upstream face, heel to crest
    left   ///< downstream face, toe to crest; crest, downstream end to upstream end
};

/// Resultant of the pressure p = unit_weight (level - y) on those parts of the face that lie below `level`: -p n with n
/// out of the dam, integrated exactly (p is linear along each straight piece, pieces are cut at the level). Water
/// stands on top of a piece that leans away from it (pushes down) and below an overhanging one (pushes up).
/// @param unit_weight  rho g [N/m^3]
/// @param level        of the surface [m]; a face entirely above it carries nothing
FaceLoad hydrostatic_load(const Polyline& face, DamSide side, double level, double unit_weight);

/// Horizontal earth-pressure thrust of sediment on the upstream face: K_s gamma' (level - y) on the vertical projection
/// of the face, 1/2 K_s gamma' h_s^2 on a face that reaches from the bottom to above the sediment, whatever its slope.
/// The weight of sediment resting on an inclined face is left out (safe side); give it as a point force where it is
/// wanted.
Force silt_thrust(const Polyline& upstream_face, double level, double submerged_unit_weight,
                  double pressure_coefficient);

enum class LoadKind {
    weight,
    reservoir,
    crest_water,
    tailwater,
    silt,
    ice,
    point_force,
    inertia,
    hydrodynamic,
    anchor
};

/// One load on the block, uplift excepted (it depends on the crack, see uplift/).
struct Load {
    LoadKind kind;
    std::string name;
    FaceLoad force; ///< horizontal and vertical part, after the load factor
};

enum class IceLoad { off, on };

/// Which force an anchor through the base has: its prestress (before any slip), or the one that limit equilibrium takes.
enum class AnchorForce { prestress, limit };

/// Water levels and factors of one load case; what is not given is the scene's.
struct LoadCase {
    std::optional<double> reservoir_level; ///< above the heel [m]; none: no water upstream
    std::optional<double> tailwater_level; ///< above the heel [m], may be negative with a toe below the heel; none: dry
    bool gates_open = false; ///< of a scene with gates: the water flows over the crest
    IceLoad ice = IceLoad::on;
    AnchorForce anchors = AnchorForce::prestress;
    double weight_factor = 1.0; ///< on the dam's weight [-]
    double water_factor = 1.0;  ///< on reservoir, tailwater and water on the crest [-]
    double silt_factor = 1.0;   ///< [-]
    double ice_factor = 1.0;    ///< [-]
};

/// The scene as it stands: its levels, its ice, factors 1.
LoadCase scene_load_case(const Scene& scene);

/// Force of an anchor in a load case [N/m].
double force_of(const Anchor& anchor, AnchorForce which);

/// Mass of the dam, of its concrete alone where the section has a thickness [kg/m].
double dam_mass(const Scene& scene);

/// All static loads of a case: weight at the centroid; water pressure on the wet part of the actual faces; sediment;
/// ice; point forces; anchors through the base, -N d on the dam where they cross it, without any slip. Overtopping (level above the crest): the faces carry the trapezoid below the crest, and the flat
/// crest between the two faces carries the still water standing on it, weight rho g (level - crest) b; flow, nappe and
/// suction are not covered. Gates (Scene::gate) carry the water above the crest in the plane of the upstream face's upper end, and
/// the crest is dry; gates between piers of the outline (Section::thickness) leave the load of the whole face, and open ones
/// that on the piers' share of it. With both sides above the crest the higher level loads it. Ice acts at its own level; where
/// that is the scene's water surface it follows the surface of the load case.
std::vector<Load> static_loads(const Scene& scene, const LoadCase& load_case);

/// Sum of all loads.
Force resultant(const std::vector<Load>& loads);

} // namespace damslip::sliding
