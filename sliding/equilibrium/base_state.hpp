#pragma once

#include "scene/anchor_bar.hpp"
#include "scene/scene.hpp"
#include "sliding/block/rigid_block.hpp"
#include "sliding/loads/added_mass.hpp"
#include "sliding/loads/static_loads.hpp"
#include "sliding/uplift/uplift.hpp"

#include <limits>
#include <memory>
#include <optional>
#include <vector>

namespace damslip::sliding {

/// Directions of the base: t along it downstream, n normal to it, up.
struct BaseFrame {
    double length = 0.0;      ///< [m]
    double inclination = 0.0; ///< theta [rad], positive: dips downstream
    double share = 1.0;       ///< of the width that is concrete, Section::thickness [-]
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
    double cohesive_length() const { return frame.share * (frame.length - base.crack.length); } ///< A' [m^2/m]
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

/// Loads of the ground acceleration (-a_h, +a_v) [m/s^2]: inertia (+m a_h, -m a_v) at the centroid and the added mass'
/// force. a_h is positive upstream: it drives the dam downstream.
/// @param profile  factor on the inertia over the height, as Combination::k_profile
std::vector<Load> earthquake_loads(const Scene& scene, const AddedMassIntegral& water, double a_h, double a_v,
                                   const Polyline& profile = {});

/// The base under static and earthquake loads together (`load`), from the static state `before`; see `evaluate` for the
/// crack rules.
CrackedBase shaken_base(const Scene& scene, const StaticCase& static_case, const BaseState& before, const Force& load,
                        const SeepageProfile& seepage);

/// Pressure of the static state with that part of the joint set to zero which the earthquake opens.
PressureProfile without_new_crack(const BaseState& before, const Crack& crack);

/// Uplift of a joint open from end to end, by uplift.opening: `zero` nothing but what the crack of the static state holds,
/// `full` and `mouth` the higher of the heads at both ends along the whole base.
/// @param opens  the end at which the base leaves the rock
/// @returns none where uplift.opening leaves the uplift as it is: unchanged, reynolds, no uplift
std::optional<UpliftResultant> uplift_of_open_joint(const Scene& scene, const StaticCase& static_case,
                                                    const BaseState& before, Side opens, const SeepageProfile& seepage);

/// The same joint before any water has come into it, whatever uplift.opening says: what `zero` leaves.
UpliftResultant uplift_of_empty_joint(const BaseState& before, Side opens);

/// The static state with the uplift of the joint that is open from `opens` to the other end, where uplift.opening names one:
/// what tips about that other end stands on it.
BaseState with_open_joint(const Scene& scene, const StaticCase& static_case, const BaseState& before, Side opens,
                          const SeepageProfile& seepage);

/// Area still bonded [m^2/m], the length times the share of the base: neither in the static crack nor in the one under the
/// earthquake.
double bonded_length(const BaseState& before, const CrackedBase& base);

// How far the ground may accelerate before the dam is no longer a block that stands flat on its base.

enum class Towards { downstream, upstream };

/// Ground acceleration |a_h| at which the dam tips about its toe (upstream: its heel): the moments of the static loads, of
/// the uplift and of inertia and water under it cancel there,
///
///     M_static + U-moment + a_h (m y_c + moment of M^w per a_h) = 0,
///
/// uplift as in the static state `before`. A dry rectangle b wide and h high: a_h = g b/h.
/// @param water, before, a_v  added mass; static state; vertical ground acceleration at the same instant [m/s^2]
/// @returns [m/s^2]; negative: it tips without an earthquake; infinite: no acceleration tips it that way
double tipping_acceleration(const Scene& scene, const AddedMassIntegral& water, const BaseState& before, double a_v,
                            Towards towards);

/// Constant horizontal ground accelerations at which the sliding block ends to be a model of the dam, without vertical
/// acceleration.
struct BaseLimits {
    /// About the toe, with the uplift of the joint that is open then where uplift.opening says one, else unchanged; there the
    /// block that rocks begins to [m/s^2].
    double tips = std::numeric_limits<double>::infinity();
    double tips_upstream = std::numeric_limits<double>::infinity(); ///< about the heel [m/s^2]
    /// Downstream: from here on the joint is open from heel to toe, and whatever bond it had is lost [m/s^2]. By the crack
    /// rule of the state; `none` and `static` say nothing of what the earthquake opens, `seismic-unchanged` is taken.
    double opens = std::numeric_limits<double>::infinity();
    /// Downstream: it slides here with the crack that the same acceleration opens, and the uplift in it, by the same rule as
    /// `opens`, and with the bond of the rest; smallest root of c A'(a) + mu N'(a) = T(a) [m/s^2]. The yield acceleration
    /// has the crack, uplift and bond of the static state.
    double yield_with_crack = std::numeric_limits<double>::infinity();
};

/// @param crack  in place of the scene's uplift.crack, if given
BaseLimits base_limits(const Scene& scene, const SeepageProfile& seepage = {},
                       std::optional<CrackRule> crack = std::nullopt);

/// The dam above a lift joint as a scene of its own, in whose axes the joint is the base: section, water, silt, ice and
/// forces above the joint, the joint's strength and its anchors; no rock, curtain or drains. Uplift is the water in the joint, linear
/// between the two faces where LiftJoint::water says so. The added mass of such a scene is not that of the dam (it
/// depends on the depth of the whole reservoir): see lift_block.
Scene scene_above(const Scene& scene, const LiftJoint& joint);

/// The block above a lift joint on it: the rigid block of scene_above with the added mass of the whole reservoir on the
/// face above the joint. The dam below is taken as rigid: that it amplifies the ground motion is left out, so the
/// block's yield acceleration is one of the joint, not of the ground.
RigidBlock lift_block(const Scene& scene, const LiftJoint& joint);

/// The rule of the crack that opens while the base is shaken, by uplift.opening.
/// @returns none where the opening leaves the block's uplift as it is: unchanged, reynolds
std::optional<CrackRule> crack_rule_while_open(OpeningWater opening);

/// Uplift of the block that slides with the crack its own acceleration opens, by uplift.opening of the scene: the smallest
/// a_h with
///
///     drive(a_h) = c A' + mu N'(a_h),   N' = N - U(x_t),   L - x_t = 3 x (distance of N' from the compressed end)
///
/// found by a scan over x_t, for the resistance need not fall steadily. c A' is that of the static state. Water
/// that needs time to enter (mouth) is taken to have had it, as full, and comes beside it as OpeningUplift::slow; of a crack
/// that runs through at once the last state before it counts (base_limits() says where).
/// @param block  of `before`, with its friction
/// @param vertical  for all vertical accelerations to 1 g, in steps of 0.01 g; else for none
/// @returns null where uplift.opening leaves the block's uplift as it is: unchanged, reynolds (a block has no width of the
/// joint), no uplift
std::shared_ptr<const OpeningUplift> opening_uplift(const Scene& scene, const StaticCase& static_case,
                                                    const BaseState& before, const RigidBlock& block, bool vertical,
                                                    const SeepageProfile& seepage);

} // namespace damslip::sliding
