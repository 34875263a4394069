#pragma once

#include "scene/scene.hpp"
#include "sliding/loads/face_pressure.hpp"

#include <optional>
#include <string>
#include <vector>

namespace damslip::sliding {

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

/// Mass of the dam [kg/m].
double dam_mass(const Scene& scene);

/// All static loads of a case: weight at the centroid; water pressure on the wet part of the actual faces; sediment;
/// ice; point forces; anchors through the base, -N d on the dam where they cross it, without any slip. Overtopping (level above the crest): the faces carry the trapezoid below the crest, and the flat
/// crest between the two faces carries the still water standing on it, weight rho g (level - crest) b; flow, nappe and
/// suction are not covered. Gates (Scene::gate) carry the water above the crest in the plane of the upstream face's upper end, and
/// the crest is dry. With both sides above the crest the higher level loads it. Ice acts at its own level; where
/// that is the scene's water surface it follows the surface of the load case.
std::vector<Load> static_loads(const Scene& scene, const LoadCase& load_case);

/// Sum of all loads.
Force resultant(const std::vector<Load>& loads);

} // namespace damslip::sliding
