#pragma once

#include "core/geometry.hpp"
#include "records/record.hpp"
#include "sliding/block/rigid_block.hpp"
#include "sliding/block/slide_batch.hpp"

#include <optional>

/// A rock wedge on two planes, whose way of sliding is found, not assumed. Hoek & Bray (1981), Rock Slope Engineering,
/// app. 2; Goodman (1989), Introduction to Rock Mechanics, ch. 8; cases after Warburton (1981), Int. J. Rock Mech. Min.
/// Sci. 18.
namespace damslip::sliding {

using damslip::Vector3; ///< x east, y north, z up

struct WedgePlane {
    double dip = 0.0;           ///< from the horizontal, 0 ... pi/2 [rad]
    double dip_direction = 0.0; ///< clockwise from north [rad]
    double area = 0.0;          ///< [m^2]
    double friction = 0.0;      ///< tan phi [-]
    double cohesion = 0.0;      ///< c [Pa]
    double water_force = 0.0;   ///< normal to the plane, lifts the wedge [N]
};

/// The wedge lies above both planes.
struct Wedge {
    WedgePlane first, second;
    double mass = 0.0;     ///< [kg]
    double gravity = 9.81; ///< [m/s^2]
    Vector3 force{};       ///< besides weight and water: anchors, surcharge [N]
};

enum class WedgeMode { both_planes, first_plane, second_plane, lifts };

/// The wedge under its weight, the water, steady forces and the inertia force m (a e - a_v z).
struct WedgeState {
    WedgeMode mode = WedgeMode::both_planes;
    Vector3 direction{};           ///< it slides this way, or would [-]
    double first_normal = 0.0;     ///< effective, compression positive [N]
    double second_normal = 0.0;    ///< [N]
    double drive = 0.0;            ///< force along the direction [N]
    double cohesion = 0.0;         ///< c A of the planes in contact [N]
    double resistance = 0.0;       ///< cohesion and friction of the planes in contact [N]
    double factor_of_safety = 0.0; ///< resistance / drive; 0 when it lifts, infinite without drive
};

/// @param push  e, unit vector of the inertia force, opposite to the ground acceleration; need not be horizontal
/// @param accel  a [m/s^2]
/// @param accel_v  vertical ground acceleration a_v, positive up: makes the wedge heavier [m/s^2]
/// @throws InputError for parallel planes, mass <= 0, dips outside 0 ... pi/2, negative strength, areas or water
WedgeState wedge_state(const Wedge& wedge, const Vector3& push = {}, double accel = 0.0, double accel_v = 0.0);

/// Friction, the same on both planes, at which the wedge just stands as it is in `state` [-]: (drive - c A)/(N_1 + N_2), at
/// least 0; infinite when it lifts. The way of sliding does not depend on friction.
double critical_friction(const WedgeState& state);

struct WedgeYield {
    /// Smallest a >= 0 with a factor of safety of 1. Negative, of the least size: slides without an earthquake, and would just
    /// stand pushed the other way by as much. Infinite: none below 10 g either way [m/s^2]
    double acceleration = 0.0;
    double factor = 0.0; ///< slip acceleration per excess ground acceleration, the way of sliding kept [-]
    WedgeState state;    ///< at the yield; without earthquake where there is none
    YieldLaw law;        ///< a_y = constant + per_a_v a_v of that way of sliding; constant: `acceleration` [m/s^2]
};

/// Looks at a in steps of g/200 and locates the first crossing in a bracket.
WedgeYield wedge_yield(const Wedge& wedge, const Vector3& push);

/// The same way of sliding when the cohesion is gone.
WedgeYield without_cohesion(const Wedge& wedge, WedgeYield yield);

/// Newmark's slip along the direction of sliding at the yield, one way, by the integrator of the rigid block.
/// @param motion  a_h is the ground acceleration opposite to `push`: positive drives the wedge; a_v is not used
SlipSummary slide_wedge(const GroundMotion& motion, const WedgeYield& yield, const ConstantYieldOptions& options = {});

/// Yields of a wedge before and after its first slip, one way of sliding.
struct WedgeYields {
    WedgeYield at_rest;
    std::optional<WedgeYield> moving; ///< from the first slip on; none: the same
};

/// The general integrator slide() for the wedge, vertical motion and run-out included. With s the slip along the way of sliding,
///
///     s'' = factor (a_h - per_a_v a_v - constant),
///
/// so s/factor is the slip of a block on a level plane with the yield `constant` under the ground acceleration
/// a_h - per_a_v a_v: that block is followed, exactly. One way; lift-off and another way of sliding during the motion are
/// not followed: see share_of_other_modes.
/// @returns slip along the way of sliding; history: yield is that of a_h, no normal force, no gap
SlideResult slide_wedge(const GroundMotion& motion, const WedgeYields& yields, const SlideOptions& options);

/// Share of the samples beyond the yield at which the wedge would start another way than at the yield: on other planes, or
/// lifting [-]; 0 without such samples.
double share_of_other_modes(const Wedge& wedge, const Vector3& push, const GroundMotion& motion,
                            const WedgeYield& yield, int polarity);

} // namespace damslip::sliding
