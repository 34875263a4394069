#pragma once

#include "scene/anchor_bar.hpp"
#include "scene/scene.hpp"
#include "sliding/block/rigid_block.hpp"
#include "sliding/loads/added_mass_integral.hpp"
#include "sliding/loads/static_loads.hpp"
#include "sliding/uplift/crack.hpp"

#include <optional>
#include <vector>

namespace damslip::sliding {

/// Directions of the base: t along it downstream, n normal to it, up.
struct BaseFrame {
    double length = 0.0;      ///< [m]
    double inclination = 0.0; ///< theta [rad], positive: dips downstream
    Point t, n;               ///< unit vectors: (cos, -sin), (sin, cos)
};
BaseFrame base_frame(const Scene& scene);

/// A force resolved on the base: normal compression and the moment about the heel.
BaseLoad base_load(const BaseFrame& frame, const Force& force);

/// Shear along the base, positive downstream [N/m].
double shear(const BaseFrame& frame, const Force& force);

/// What one static state needs besides the scene.
struct StaticCase {
    LoadCase loads;
    UpliftState uplift;
    double uplift_factor = 1.0; ///< on all uplift pressures [-]
    CrackRule crack =
        CrackRule::none; ///< none: whole base, tension allowed; any other: no-tension joint under the static loads
    Crack opened;        ///< joint that holds water already [m]
};

/// The scene as it stands, its own crack rule.
StaticCase scene_static_case(const Scene& scene);

/// The block on its base under static loads.
struct BaseState {
    BaseFrame frame;
    std::vector<Load> loads;                                                    ///< uplift excepted
    Force load;                                                                 ///< their sum
    CrackedBase base;                                                           ///< uplift, crack, N' and its position
    Crack opened;                                                               ///< as given
    double dowel_force = 0.0;                                                   ///< of grouted anchors [N/m]
    double cohesive_length() const { return frame.length - base.crack.length; } ///< A' [m]
};

/// Uplift (times the case's factor) for a crack, as the crack search wants it.
CrackUplift crack_uplift(const Scene& scene, const UpliftState& state, double factor, const SeepageProfile& seepage);

/// Static loads, uplift and crack in equilibrium.
BaseState base_state(const Scene& scene, const StaticCase& static_case, const SeepageProfile& seepage = {});

/// What the sweeps vary.
struct BlockOptions {
    std::optional<double> friction; ///< mu [-]; default: contact.friction, or the first value of contact.friction_table
    std::optional<double> cohesion; ///< c [Pa]; default: contact.cohesion
    std::optional<CrackRule> crack; ///< default: uplift.crack
    DrainState drains = DrainState::effective;   ///< ineffective: E = 0, e.g. after drains.lost_at_slip
    CurtainState curtain = CurtainState::intact; ///< damaged: linear uplift, e.g. after a rupture
    SeepageProfile seepage;                      ///< for uplift.model = "seepage"
};

/// Resistance of grouted anchors through the base with their forces of a load case [N/m].
double dowel_force(const Scene& scene, AnchorForce which);

/// The anchors through the base, for the sliding block.
std::vector<AnchorBar> base_anchors(const Scene& scene);

/// The rigid block of the scene: weight, static forces, uplift, cohesion on the uncracked length, added mass of the
/// reservoir. Sums: horizontal_force = sum of Fx of all loads, vertical_force = -(sum of Fy) - weight; they are exact
/// for an inclined base too.
RigidBlock make_rigid_block(const Scene& scene, const BlockOptions& options = {});

/// The same from a state that is known already; `reservoir_level` gives the depth of the added mass.
RigidBlock make_rigid_block(const Scene& scene, const BaseState& state, std::optional<double> reservoir_level,
                            const BlockOptions& options = {});

} // namespace damslip::sliding
