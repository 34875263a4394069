#include "sliding/block/yield.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace damslip::sliding {
namespace {

Yield yield(const RigidBlock& block, SlipDirection direction)
{
    const BaseEquations equations = base_equations(block);
    GroundLinear excess = excess_drive(equations, block, direction);
    if (block.opening) {
        excess.constant += block.friction * block.opening->at(direction, 0.0);
        excess.per_a_v += block.friction * block.opening->per_accel_v(direction);
    }
    const double per_driving_accel = sign(direction) * excess.per_a_h; // upstream sliding is driven by -a_h
    // q.A x below this is a cancellation of cos(theta) -+ mu sin(theta): the direction is taken as jammed.
    const double round_off =
        1e-15 * (std::abs(equations.drive.per_a_h) + block.friction * std::abs(equations.normal.per_a_h));
    if (per_driving_accel <= round_off) {
        const double infinity = std::numeric_limits<double>::infinity();
        return {{excess.constant > 0.0 ? -infinity : infinity, 0.0}, 0.0};
    }
    return {{-excess.constant / per_driving_accel, -excess.per_a_v / per_driving_accel},
            per_driving_accel / sliding_mass(equations, block.friction, direction)};
}

} // namespace

Yield yield_downstream(const RigidBlock& block)
{
    return yield(block, SlipDirection::downstream);
}

Yield yield_upstream(const RigidBlock& block)
{
    return yield(block, SlipDirection::upstream);
}

double yield_acceleration(const RigidBlock& block, double a_v)
{
    return yield_downstream(block).law.at(a_v);
}

double static_normal_force(const RigidBlock& block)
{
    return base_equations(block).normal.constant;
}

StaticState static_state(const RigidBlock& block)
{
    const BaseEquations equations = base_equations(block);
    if (equations.normal.constant <= 0.0) return StaticState::lifts_off;
    if (excess_drive(equations, block, SlipDirection::downstream).constant > 0.0) return StaticState::slides_downstream;
    if (excess_drive(equations, block, SlipDirection::upstream).constant > 0.0) return StaticState::slides_upstream;
    return StaticState::at_rest;
}

Status status_of(StaticState state)
{
    if (state == StaticState::at_rest) return Status::at_rest;
    return state == StaticState::lifts_off ? Status::floats : Status::static_failure;
}

double critical_friction(const RigidBlock& block)
{
    const BaseEquations equations = base_equations(block);
    if (equations.normal.constant <= 0.0) return std::numeric_limits<double>::infinity();
    return std::max(0.0, (std::abs(equations.drive.constant) - block.cohesion_force - block.dowel_force) /
                             equations.normal.constant);
}

} // namespace damslip::sliding
