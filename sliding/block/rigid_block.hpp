#pragma once

#include "sliding/block/opening_uplift.hpp"

/// The rigid block on its base plane, and the ground accelerations at which it starts to slide.
namespace damslip::sliding {

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

} // namespace damslip::sliding
