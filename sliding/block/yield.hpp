#pragma once

#include "core/status.hpp"
#include "sliding/block/rigid_block.hpp"

/// Ground accelerations at which the block starts to slide.
///
/// Signs: x downstream, y up; a_h positive upstream (drives the block downstream), a_v positive up.
namespace damslip::sliding {

/// Yield acceleration as a linear function of the vertical ground acceleration: a_y = constant + per_a_v a_v [m/s^2].
struct YieldLaw {
    double constant = 0.0; ///< at a_v = 0 [m/s^2]
    double per_a_v = 0.0;  ///< [-]

    double at(double a_v) const { return constant + per_a_v * a_v; }
};

/// Yield in one direction and what the block does beyond it: |s''| = factor (|a_h| - a_y), a_h in the driving sense.
struct Yield {
    YieldLaw law;
    double factor = 1.0; ///< slip acceleration per excess ground acceleration [-]; 1 on a horizontal base
};

/// Downstream: the block slides while a_h > a_y, s'' = factor (a_h - a_y). Base inclined by theta (positive dips
/// downstream), any added mass tensor; t, n and A as in BaseEquations, q = t + mu n:
///
///     a_y    = [c A' - q.F - mu U + a_v q.A y] / (q.A x),     factor = q.A x / q.A t
///
/// With M^w = (M_w, 0, 0), M = m + M_w, V = m (g + a_v) + vertical force and k = cos(theta) + mu sin(theta) that is
///
///     a_y    = [c A' + mu (V cos(theta) - U - W_s sin(theta)) - W_s cos(theta) - V sin(theta)] / (M k),
///     factor = M k/(m + M_w k cos(theta)).
///
/// With theta = 0 that is a_y = [mu (G - U) - W_s]/(m + M_w) of Goldgruber (2015), eq. (4-3), and factor 1 (4-1). With
/// M_w = U = W_s = c = 0 it is Newmark (1965):
///
///     a_y = g tan(phi - theta),   s'' = (a_h - a_y) cos(phi - theta)/cos(phi).
///
/// Negative: the block slides without any earthquake; returned as it is, never clamped. Infinite where the ground
/// cannot make the block slide this way however strong it is (q.A x <= 0: a base so steep that a push along it only
/// presses); then per_a_v = 0, factor = 0. Lift-off (N' = 0) is not part of the law: see slide().
Yield yield_downstream(const RigidBlock& block);

/// Upstream: the block slides while -a_h > a_y^-, s'' = factor (a_h + a_y^-) < 0. With q = t - mu n and
/// k^- = cos(theta) - mu sin(theta):
///
///     a_y^-  = [c A' + mu (V cos(theta) - U - W_s sin(theta)) + W_s cos(theta) + V sin(theta)] / (M k^-),
///     factor = M k^-/(m + M_w k^- cos(theta)).
///
/// k^- <= 0 (mu tan(theta) >= 1): infinite, see yield_downstream.
Yield yield_upstream(const RigidBlock& block);

/// Downstream yield acceleration at the vertical ground acceleration a_v [m/s^2].
double yield_acceleration(const RigidBlock& block, double a_v = 0.0);

/// What the block does under its static forces alone.
enum class StaticState {
    at_rest,
    slides_downstream, ///< a_y < 0
    slides_upstream,   ///< a_y^- < 0
    lifts_off          ///< N' <= 0: the uplift carries more than the weight
};
StaticState static_state(const RigidBlock& block);
/// The same for a block that does not stand: static_failure or floats.
Status status_of(StaticState state);

/// Static normal force N' before the earthquake [N/m]; negative: the block floats.
double static_normal_force(const RigidBlock& block);

/// Friction at which the block just stands without an earthquake, either direction [-]: (|drive| - c A') / N', at least
/// 0; infinite when N' <= 0.
double critical_friction(const RigidBlock& block);

} // namespace damslip::sliding
