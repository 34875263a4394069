#pragma once

#include "core/geometry.hpp"
#include "sliding/block/rigid_block.hpp"
#include "sliding/block/slide.hpp"
#include "sliding/equilibrium/base_state.hpp"

#include <memory>
#include <optional>
#include <vector>

/// The rigid block that may stand on its toe or on its heel, and slide on either (docs/rocking.md).
namespace damslip::sliding {

/// Added mass of the water that moves with the block, in the directions of the base: t along it downstream, n up, r a
/// clockwise rotation about the heel. Force on the dam by its acceleration (s'', y'', theta''): minus this matrix times it.
/// As the dam stands before the earthquake; it does not follow the rotation.
struct BaseAddedMass {
    double tt = 0.0, tn = 0.0, nn = 0.0; ///< [kg/m]
    double tr = 0.0, nr = 0.0;           ///< [kg]
    double rr = 0.0;                     ///< [kg m]
};

/// Strength and uplift over the path slipped.
struct RockingStage {
    SlipStage slip;               ///< friction, cohesion and uplift are taken from it
    double uplift_distance = 0.0; ///< of U from the heel along the base [m]
};

/// The end at which an open joint takes water.
struct MouthEnd {
    UpliftResultant
        empty;          ///< of the joint open from end to end before water has come into it: that of the static crack
    double first = 0.0; ///< what the static crack holds, from the mouth [m]
    double pressure = 0.0; ///< of the water at the mouth [Pa]
    double gradient = 0.0; ///< of that pressure, from the mouth inwards [Pa/m]
};

/// Water that needs time to come into the joint (uplift.opening = "mouth"): the head of the mouth as far as it has come, x_w,
/// and nothing from there to the corner that stands. x_w grows by flat->speed() where the joint is open; while the block
/// stands on its whole base x_w is that of the crack of `flat`.
struct RockingMouth {
    std::shared_ptr<const SlowWater> flat;
    MouthEnd at_heel; ///< of the block that stands on its toe
    MouthEnd at_toe;  ///< of the block that stands on its heel
};

/// Everything the block's rocking and sliding depends on, per metre of dam length, in the directions of the base.
struct RockingBlock {
    double mass = 0.0;             ///< [kg/m]
    double inertia = 0.0;          ///< of the dam about its centroid [kg m]
    double length = 0.0;           ///< of the base [m]
    double base_inclination = 0.0; ///< theta of the base [rad], positive: dips downstream
    Point centroid;                ///< from the heel, along t and n [m]
    BaseAddedMass water;

    // Static loads without uplift: forces that keep size and direction, at points that move with the block.
    double force_t = 0.0; ///< downstream [N/m]
    double force_n = 0.0; ///< up; negative: the weight presses [N/m]
    double moment = 0.0;  ///< clockwise about the heel [N]
    double virial = 0.0;  ///< sum of force . (point - heel) [N]: how the moment changes as the block turns

    double cohesion = 0.0;            ///< of the bond before any slip [Pa]; 0: none
    Crack crack;                      ///< open before the earthquake: no bond there
    std::vector<RockingStage> stages; ///< by path, at least one

    /// Uplift on the toe and on the heel, the joint open from end to end; none: that of the stage (uplift.opening)
    std::optional<UpliftResultant> uplift_on_toe, uplift_on_heel;
    /// How the water comes in; none: what uplift_on_toe and uplift_on_heel name is there at once.
    std::optional<RockingMouth> mouth;
};

/// The block of a static state. Moments, added mass and uplift are those of tipping_acceleration, so the block starts to
/// rock where that says.
/// @param stages  of the same state; @param later  state whose uplift holds in stages with another uplift than the first;
/// null: there is none
RockingBlock make_rocking_block(const Scene& scene, const BaseState& state, const AddedMassIntegral& water,
                                const SlipStages& stages, const BaseState* later = nullptr);

/// The water of uplift.opening = "mouth" on its way into the joint of the block that rocks.
/// @param flat  the same water under the sliding block
RockingMouth rocking_mouth(const Scene& scene, const StaticCase& static_case, const BaseState& before,
                           std::shared_ptr<const SlowWater> flat, const SeepageProfile& seepage);

/// A dry block without water, uplift or cohesion on a horizontal base: a rectangle b wide and h high.
RockingBlock rectangular_block(double width, double height, double density, double gravity, double friction);

/// Work per metre of dam, from the start to the end [J/m]:
/// ground + loads = kinetic + friction + landings.
struct RockingEnergy {
    double ground = 0.0;    ///< of the inertia forces of the ground's acceleration
    double loads = 0.0;     ///< of weight, water and uplift
    double kinetic = 0.0;   ///< left at the end, relative to the rock
    double friction = 0.0;  ///< lost in sliding, >= 0
    double landings = 0.0;  ///< lost when a corner comes down, >= 0
    double imbalance = 0.0; ///< of the sum, over its largest term [-]
};

/// Slip, status and notes as of the sliding block; what it does beyond that one.
struct RockingResult {
    SlideResult slide;              ///< slip of the corner that stands; status also `overturned`
    double max_toe_rotation = 0.0;  ///< on the toe, heel up [rad]
    double max_heel_rotation = 0.0; ///< on the heel, toe up [rad]
    int rocks = 0;                  ///< times a corner left the rock from full contact, or from the other corner
    int landings = 0;
    double first_landing_time = std::numeric_limits<double>::quiet_NaN(); ///< [s]; NaN: none
    double first_rock_time = std::numeric_limits<double>::quiet_NaN();    ///< [s]; NaN: never
    double bond_lost_time = std::numeric_limits<double>::quiet_NaN();     ///< [s]; NaN: kept, or there was none
    double overturned_time = std::numeric_limits<double>::quiet_NaN();    ///< [s]; NaN: did not
    RockingEnergy energy;
    std::vector<double> rotation; ///< at the samples of slide.history, clockwise [rad]
    std::vector<double> uplift;   ///< U there, of the base or of the open joint [N/m]
};

/// How the block stands when the motion begins.
struct RockingStart {
    double rotation = 0.0;      ///< clockwise, on the toe; negative on the heel [rad]
    double rotation_rate = 0.0; ///< [rad/s]
};

/// The block under the motion, acceleration linear between samples, from rest on its whole base, or as `start` says.
///
/// It rests or slides on its base, or stands on toe or heel and rests or slides there (Corner), with Coulomb's friction of
/// the path slipped. Heel and toe leave the rock when N' reaches the other one. Landing: angular momentum about the corner
/// that comes down is kept (Housner 1963) and Coulomb's bound holds for the impulse along the base; where that would push the
/// other corner into the rock both stay, and the block stands. With `restitution` the angular rate after is that times the
/// one before, less where energy would be gained. While N' <= 0 there is no resistance, and no flight.
///
/// A bond holds where the joint is closed under the very loads of the instant (uplift unchanged): c A'(t) + mu N'; it is
/// lost at first slip, if contact says so, and where the base opens from end to end.
///
/// Between events Dormand & Prince's order 5, local error 1e-12 (m, m/s); events by bracketed roots of the step itself, to the
/// last digits. Run-out as of slide(). Status `overturned`: turned by 90 degrees.
///
/// @throws InputError for what check_motion and check_stages refuse
RockingResult rock_and_slide(const GroundMotion& motion, const RockingBlock& block, const SlideOptions& options = {},
                             const RockingStart& start = {});

} // namespace damslip::sliding
