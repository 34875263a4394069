#pragma once

#include "core/status.hpp"
#include "scene/scene.hpp"
#include "sliding/block/roots.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

namespace damslip::sliding {

enum class SlipDirection { downstream = 1, upstream = -1 };

class SlowWater;

/// Change of the uplift of a block by the crack that its own motion opens, for each direction of sliding [N/m]. The block
/// keeps the acceleration at which sliding began, so one crack length holds for the whole slide; only the vertical
/// acceleration changes it. A block that does not slide needs no uplift of its crack.
struct OpeningUplift {
    std::vector<double> accel_v;              ///< a_v, ascending, at least one [m/s²]
    std::vector<double> downstream, upstream; ///< change of U there, linear between, constant beyond [N/m]
    /// Water that needs time to come in; the table is then its limit for fast water. Null: it is there at once.
    std::shared_ptr<const SlowWater> slow = {};

    double at(SlipDirection direction, double a_v) const;
    double per_accel_v(SlipDirection direction) const; ///< about a_v = 0 [kg/m]
    double largest() const;                            ///< of both directions, at least 0
    double largest(SlipDirection direction, double a_v_min, double a_v_max) const; ///< there; slow: with no water yet
    /// Share of the way of a_v at which the table bends next. @param from  the share so far @returns 1 where it does not
    double next_bend(const Line& a_v, double from) const;
};

/// Where the water and the crack of one end of the base are, and what that makes of the uplift.
struct WetCrack {
    double wet = 0.0;    ///< x_w, how far water has come [m]
    double tip = 0.0;    ///< x_t of the crack [m]
    double change = 0.0; ///< of the uplift against that before any motion [N/m]
};

/// Water that comes into the crack of a rigid block with a finite speed: full head to x_w, nothing from there to the tip
/// x_t, beyond it what a crack of length x_w leaves. x_w follows the tip with `speed` at most and is driven out by it.
/// While the block slides its crack is that of its own acceleration, so the change of U is one number for each x_w.
/// The heel's crack belongs to sliding downstream, the toe's to sliding upstream.
class SlowWater {
public:
    virtual ~SlowWater() = default;
    virtual double speed() const = 0;                        ///< v_w [m/s]
    virtual double length() const = 0;                       ///< of the base [m]
    virtual double first(SlipDirection direction) const = 0; ///< x_w before any motion [m]
    /// x_w of a block at rest under (a_h, a_v) [m/s²], from `now` on or back: as far as `come` where the crack opens so far,
    /// and never beyond its tip.
    virtual double front(SlipDirection direction, double a_h, double a_v, double now, double come) const = 0;
    /// The same by a table of half the resolution, which shows its error; null: there is no table.
    virtual std::shared_ptr<const SlowWater> coarser() const { return nullptr; }
    /// While it slides.
    virtual WetCrack sliding(SlipDirection direction, double a_v, double wet) const = 0;
};

/// Parts of an interval dt in which the water of the block that rocks is brought forward: it comes less than 1/128 of the
/// base in one, where that takes at most 64.
inline int parts(const SlowWater& water, double dt)
{
    return static_cast<int>(std::clamp(std::ceil(128.0 * water.speed() * dt / water.length()), 4.0, 64.0));
}

// The rigid block on its base plane, and the ground accelerations at which it starts to slide.

/// Added mass of the water that moves with the block: M^w = integral of m n n^T over the wet face [kg/m].
/// A vertical face has xx only.
struct AddedMassTensor {
    double xx = 0.0, xy = 0.0, yy = 0.0;
};

/// Everything the sliding of one block depends on, per metre of dam length. Static forces are those before the
/// earthquake.
struct RigidBlock {
    double mass = 0.0;          ///< m [kg/m]
    AddedMassTensor added_mass; ///< moves with the block [kg/m]
    double chain_mass = 0.0;    ///< resists along the base but is not driven by the ground: M* - H of a chain of blocks [kg/m]
    double gravity = 9.81;      ///< of the site [m/s^2]; the weight is mass * gravity
    double vertical_force =
        0.0; ///< static, downward, besides the weight: water on sloping faces, silt, user forces, anchors [N/m]
    double horizontal_force =
        0.0;             ///< static, downstream: hydrostatic thrust less tailwater, silt, ice, user forces [N/m]
    double uplift = 0.0; ///< U, normal to the base, lifts the block [N/m]
    double cohesion_force = 0.0;                       ///< c A' [N/m]
    double dowel_force = 0.0;                          ///< of grouted anchors, resists slip either way [N/m]
    double friction = 0.0;                             ///< mu [-]
    double base_inclination = 0.0;                     ///< theta [rad], positive: dips downstream
    std::shared_ptr<const OpeningUplift> opening = {}; ///< of `uplift` while it slides; null: none
};

/// A quantity that is linear in the ground acceleration: constant + per_a_h a_h + per_a_v a_v.
struct GroundLinear {
    double constant = 0.0;
    double per_a_h = 0.0;
    double per_a_v = 0.0;

