// The rigid block of a scene and the load combinations.
#include "sliding/equilibrium/base_state.hpp"

#include "exact/reference_scene.hpp"

#include <gtest/gtest.h>

namespace damslip::sliding {
namespace {

using exact::ReferenceUplift;

double static_critical_friction(const RigidBlock& block) // horizontal base, no cohesion
{
    return block.horizontal_force / (block.mass * block.gravity + block.vertical_force - block.uplift);
}

// By hand: G = 39233868.75, W_s = 19160156.25 N/m, U = p0 (7 (1 + 2/3)/2 + 38/3) = 18.5 p0 and 22.5 p0, p0 = 613125 Pa.
TEST(Equilibrium, RigidBlockOfTheReferenceScene)
{
    const RigidBlock block = make_rigid_block(exact::reference_scene(ReferenceUplift::printed_curtain, 0.77));
    EXPECT_DOUBLE_EQ(block.mass, 3999375.0);
    EXPECT_DOUBLE_EQ(block.horizontal_force, 19160156.25);
    EXPECT_EQ(block.vertical_force, 0.0);
    EXPECT_NEAR(block.uplift, 18.5 * 613125.0, 1e-8);
    EXPECT_NEAR(block.added_mass.xx, 7.0 / 12.0 * 1000.0 * 62.5 * 62.5, 1e-6);
    EXPECT_NEAR(static_critical_friction(block), 19160156.25 / (39233868.75 - 11342812.5), 1e-15);
    EXPECT_NEAR(static_critical_friction(block), 0.687, 5e-5);
    const RigidBlock linear = make_rigid_block(exact::reference_scene(ReferenceUplift::linear, 0.77));
    EXPECT_NEAR(static_critical_friction(linear), 0.753, 5e-4);
}

TEST(Equilibrium, OverridesReachTheBlock)
{
    Scene scene = exact::reference_scene(ReferenceUplift::linear, 0.77);
    scene.contact.cohesion = 1e5;
    BlockOptions options;
    EXPECT_DOUBLE_EQ(make_rigid_block(scene, options).cohesion_force, 45e5);
    options.friction = 0.9;
    options.cohesion = 2e5;
    EXPECT_DOUBLE_EQ(make_rigid_block(scene, options).friction, 0.9);
    EXPECT_DOUBLE_EQ(make_rigid_block(scene, options).cohesion_force, 90e5);
    scene.reservoir->model = ReservoirModel::hydrostatic;
    EXPECT_EQ(make_rigid_block(scene).added_mass.xx, 0.0);
}

} // namespace
} // namespace damslip::sliding
