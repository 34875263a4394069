#include "analysis/prepare/rigid_model.hpp"
#include "scene/section.hpp"
#include "sliding/block/rigid_block.hpp"
#include "sliding/equilibrium/base_state.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace damslip {
namespace {

/// A rectangle 12 m wide and 20 m high, water 15 m deep before it, linear uplift.
Scene wet_rectangle(OpeningWater opening, double friction)
{
    Scene scene;
    scene.section = {{{0, 0}, {12, 0}, {12, 20}, {0, 20}}};
    scene.dam.density = 2400.0;
    scene.contact.friction = friction;
    scene.reservoir.emplace();
    scene.reservoir->level = 15.0;
    scene.reservoir->model = ReservoirModel::hydrostatic;
    scene.uplift.emplace();
    scene.uplift->model = UpliftModel::linear;
    scene.uplift->water.opening = opening;
    if (opening == OpeningWater::mouth) scene.uplift->water.mouth_speed = 2.0;
    return scene;
}

GroundMotion sine(double peak, double seconds)
{
    GroundMotion motion;
    motion.name = "sine";
    motion.dt = 0.01;
    const int n = static_cast<int>(std::lround(seconds / motion.dt));
    for (int k = 0; k <= n; ++k) motion.accel_h.push_back(peak * std::sin(4.0 * 3.14159265358979 * k * motion.dt));
    return motion;
}

TEST(SlowWater, FollowsTheTipAndIsDrivenOut)
{
    const RigidModel model = make_rigid_model(wet_rectangle(OpeningWater::mouth, 0.6), {});
    ASSERT_TRUE(model.block.opening);
    const sliding::SlowWater* water = model.block.opening->slow.get();
    ASSERT_NE(water, nullptr);
    const auto down = sliding::SlipDirection::downstream;
    EXPECT_EQ(water->front(down, 0.0, 0.0, 1.0, 3.0), 0.0) << "the joint is shut: nothing stays in it";
    EXPECT_EQ(water->front(down, 1.5, 0.0, 0.2, 0.5), 0.5) << "it is open further than that";
    const double tip = water->front(down, 1.5, 0.0, 0.5, 12.0);
    EXPECT_GT(tip, 0.5);
    EXPECT_GT(water->front(down, 1.6, 0.0, 0.5, 12.0), tip) << "a higher acceleration opens the joint further";
    double before = water->sliding(down, 0.0, 0.0).change;
    for (const double wet : {0.2, 0.5, 1.0}) {
        const double change = water->sliding(down, 0.0, wet).change;
        EXPECT_GT(change, before) << wet;
        before = change;
    }
}

TEST(SlowWater, SlipLiesBetweenItsLimits)
{
    const GroundMotion motion = sine(4.0, 4.0);
    const auto slip = [&](OpeningWater rule, double speed) {
        Scene scene = wet_rectangle(rule, 0.6);
        if (rule == OpeningWater::mouth) scene.uplift->water.mouth_speed = speed;
        return slide_model(scene, make_rigid_model(scene, {}), motion, 1).max_slip;
    };
    const double zero = slip(OpeningWater::zero, 0), full = slip(OpeningWater::full, 0);
    const double slow = slip(OpeningWater::mouth, 0.5), fast = slip(OpeningWater::mouth, 10.0);
    EXPECT_LT(zero, slow);
    EXPECT_LT(slow, fast);
    EXPECT_LT(fast, full);
    EXPECT_NEAR(slip(OpeningWater::mouth, 1e-9), zero, 1e-8 * zero);
    EXPECT_NEAR(slip(OpeningWater::mouth, 1e5), full, 1e-5 * full);
}

TEST(SlowWater, HistoriesLeaveTheSlipAlone)
{
    const Scene scene = wet_rectangle(OpeningWater::mouth, 0.6);
    const RigidModel model = make_rigid_model(scene, {});
    const GroundMotion motion = sine(4.0, 4.0);
    const sliding::SkippingMotion skipping(motion);
    EXPECT_EQ(slide_model(scene, model, motion, 1).slip,
              slide_model(scene, model, motion, 1, sliding::HistoryOutput::samples).slip);
    EXPECT_EQ(slide_model(scene, model, motion, 1).slip, slide_model(scene, model, skipping, 1).slip);
}

/// The record twice as a sequence with a pause.
GroundMotion twice(const GroundMotion& once)
{
    GroundMotion both = once;
    both.accel_h.insert(both.accel_h.end(), once.accel_h.begin(), once.accel_h.end());
    both.events = {{"main", 0}, {"after", once.accel_h.size()}};
    both.pause = 0.5;
    return both;
}

TEST(WaterBetweenRecords, SecondRecordStandsOnFullHead)
{
    Scene scene = wet_rectangle(OpeningWater::zero, 0.6);
    scene.motion.sequence = {"main", "after"};
    const GroundMotion motion = twice(sine(4.2, 4.0));
    const RigidModel without = make_rigid_model(scene, {});
    EXPECT_EQ(without.rests, nullptr);
    const sliding::SlideResult dry = sliding::slide(motion, without.stages);
    scene.uplift->water.after = WaterAfter::full;
    const RigidModel with = make_rigid_model(scene, {});
    ASSERT_NE(with.rests, nullptr);
    const sliding::SlideResult wet = sliding::slide(motion, with.stages, {}, with.rests.get());
    ASSERT_EQ(wet.events.size(), 2u);
    EXPECT_EQ(wet.events[0].change, dry.events[0].change) << "the first record is the same";
    EXPECT_GT(wet.events[1].change, dry.events[1].change) << "more uplift in the second";

    // By hand: the second record alone on a block whose crack of the first one is full of water.
    double heel = 0.0;
    for (const double a : sine(4.2, 4.0).accel_h)
        heel = std::max(heel, with.rests->crack(sliding::SlipDirection::downstream, a, 0.0));
    ASSERT_GT(heel, 0.1);
    sliding::StaticCase afterwards = sliding::scene_static_case(scene);
    afterwards.opened = {sliding::Side::heel, heel};
    const sliding::BaseState state = sliding::base_state(scene, afterwards);
    sliding::RigidBlock block = sliding::make_rigid_block(scene, state, afterwards.loads.reservoir_level);
    block.opening = sliding::opening_uplift(scene, afterwards, state, block, false, {});
    const double alone = sliding::slide(sine(4.2, 4.0), block).slip;
    EXPECT_NEAR(wet.events[1].change, alone, 1e-9 * alone);
}

TEST(WaterBetweenRecords, ADamThatItTakesEndsTheSequence)
{
    Scene scene = wet_rectangle(OpeningWater::zero, 0.35);
    scene.reservoir->level = 18.0;
    scene.motion.sequence = {"main", "after"};
    scene.uplift->water.after = WaterAfter::full;
    const RigidModel model = make_rigid_model(scene, {});
    ASSERT_EQ(model.state, sliding::StaticState::at_rest);
    const sliding::SlideResult result = sliding::slide(twice(sine(3.0, 2.0)), model.stages, {}, model.rests.get());
    EXPECT_EQ(result.status, Status::static_failure);
    EXPECT_EQ(result.events.size(), 1u);
}

TEST(Tipping, TakesTheUpliftOfTheOpenJoint)
{
    const auto tips = [](OpeningWater rule) { return sliding::base_limits(wet_rectangle(rule, 0.6)).tips; };
    const double unchanged = tips(OpeningWater::unchanged), zero = tips(OpeningWater::zero),
                 full = tips(OpeningWater::full);
    // About the toe: W b/2 - thrust h/3 - U arm = m a H/2; U changes by these moments.
    const double p = 9.81 * 1000.0 * 15.0, b = 12.0, per_a = 2400.0 * b * 20.0 * 10.0;
    const double linear = 0.5 * p * b * (2.0 / 3.0) * b, head = p * b * 0.5 * b;
    EXPECT_NEAR(zero - unchanged, linear / per_a, 1e-3 * linear / per_a);
    EXPECT_NEAR(unchanged - full, (head - linear) / per_a, 1e-3 * linear / per_a);
    EXPECT_EQ(tips(OpeningWater::full), make_rigid_model(wet_rectangle(OpeningWater::full, 0.6), {}).tips);
}

} // namespace
} // namespace damslip
