#pragma once

#include "sliding/rocking/rocking_block.hpp"

namespace damslip::sliding {

/// What the block stands on.
enum class Stance { base, toe, heel };

/// Ground acceleration in the directions of the base [m/s^2]: along it downstream, and up from it.
struct BaseAcceleration {
    double t = 0.0, n = 0.0;
};
/// @param a_h, a_v  upstream and up positive, as everywhere
BaseAcceleration in_base_directions(double base_inclination, double a_h, double a_v);

/// The block seen from a corner of its base. All about that corner; rotation theta clockwise, positive for a block that
/// stands on its toe, negative for one on its heel.
///
/// With rho = R(theta) (centroid - corner) and q = (s, theta), s the slip of the corner downstream:
///
///     (m + M_tt) s'' + (m rho_n + M_tr) theta'' = F_t + T - (m + M_tt) a_t - M_tn a_n + m theta'^2 rho_t
///     (m rho_n + M_tr) s'' + J theta''          = Q(theta) - m (rho_n a_t - rho_t a_n) - M_tr a_t - M_nr a_n
///     N' = -(F_n + U) + (m + M_nn) a_n + M_tn (a_t + s'') - m theta'^2 rho_n + (M_nr - m rho_t) theta''
///
/// J = I + m |rho|^2 + M_rr;  Q(theta) = cos theta Q(0) - sin theta (sum of force . (point - corner)).
/// The equations of Shenton (1996) for a general body with dead loads and added mass; T is the friction on the block,
/// downstream positive.
struct Corner {
    double sense = 1.0; ///< +1 toe, -1 heel: the way it turns
    Point arm;          ///< from the corner to the centroid at theta = 0 [m]
    double mass = 0.0;  ///< of the dam [kg/m]
    BaseAddedMass water;
    double inertia = 0.0;                ///< J [kg m]
    double force_t = 0.0, force_n = 0.0; ///< static loads with uplift [N/m]
    double moment = 0.0;                 ///< Q(0), with uplift [N]
    double virial = 0.0;                 ///< [N]

    /// From the corner to the centroid of the turned block.
    Point turned(double theta) const;
    /// Clockwise moment of the static loads on the turned block [N].
    double static_moment(double theta) const;
};

/// @param stage  whose uplift counts on the base, and on a corner where the block has no other uplift for it
/// @param stance  base: about the toe
Corner corner(const RockingBlock& block, const RockingStage& stage, Stance stance);

/// Uplift of the joint that is open to the corner `stance` and holds water as far as `wet` from its mouth [m].
UpliftResultant mouth_uplift(const RockingBlock& block, Stance stance, double wet);

/// The corner with another uplift.
Corner with_uplift(Corner corner, const RockingBlock& block, const UpliftResultant& uplift);

/// The equations of a corner at one instant: mass terms and right-hand sides.
struct CornerEquations {
    double tt = 0.0, tr = 0.0, rr = 0.0; ///< of s'', of both, of theta''
    double nt = 0.0, nr = 0.0;           ///< N' per s'' and per theta''
    double push = 0.0;                   ///< of the first, without T [N/m]
    double turn = 0.0;                   ///< of the second [N]
    double press = 0.0;                  ///< of the third: N' without accelerations [N/m]
};
CornerEquations equations(const Corner& corner, double theta, double rate, const BaseAcceleration& ground);

/// Momentum (along, up, about the corner) of a block that moves with its corner (v_t, v_n) and turns, at theta = 0.
struct Momentum {
    double t = 0.0, n = 0.0, r = 0.0;
};
Momentum momentum(const Corner& corner, double v_t, double v_n, double rate);

/// Kinetic energy relative to the rock [J/m], added mass included.
double kinetic_energy(const Corner& corner, double theta, double slip_rate, double rate);

} // namespace damslip::sliding
