#pragma once

#include "scene/scene.hpp"
#include "sliding/block/rigid_block.hpp"

#include <vector>

namespace damslip::sliding {

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

} // namespace damslip::sliding
