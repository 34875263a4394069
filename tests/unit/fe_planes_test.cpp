// Runs with lift joints: further contact planes above the base.
#include "fe2d/run/contact_planes.hpp"
#include "scene/section.hpp"
#include "verification/cases/fe_run_scenes.hpp"
#include "verification/exact/two_blocks.hpp"

#include "sliding/block/slide.hpp"
#include "sliding/equilibrium/base_state.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {

using namespace damslip;
using namespace damslip::fe2d;
using Eigen::Index;
using Eigen::VectorXd;
using fe2d::test::options_of;
using fe2d::test::sines;
using fe2d::test::sliding_dam;

LiftJoint joint_at(double elevation, double friction)
{
    LiftJoint joint;
    joint.name = "neck";
    joint.elevation = elevation;
    joint.strength.friction = friction;
    return joint;
}

/// The dam dry on a rigid base, stiff as steel mountains, cut at the neck.
Scene stiff_blocks(double base_friction, double joint_friction)
{
    Scene scene = sliding_dam(base_friction, 1e4, 3.0);
    scene.foundation.reset();
    scene.curtain.reset();
    scene.reservoir.reset();
    scene.uplift.reset();
    scene.lift_joints.push_back(joint_at(51.5, joint_friction));
    scene.time.substeps = 3;
    return scene;
}

RunOptions stiff_options(const Scene& scene)
{
    RunOptions options = options_of(scene);
    options.damping = rayleigh_constants(0.05, 2.0 * std::numbers::pi * 360.0, 2.0 * std::numbers::pi * 1500.0);
    return options;
}

/// Strong shaking that leans downstream, so that slips add up.
GroundMotion leaning()
{
    GroundMotion motion = sines(5.0, 8.0);
    for (std::size_t i = 0; i < motion.accel_h.size(); ++i)
        motion.accel_h[i] += 1.5 * std::sin(std::numbers::pi * static_cast<double>(i) / 800.0);
    return motion;
}

TEST(FePlanes, GapsAreJumpsOverTheTies)
{
    Scene scene = sliding_dam(0.77, 1.0, 5.0);
    scene.lift_joints = {joint_at(20.0, 0.8), joint_at(51.5, 0.8)};
    const Model model = build_model(scene, {.base = Base::separate});
    const ContactPlanes planes(model.mesh);
    ASSERT_EQ(planes.count(), 3);
    const Index m = planes.pairs();
    EXPECT_NEAR(planes[1].length(), width_at_level(scene.section, 20.0), 1e-9);
    EXPECT_NEAR(planes[2].length(), 12.0, 1e-9);
    const Eigen::MatrixXd d = planes.gaps();
    EXPECT_LT((d * d.transpose() - Eigen::MatrixXd::Identity(2 * m, 2 * m)).cwiseAbs().maxCoeff(), 1e-15);
    ASSERT_EQ(static_cast<Index>(planes.ties().size()), planes[1].pairs() + planes[2].pairs());
    ASSERT_EQ(static_cast<Index>(planes.nodes().size()), m);

    // Upper blocks up by 3, the base as it is: gaps of that on the base, and none on the joint between two that move together.
    const ContactStructure structure(model);
    Eigen::VectorXd motion = Eigen::VectorXd::Zero(structure.dam_unknowns());
    for (Index node = 0; node < structure.order().nodes(); ++node)
        if (planes.above(1)[static_cast<std::size_t>(structure.order().old_node[static_cast<std::size_t>(node)])])
            motion[2 * node + 1] = 3.0;
    const Eigen::VectorXd gap = structure.gaps() * motion;
    EXPECT_LT(gap.segment(planes.first(0), planes[0].pairs()).cwiseAbs().maxCoeff(), 1e-15);
    EXPECT_LT((gap.segment(planes.first(1), planes[1].pairs()).array() - 3.0).abs().maxCoeff(), 1e-15);
    EXPECT_LT(gap.segment(planes.first(2), planes[2].pairs()).cwiseAbs().maxCoeff(), 1e-15);

    // The blocks' weights by what stands above each plane: densities times areas of the section.
    const auto above = [&](Index k) {
        double y = 1e9;
        for (std::size_t node = 0; node < planes.above(k).size(); ++node)
            if (planes.above(k)[node]) y = std::min(y, model.mesh.nodes[node].y);
        return y;
    };
    EXPECT_NEAR(above(1), 20.0, 1e-9);
    EXPECT_NEAR(above(2), 51.5, 1e-9);
}

// The base sticks, the upper block slides on its joint as a rigid block of its own on the ground: mu N alone.
TEST(FePlanes, StiffUpperBlockSlidesAsARigidBlock)
{
    const Scene scene = stiff_blocks(3.0, 0.3);
    Scene upper = scene;
    upper.section.polygon = {{0, 0}, {12, 0}, {12, 11}, {0, 11}};
    upper.lift_joints.clear();
    upper.contact.friction = 0.3;
    const GroundMotion motion = leaning();
    const double rigid = sliding::slide(motion, sliding::make_rigid_block(upper)).slip;
    ASSERT_GT(std::abs(rigid), 0.05);
    const RunResult result = EarthquakeRun(scene, stiff_options(scene)).run(motion);
    ASSERT_EQ(result.status, Status::at_rest) << text_of(result.notes);
    ASSERT_EQ(result.lifts.size(), 1u);
    EXPECT_NEAR(result.lifts[0].slip, rigid, 0.01 * std::abs(rigid)); // as the dam itself: first order in the step
    EXPECT_LT(std::abs(result.slip), 1e-6); // single pairs at heel and toe, where the traction is singular
    EXPECT_LT(result.energy_error, 1e-9);   // round-off of strains 1e4 times smaller than the concrete's
    EXPECT_EQ(result.counts.unresolved, 0);
}

