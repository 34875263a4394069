// The rigid block above a lift joint against sums by hand.
#include "scene/read.hpp"
#include "sliding/block/rigid_block.hpp"
#include "sliding/equilibrium/base_state.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace damslip;
using namespace damslip::sliding;

Scene lift_block_scene(const std::string& more)
{
    return parse_scene("[section]\nheight_m = 62.5\nbase_m = 45\ncrest_m = 12\nneck_m = 11\n[dam]\ndensity_kg_m3 = "
                       "2500\n[uplift]\nmodel = \"none\"\n[reservoir]\n[added_mass]\nformula = "
                       "\"westergaard-simplified\"\n[contact]\nfriction = "
                       "0.77\n" +
                           more,
                       "dam.toml", FileCheck::skip);
}

// The neck, 12 x 11 m, full reservoir of 62.5 m: W = 2500 g 132, thrust 1/2 rho g 11^2, water in the joint 1/2 rho g 11
// x 12, added mass of its face with the depth of the whole reservoir, integral of 7/8 rho sqrt(62.5 z) over 0...11.
TEST(LiftBlock, IsTheRectangleAboveTheNeck)
{
    const Scene scene =
        lift_block_scene("[[lift_joint]]\nelevation_m = 51.5\nfriction = 0.8\ncohesion_kPa = 10\nwater = \"linear\"\n");
    const RigidBlock block = lift_block(scene, scene.lift_joints[0]);
    const double mass = 2500 * 132.0, thrust = 0.5 * 9810 * 121, uplift = 0.5 * 9810 * 11 * 12;
    const double water = 7.0 / 8 * 1000 * std::sqrt(62.5) * 2.0 / 3 * std::pow(11, 1.5);
    EXPECT_NEAR(block.mass, mass, 1e-9);
    EXPECT_NEAR(block.horizontal_force, thrust, 1e-12 * thrust);
    EXPECT_NEAR(block.uplift, uplift, 1e-12 * uplift);
    EXPECT_NEAR(block.vertical_force, 0.0, 1e-6);
    EXPECT_NEAR(block.added_mass.xx, water, 1e-12 * water);
    EXPECT_NEAR(block.cohesion_force, 10e3 * 12, 1e-9);
    EXPECT_EQ(block.friction, 0.8);
    const double a_y = (0.8 * (mass * 9.81 - uplift) + 120e3 - thrust) / (mass + water);
    EXPECT_NEAR(yield_downstream(block).law.constant, a_y, 1e-12 * a_y);
}

// Half way up the sloping face, with tailwater on it, dry joint: area and thrusts of the part above alone. The face has
// x = 45 - 33 y/51.5, at 30 m x = 25.776..., tailwater 34 m presses 4 m deep on it, and rests on its slope.
TEST(LiftBlock, TakesWaterAndForcesAboveTheJointOnly)
{
    const Scene scene = lift_block_scene(
        "[tailwater]\nlevel_m = 34\n[[force]]\ny_m = 60\nforce_x_kN_m = 50\n[[force]]\nx_m = 5\ny_m = 10\nforce_x_kN_m "
        "= 500\n[[lift_joint]]\nelevation_m = 30\nfriction = 1\n");
    const RigidBlock block = lift_block(scene, scene.lift_joints[0]);
    const double slope = 33 / 51.5, width = 45 - slope * 30;
    EXPECT_NEAR(block.mass, 2500 * (0.5 * (width + 12) * 21.5 + 132), 1e-6);
    EXPECT_NEAR(block.horizontal_force, 0.5 * 9810 * (32.5 * 32.5 - 16) + 50e3, 1e-6);
    EXPECT_NEAR(block.vertical_force, 0.5 * 9810 * 16 * slope, 1e-6);
    EXPECT_EQ(block.uplift, 0.0);
    EXPECT_LT(block.added_mass.xx, make_rigid_block(scene).added_mass.xx);
}

} // namespace