    double at(double a_h, double a_v) const { return constant + per_a_h * a_h + per_a_v * a_v; }
};

/// The equation of motion (m I + M^w)(a_g + s'' t + y'' n) = F + (U + N') n - R t of a block on its base, in components
/// along the base, t = (cos theta, -sin theta) downstream, and normal to it, n = (sin theta, cos theta) up. With A = m
/// I + M^w, a_g = (-a_h, +a_v) and F = (horizontal_force, -(m g + vertical_force)):
///
///     mass_tt s'' + mass_tn y'' = drive - R          drive  = t.F - t.A a_g
///     mass_tn s'' + mass_nn y'' = N' - normal        normal = n.A a_g - n.F - U   (N' of a block that does not
///     accelerate over its base)
///
/// R is positive when it resists downstream slip. Forces in N/m, masses in kg/m.
struct BaseEquations {
    GroundLinear drive;
    GroundLinear normal;
    double mass_tt = 0.0;
    double mass_tn = 0.0;
    double mass_nn = 0.0;
};

BaseEquations base_equations(const RigidBlock& block);

inline double sign(SlipDirection direction)
{
    return static_cast<double>(direction);
}

/// Mass that a block in contact and sliding in `direction` shows to the force along the base: t.A t +- mu n.A t [kg/m].
/// Positive for a meaningful block; zero or less (large added mass, steep base, high friction) means the block jams:
/// see check_block.
double sliding_mass(const BaseEquations& equations, double friction, SlipDirection direction);

/// What is missing to sliding in `direction`, sign reversed: sign drive - c A' - dowel - mu normal [N/m]. Positive: it slides.
GroundLinear excess_drive(const BaseEquations& equations, const RigidBlock& block, SlipDirection direction);

/// Normal force of a block that slides without any resistance, normal + mass_tn drive / mass_tt [N/m]. Its sign is also
/// the sign of N' of a cohesionless block in contact, whatever its friction: negative means the base opens.
GroundLinear free_normal_force(const BaseEquations& equations);

/// @throws InputError when mass <= 0, friction < 0, cohesion < 0, a value is not finite, the added mass is not positive
/// semi-definite, |theta| >= 90 degrees, or sliding_mass <= 0 in one of the directions.
void check_block(const RigidBlock& block);

/// What the block is once it has slipped a given path. Slip-dependent strength and loads are a list of these: cohesion
/// lost at first slip, peak and residual friction, friction tables, drains sheared off (another uplift).
struct SlipStage {
    /// Path slipped so far, the sum of |slip| in both directions, from which on the stage holds [m]. The first stage
    /// has 0 and is the block at rest; a further stage with 0 takes over as soon as the block moves at all.
    double from_slip = 0.0;
    RigidBlock block;            ///< friction: its value at from_slip
    double friction_slope = 0.0; ///< d mu / d path within the stage [1/m]; 0: constant
    RateFriction rate = {};      ///< how friction falls with the rate of slip, on top of its value over the path
    double restitution = 0.0;    ///< of landings after a ballistic flight: rate after over rate before [-]
};

/// Stages by ascending from_slip, at least one.
using SlipStages = std::vector<SlipStage>;

/// The stages of one block with the strength of the scene's contact: FrictionOverSlip, friction over the rate, cohesion lost
/// at first slip, restitution. `block.cohesion_force` is c A'; `block.friction` is overwritten by the contact's.
SlipStages strength_stages(RigidBlock block, const Contact& contact);

/// Other static forces and masses from a path on, the strength staying as it is: drains lost at slip (a higher uplift).
/// Friction, its slope and the cohesion force are those of `stages`; everything else is taken from `later`.
SlipStages with_block_from(const SlipStages& stages, double from_slip, const RigidBlock& later);

/// Friction of a stage at a path [-], not below zero.
double friction_at(const SlipStage& stage, double path);

/// @throws InputError for an empty or unordered list, friction that a slope takes below zero, and what check_block
/// refuses.
void check_stages(const SlipStages& stages);

// A block whose yield acceleration is known, without the section that it would follow from.

/// Yield acceleration once the block has slipped a path.
struct YieldPoint {
    double path = 0.0;  ///< sum of |slip| in both directions [m]
    double yield = 0.0; ///< [m/s^2], >= 0
};

/// Stages of a block on a horizontal base, without water, whose yield is `points.front().yield` at rest, follows the straight
/// lines between the points and stays at the last: a block of 1 kg/m under a gravity of 1 m/s^2, whose friction is the
/// yield. Both ways alike; SlidingOptions::two_way says whether it slides upstream.
/// @param points  the first at path 0, paths ascending; two at one path: a jump
/// @throws InputError for no points, a first path other than 0, paths that fall, yields below 0 or not finite
SlipStages stages_of_yield(const std::vector<YieldPoint>& points);

// Ground accelerations at which the block starts to slide.
//
// Signs: x downstream, y up; a_h positive upstream (drives the block downstream), a_v positive up.

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
