#pragma once

#include "sliding/block/slide.hpp"
#include "sliding/rocking/rocking_block.hpp"

namespace damslip::sliding {

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
