// Lift joints in scenes: keys, order, round trip.
#include "scene/effect_plan.hpp"
#include "scene/read.hpp"
#include "scene/write.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace damslip;

const std::string lift_section = "[section]\nheight_m = 62.5\nbase_m = 45\ncrest_m = 12\nneck_m = 11\n"
                                 "[dam]\ndensity_kg_m3 = 2500\n[contact]\nfriction = 0.77\n";

Scene lift_scene(const std::string& joints)
{
    return parse_scene(lift_section + joints, "dam.toml", FileCheck::skip);
}

TEST(SceneLiftJoint, IsReadWithItsStrength)
{
    const Scene scene = lift_scene(
        "[[lift_joint]]\nname = \"neck\"\nelevation_m = 51.5\nfriction_deg = 40\ncohesion_kPa = 200\n"
        "cohesion_lost_at_slip = false\nresidual_friction = 0.6\nresidual_slip_mm = 5\nresidual_path = \"linear\"\n"
        "water = \"linear\"\n");
    ASSERT_EQ(scene.lift_joints.size(), 1u);
    const LiftJoint& joint = scene.lift_joints[0];
    EXPECT_EQ(joint.name, "neck");
    EXPECT_EQ(joint.elevation, 51.5);
    EXPECT_NEAR(joint.strength.friction, std::tan(40 * std::acos(-1.0) / 180), 1e-15);
    EXPECT_EQ(joint.strength.cohesion, 200e3);
    EXPECT_FALSE(joint.strength.cohesion_lost_at_slip);
    EXPECT_EQ(joint.strength.residual_friction, 0.6);
    EXPECT_EQ(joint.strength.residual_slip, 0.005);
    EXPECT_EQ(joint.strength.residual_path, Interpolation::linear);
    EXPECT_EQ(joint.water, JointWater::linear);
    EXPECT_EQ(scene.contact.cohesion, 0.0); // the base has its own
    const Scene table =
        lift_scene("[[lift_joint]]\nelevation_m = 30\nfriction = 1\nfriction_table_m = [[0, 1], [0.02, 0.7]]\n");
    EXPECT_EQ(table.lift_joints[0].strength.friction_table, (std::vector<Point>{{0, 1}, {0.02, 0.7}}));
    EXPECT_EQ(table.lift_joints[0].name, "lift joint 1");
    EXPECT_EQ(table.lift_joints[0].water, JointWater::none);
}

TEST(SceneLiftJoint, StandFromTheBottomUpAndResolvedScenesReadBack)
{
    const Scene first = lift_scene("[[lift_joint]]\nelevation_m = 51.5\nfriction = 0.8\nwater = \"linear\"\n"
                                   "[[lift_joint]]\nname = \"low\"\nelevation_m = 20\nfriction = 1.0\n"
                                   "residual_friction = 0.7\nresidual_slip_m = 0.01\n");
    ASSERT_EQ(first.lift_joints.size(), 2u);
    EXPECT_EQ(first.lift_joints[0].name, "low");
    EXPECT_EQ(first.lift_joints[1].name, "lift joint 1");
    const std::string resolved = resolved_toml(first);
    EXPECT_NE(resolved.find("[[lift_joint]]\nname = \"low\"\nelevation_m = 20.0\nfriction = 1.0\n"), std::string::npos)
        << resolved;
    const Scene second = parse_scene(resolved, "dam.toml", FileCheck::skip);
    EXPECT_EQ(resolved_toml(second), resolved);
    EXPECT_EQ(second.lift_joints[1].elevation, 51.5);
    EXPECT_EQ(second.lift_joints[1].water, JointWater::linear);
}

TEST(SceneLiftJoint, IsAnEffectOfFiniteElementsOnly)
{
    const Scene scene = lift_scene("[[lift_joint]]\nelevation_m = 51.5\nfriction = 0.8\n");
    const EffectPlan fe = make_effect_plan(scene, Method::finite_elements);
    EXPECT_TRUE(fe.on(Effect::lift_joints));
    EXPECT_EQ(called_for(fe, scene).lift_joints.size(), 1u);
    const EffectPlan rigid = make_effect_plan(scene, Method::rigid_block);
    EXPECT_FALSE(rigid.on(Effect::lift_joints));
    EXPECT_TRUE(called_for(rigid, scene).lift_joints.empty());
    EXPECT_FALSE(make_effect_plan(lift_scene(""), Method::finite_elements).on(Effect::lift_joints));
}

} // namespace