// Both planes slide, at times together: the base under a strong shaking, the joint a little weaker still.
TEST(FePlanes, BothPlanesOfTwoStiffBlocksSlide)
{
    const Scene scene = stiff_blocks(0.35, 0.30);
    const GroundMotion motion = leaning();
    const double upper = 2500.0 * 12.0 * 11.0, lower = 2500.0 * area(scene.section) - upper;
    const exact::TwoSlips rigid = exact::two_blocks(motion, lower, upper, 0.35, 0.30);
    ASSERT_GT(std::abs(rigid.base), 0.02);
    ASSERT_GT(std::abs(rigid.joint), 0.02);
    const RunResult result = EarthquakeRun(scene, stiff_options(scene)).run(motion);
    ASSERT_EQ(result.status, Status::at_rest) << text_of(result.notes);
    EXPECT_NEAR(result.slip, rigid.base, 0.01 * std::abs(rigid.base));
    EXPECT_NEAR(result.lifts[0].slip, rigid.joint, 0.01 * std::abs(rigid.joint));
    EXPECT_LT(result.energy_error, 1e-9);
}

// On flexible rock with water: every force passes through both planes, the joint's balance is that of what is above it.
TEST(FePlanes, FlexibleDamWithTwoJointsIsInEquilibriumAndItsEnergyCloses)
{
    Scene scene = sliding_dam(0.77, 1.0, 5.0);
    scene.lift_joints = {joint_at(20.0, 0.75), joint_at(51.5, 0.5)};
    RunOptions options = options_of(scene);
    scene.time.substeps = 0;
    const EarthquakeRun run(scene, options);
    const RunResult result = run.run(sines(1.0, 8.0));
    ASSERT_EQ(result.stages.size(), 3u);
    for (const StageResult& stage : result.stages) EXPECT_EQ(stage.status, StageStatus::ok) << text_of(stage.notes());
    const PlaneBalance& top = result.stages.back().lifts[1];
    const double weight = 2500.0 * 9.81 * 12.0 * 11.0, water = 0.5 * 9810.0 * 11.0 * 11.0;
    EXPECT_NEAR(top.resultant.normal_force, weight, 1e-9 * weight);
    EXPECT_NEAR(top.resultant.shear_force, water, 1e-9 * water);
    EXPECT_NEAR(top.resultant.position, 6.0 + water * 11.0 / 3.0 / weight, 1e-9);
    EXPECT_NEAR(result.history.lifts[1].normal_force[0], weight, 1e-9 * weight);
    EXPECT_NEAR(result.history.normal_force[0], result.stages.back().resultant.normal_force, 1.0);
    ASSERT_EQ(result.status, Status::at_rest) << text_of(result.notes);
    EXPECT_GT(result.lifts[1].largest_slip, 1e-4);
    EXPECT_LT(result.energy_error, 1e-10);
    EXPECT_LT(result.counts.largest_residual, 1e-8);
    EXPECT_EQ(result.counts.unresolved, 0);
}

// A joint that nothing can move makes no difference: the tied faces carry what the concrete would.
TEST(FePlanes, JointThatHoldsChangesNothing)
{
    Scene whole = sliding_dam(0.66, 1.0, 5.0);
    whole.time.substeps = 0;
    Scene cut = whole;
    cut.lift_joints.push_back(joint_at(51.5, 0.8)); // a kink of the face: a row of nodes without it, too
    cut.lift_joints.front().strength.cohesion = 1e9;
    cut.lift_joints.front().strength.cohesion_lost_at_slip = false;
    const RunOptions options = options_of(whole);
    const GroundMotion motion = sines(0.15, 6.0); // the neck stays in compression
    const RunResult one = EarthquakeRun(whole, options).run(motion), two = EarthquakeRun(cut, options).run(motion);
    ASSERT_EQ(two.status, Status::at_rest);
    ASSERT_EQ(two.lifts[0].largest_opening, 0.0);
    EXPECT_EQ(two.lifts[0].largest_slip, 0.0);
    ASSERT_GT(one.slip, 1e-5);
    EXPECT_NEAR(two.slip, one.slip, 1e-9 * one.slip);
    for (std::size_t i = 0; i < one.history.time.size(); ++i)
        ASSERT_NEAR(two.history.crest_x[i], one.history.crest_x[i], 1e-12) << i;
}

TEST(FePlanes, WeakJointFailsBeforeTheEarthquake)
{
    Scene scene = sliding_dam(0.77, 1.0, 5.0);
    scene.lift_joints.push_back(joint_at(51.5, 0.1)); // needs water/weight = 0.183
    const RunResult result = EarthquakeRun(scene, options_of(scene)).run(sines(1.0, 1.0));
    EXPECT_EQ(result.status, Status::static_failure);
    EXPECT_NE(text_of(result.notes).find("above the lift joint at 51.5 m slides"), std::string::npos) << text_of(result.notes);
    EXPECT_NE(text_of(result.notes).find("mu >= 0.183"), std::string::npos) << text_of(result.notes);
}

} // namespace
