// Two steps of a lift: the bonded dam vibrates, then the part above a lift slides under the motion of the lift.
#include "analysis/prepare/lift_modes.hpp"
#include "analysis/prepare/plane_model.hpp"
#include "verification/exact/reference_scene.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace damslip {

namespace {

GroundMotion growing_chirp(double peak)
{
    GroundMotion motion;
    motion.name = "pulses";
    motion.dt = 0.01;
    for (int i = 0; i <= 600; ++i) {
        const double t = 0.01 * i, s = std::sin(std::numbers::pi * t / 6.0);
        motion.accel_h.push_back(peak * s * std::sin(2.0 * std::numbers::pi * (2.0 + 0.5 * t) * t));
    }
    return motion;
}

Scene dam_with_lifts()
{
    Scene scene = exact::elastic_reference_scene();
    Lifts& lifts = scene.lifts.emplace();
    lifts.elevations = {20.0, 30.0, 45.0};
    lifts.strength.friction = 0.75;
    lifts.uplift = LiftUplift::none;
    lifts.amplification = Amplification::modes;
    return scene;
}

TEST(LiftModes, AStiffDamMovesAsTheGround)
{
    Scene scene = dam_with_lifts();
    scene.foundation.reset();
    scene.curtain.reset();
    scene.reservoir.reset(); // acoustic water would swing by itself
    scene.dam.young_modulus = 25e9 * 400.0; // twenty times its frequencies
    const LiftModes modes = lift_modes(scene);
    ASSERT_EQ(modes.parts.size(), 3u);
    GroundMotion ground; // samples so close that the corners between them move no mode
    ground.dt = 0.001;
    for (int i = 0; i < 1000; ++i)
        ground.accel_h.push_back(3.0 * std::pow(std::sin(0.001 * std::numbers::pi * i), 2.0) *
                                 std::sin(0.008 * std::numbers::pi * i));
    constexpr std::size_t parts = 40; // of an interval: the highest mode has 2 kHz
    for (const sliding::TiedPart& part : modes.parts) {
        ASSERT_LT(part.modes.back().frequency, 5e3);
        const sliding::JointMotions moved = sliding::joint_motions(ground, part, int(parts), 0.0);
        for (std::size_t i = 0; i < ground.accel_h.size(); ++i) {
            EXPECT_NEAR(moved.joint.accel_h[i * parts], ground.accel_h[i], 0.1);
            EXPECT_NEAR(moved.mean.accel_h[i * parts], ground.accel_h[i], 0.1);
            EXPECT_NEAR(moved.joint.accel_v[i * parts], 0.0, 0.1);
        }
    }
}

TEST(LiftModes, SharesMakeTheRigidDam)
{
    const LiftModes modes = lift_modes(dam_with_lifts());
    const auto sum = [](const sliding::ModalShares& s) {
        double all = s.rest;
        for (const double w : s.of_mode) all += w;
        return all;
    };
    double below = 0.0;
    for (const sliding::TiedPart& part : modes.parts) {
        EXPECT_NEAR(sum(part.joint.h_of_h), 1.0, 1e-12);
        EXPECT_NEAR(sum(part.mean.h_of_h), 1.0, 1e-12);
        EXPECT_NEAR(sum(part.joint.v_of_h), 0.0, 1e-12);
        EXPECT_NEAR(sum(part.joint.v_of_v), 1.0, 1e-12);
        EXPECT_GT(part.joint.h_of_h.of_mode.front(), below); // the first mode grows upward
        EXPECT_GT(part.mean.h_of_h.of_mode.front(), part.joint.h_of_h.of_mode.front());
        below = part.joint.h_of_h.of_mode.front();
        EXPECT_LT(part.modes.front().ratio, 0.05); // Rayleigh's, less its part of the water, which is not damped
        EXPECT_GT(part.modes.front().ratio, 0.03);
    }
}

TEST(LiftModes, TheErrorOfTheStepHolds)
{
    const LiftModes modes = lift_modes(dam_with_lifts());
    sliding::RigidBlock block;
    block.mass = 1.0;
    block.friction = 0.3;
    const sliding::SlipStages stages{{0.0, block, 0.0}};
    const GroundMotion ground = growing_chirp(2.5);
    for (const sliding::TiedPart& part : modes.parts)
        for (const int polarity : {1, -1}) {
            sliding::SlideOptions options;
            options.polarity = polarity;
            const sliding::SlideResult found = sliding::slide_above(ground, part, stages, options);
            GroundMotion flipped = ground;
            for (double& a : flipped.accel_h) a *= polarity;
            const sliding::JointMotions fine = sliding::joint_motions(flipped, part, 64, 5.0);
            const double exact =
                std::max(sliding::slide(fine.joint, block).max_slip, sliding::slide(fine.mean, block).max_slip);
            EXPECT_GT(exact, 1e-4);
            EXPECT_GT(found.slip_error, 0.0);
            EXPECT_LE(std::abs(found.max_slip - exact), found.slip_error);
            EXPECT_LT(found.slip_error, 0.01 * exact);
        }
}

/// The amplification multiplies the motion under which a lift slides: that of the part above it.
TEST(LiftSlip, IsThatOfTheAmplifiedMotion)
{
    Scene scene = dam_with_lifts();
    scene.lifts->amplification = Amplification::points;
    scene.lifts->points = {{0.0, 2.0}, {70.0, 2.0}};
    const RigidModel twice = plane_model(scene, "lift at 30 m");
    EXPECT_NEAR(twice.amplification, 2.0, 1e-9);
    scene.lifts->points = {{0.0, 1.0}, {70.0, 1.0}};
    const RigidModel once = plane_model(scene, "lift at 30 m");
    const double slip = slide_model(scene, twice, growing_chirp(5.0), 1).max_slip;
    EXPECT_GT(slip, 1e-3);
    EXPECT_NEAR(slip, slide_model(scene, once, growing_chirp(10.0), 1).max_slip, 1e-9);
    EXPECT_GT(slip, 1.5 * slide_model(scene, once, growing_chirp(5.0), 1).max_slip);
}

} // namespace

} // namespace damslip
