#pragma once

#include "scene/scene.hpp"
#include "sliding/block/rigid_block.hpp"

namespace damslip::sliding {

/// The dam above a lift joint as a scene of its own, in whose axes the joint is the base: section, water, silt, ice and
/// forces above the joint, the joint's strength and its anchors; no rock, curtain or drains. Uplift is the water in the joint, linear
/// between the two faces where LiftJoint::water says so. The added mass of such a scene is not that of the dam (it
/// depends on the depth of the whole reservoir): see lift_block.
Scene scene_above(const Scene& scene, const LiftJoint& joint);

/// The block above a lift joint on it: the rigid block of scene_above with the added mass of the whole reservoir on the
/// face above the joint. The dam below is taken as rigid: that it amplifies the ground motion is left out, so the
/// block's yield acceleration is one of the joint, not of the ground.
RigidBlock lift_block(const Scene& scene, const LiftJoint& joint);

} // namespace damslip::sliding
