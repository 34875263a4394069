#pragma once

#include "sliding/block/rigid_block.hpp"

namespace damslip::sliding {

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

} // namespace damslip::sliding
