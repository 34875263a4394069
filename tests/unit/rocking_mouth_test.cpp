#include "analysis/prepare/rigid_model.hpp"
#include "scene/read.hpp"
#include "sliding/rocking/rocking.hpp"
#include "sliding/rocking/rocking_motion.hpp"
#include "verification/cases/flat_water.hpp"
#include "verification/exact/sampled_ground.hpp"

#include <gtest/gtest.h>

#include <cmath>

/// The block that rocks on a joint which water enters at a finite speed (uplift.opening = "mouth").
namespace damslip::sliding::filling {
namespace {

using exact::ground_of;
using exact::stillness;

constexpr double g = 9.81, width = 4.0, height = 10.0, density = 2500.0;
constexpr double head =
    0.2 * density * height * g; ///< pressure at both ends: a full joint carries a fifth of the weight
constexpr double weight = density * width * height * g;

RockingBlock tower(double friction = 50.0)
{
    RockingBlock block = rectangular_block(width, height, density, g, friction);
    block.uplift_on_toe = block.uplift_on_heel = UpliftResultant{0.0, 0.0};
    return block;
}

RockingBlock wet_tower(double speed, bool open_flat, double friction = 50.0)
{
    RockingBlock block = tower(friction);
    const MouthEnd end{.empty = {}, .first = 0.0, .pressure = head, .gradient = 0.0};
    block.mouth = RockingMouth{std::make_shared<verification::FlatWater>(speed, width, open_flat), end, end};
    return block;
}

/// The joint is full as soon as it opens.
RockingBlock full_tower(double friction = 50.0)
{
    RockingBlock block = tower(friction);
    block.uplift_on_toe = block.uplift_on_heel = UpliftResultant{head * width, 0.5 * head * width * width};
    return block;
}

SlideOptions no_run_out()
{
    SlideOptions options;
    options.sliding.run_out_max = 0.0;
    return options;
}

/// Free rocking of the tower, by itself: J th'' = -(weight terms) + cos th p (x L - x²/2), x = min(v t, L) since the last landing,
/// in its own turn on either corner. Classical Runge-Kutta, landings by Newton's rule on the last step.
struct FreeTower {
    double speed;
    double theta, rate = 0.0, since = 0.0; ///< theta > 0 on the corner of the turn

    double accel(double t, double th) const
    {
        const double R = 0.5 * std::hypot(width, height), mass = density * width * height;
        const double alpha = std::atan2(width, height), x = std::min(speed * t, width);
        const double water = std::cos(th) * head * (x * width - 0.5 * x * x);
        return (-mass * g * R * std::sin(alpha - th) + water) / (4.0 / 3.0 * mass * R * R);
    }
    /// One step that does not cross the time when the joint is full.
    void step(double h)
    {
        const double a1 = accel(since, theta), v2 = rate + 0.5 * h * a1;
        const double a2 = accel(since + 0.5 * h, theta + 0.5 * h * rate), v3 = rate + 0.5 * h * a2;
        const double a3 = accel(since + 0.5 * h, theta + 0.5 * h * v2), v4 = rate + h * a3;
        const double a4 = accel(since + h, theta + h * v3);
        theta += h / 6.0 * (rate + 2.0 * v2 + 2.0 * v3 + v4);
        rate += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
        since += h;
    }
    /// Time to the landing; then the state of the next turn.
    double land()
    {
        const double h = 1e-4, full = width / speed;
        while (theta > 0.0 || since == 0.0) {
            const bool fills = since < full * (1.0 - 1e-12) && since + h > full;
            step(fills ? full - since : h);
        }
        for (int k = 0; k < 4; ++k) step(-theta / rate);
        const double time = since, sine = std::sin(std::atan2(width, height));
        rate *= -(1.0 - 1.5 * sine * sine); // the other corner turns the other way
        theta = since = 0.0;
        return time;
    }
};

// The front comes through after 0.8 s, after 0.2 s, and never; each turn begins with a dry joint, for landings drive the water out.
TEST(RockingMouth, RocksOnTheWaterThatHasComeIn)
{
    for (const double speed : {5.0, 20.0, 0.5}) {
        const double released = 0.5 * std::atan2(width, height);
        FreeTower by_hand{speed, released};
        const double first = by_hand.land(), second = by_hand.land(), third = first + second + by_hand.land();
        const GroundMotion still = stillness(third - 1e-6, 400), longer = stillness(third + 1e-6, 400);
        const RockingBlock block = wet_tower(speed, false);
        const RockingResult r = rock_and_slide(still, block, no_run_out(), {released, 0.0});
        EXPECT_NEAR(r.first_landing_time, first, 1e-9) << speed;
        EXPECT_EQ(r.landings, 2) << speed;
        EXPECT_EQ(rock_and_slide(longer, block, no_run_out(), {released, 0.0}).landings, 3) << speed;
        EXPECT_NEAR(r.slide.wet_length, std::min(width, speed * std::max(first, second)), 1e-9) << speed;
        EXPECT_LT(std::abs(r.energy.imbalance), 1e-9) << speed;
    }
}

// 5 m a = 2 m g - p (x L - x²/2) about the toe, with a = slope t and x = v t: a quadratic in t. The same about the heel.
TEST(RockingMouth, TipsByTheWaterThatHasComeIn)
{
    for (const double speed : {0.3, 1.2})
        for (const double slope : {1.5, -1.5}) {
            const double mass = weight / g, s = std::abs(slope), duration = width / speed;
            const double a = -0.5 * head * speed * speed, b = 5.0 * mass * s + head * speed * width, c = -2.0 * weight;
            const double tips = (-b + std::sqrt(b * b - 4.0 * a * c)) / (2.0 * a);
            ASSERT_LT(tips, duration);
            const GroundMotion ramp = ground_of([=](double t) { return slope * t; }, 5.0, 97);
            const RockingResult r = rock_and_slide(ramp, wet_tower(speed, true), no_run_out());
            EXPECT_NEAR(r.first_rock_time, tips, 1e-9) << speed << " " << slope;
        }
}

GroundMotion shaking(double peak)
{
    return ground_of(
        [=](double t) {
            return peak * (0.5 * std::sin(6.0 * t) + 0.3 * std::sin(11.3 * t + 1.0) + 0.2 * std::sin(25.7 * t));
        },
        12.0, 1200);
}

// Water that never comes is none; once it is released, water that is there at once is a full joint.
TEST(RockingMouth, LiesBetweenADryAndAFullJoint)
{
    for (const double friction : {50.0, 0.45}) {
        const RockingResult dry = rock_and_slide(shaking(9.0), tower(friction), {}),
                            slow = rock_and_slide(shaking(9.0), wet_tower(1e-12, true, friction), {});
        ASSERT_GT(dry.rocks, 2);
        EXPECT_EQ(slow.rocks, dry.rocks) << friction;
        EXPECT_NEAR(slow.slide.slip, dry.slide.slip, 1e-9) << friction;
        EXPECT_NEAR(slow.max_toe_rotation, dry.max_toe_rotation, 1e-9) << friction;
        EXPECT_NEAR(slow.max_heel_rotation, dry.max_heel_rotation, 1e-9) << friction;
    }
    const double released = 0.5 * std::atan2(width, height);
    const auto lands = [&](const RockingBlock& block) {
        return rock_and_slide(stillness(5.0, 400), block, no_run_out(), {released, 0.0}).first_landing_time;
    };
    EXPECT_NEAR(lands(wet_tower(1e9, false)), lands(full_tower()), 1e-7);
    EXPECT_LT(lands(tower()), lands(wet_tower(5.0, false)));
    EXPECT_LT(lands(wet_tower(5.0, false)), lands(full_tower()));
}

// Water that has all come before the block begins to rock on either corner tips it as a full joint does.
TEST(RockingMouth, TipsAsAFullJointOnceItIsFull)
{
    const GroundMotion later = ground_of([](double t) { return std::max(0.0, 1.5 * (t - 1.0)); }, 5.0, 500);
    EXPECT_NEAR(rock_and_slide(later, wet_tower(20.0, true), no_run_out()).first_rock_time,
                rock_and_slide(later, full_tower(), no_run_out()).first_rock_time, 1e-9);
}

// Rocking and sliding at once, shaken hard: the energy closes and the landings end.
TEST(RockingMouth, ComesToRestWithItsEnergyClosed)
{
    for (const double speed : {0.1, 2.0, 50.0, 1e6})
        for (const double friction : {0.38, 0.45, 1.0}) {
            RockingBlock block = wet_tower(speed, true, friction);
            block.force_t = 0.05 * weight;
            block.moment += 3.0 * block.force_t;
            const RockingResult r = rock_and_slide(shaking(9.0), block, {});
            EXPECT_EQ(r.slide.status, Status::at_rest) << speed << " " << friction;
            EXPECT_GT(r.rocks, 0) << speed << " " << friction;
            EXPECT_LT(std::abs(r.energy.imbalance), 1e-9) << speed << " " << friction;
            EXPECT_LE(r.slide.wet_length, width) << speed << " " << friction;
        }
}

const std::string dam = "[section]\nheight_m = 62.5\nbase_m = 45\ncrest_m = 12\nneck_m = 11\n[dam]\n"
                        "density_kg_m3 = 2500\n[contact]\nfriction = 1.2\n[reservoir]\nlevel_m = 60\n"
                        "model = \"added-mass\"\n[tailwater]\nlevel_m = 8\n[uplift]\nmodel = \"linear\"\n";

RigidModel model_of(const std::string& rule)
{
    return make_rigid_model(parse_scene(dam + rule, "dam.toml", FileCheck::skip), {}, std::nullopt);
}

// The joint of a dam: what the mouth's profile holds from end to end is the full joint's, on the toe as on the heel only with
// the head of that end; nothing of it is the dry joint's; and the forces between are the integrals of the profile.
TEST(RockingMouth, TheJointOfADamIsThatOfItsProfile)
{
    const RockingBlock slow = *model_of("opening = \"mouth\"\nmouth_speed_m_s = 5\n").rocking,
                       full = *model_of("opening = \"full\"\n").rocking,
                       dry = *model_of("opening = \"zero\"\n").rocking;
    ASSERT_TRUE(slow.mouth);
    EXPECT_FALSE(full.mouth);
    const double length = slow.length, p = 60.0 * 1000.0 * g, tail = 8.0 * 1000.0 * g;
    const auto close = [](const UpliftResultant& a, const UpliftResultant& b) {
        EXPECT_NEAR(a.force, b.force, 1e-9 * (1.0 + std::abs(b.force)));
        EXPECT_NEAR(a.moment_about_heel, b.moment_about_heel, 1e-9 * (1.0 + std::abs(b.moment_about_heel)));
    };
    close(mouth_uplift(slow, Stance::toe, slow.mouth->at_heel.first), *dry.uplift_on_toe);
    close(mouth_uplift(slow, Stance::heel, slow.mouth->at_toe.first), *dry.uplift_on_heel);
    close(mouth_uplift(slow, Stance::toe, length), *full.uplift_on_toe);
    const double x = 0.3 * length, first = slow.mouth->at_heel.first;
    ASSERT_LT(first, x);
    close(mouth_uplift(slow, Stance::toe, x),
          {dry.uplift_on_toe->force + p * (x - first),
           dry.uplift_on_toe->moment_about_heel + p * 0.5 * (x * x - first * first)});
    const UpliftResultant toe = mouth_uplift(slow, Stance::heel, x);
    EXPECT_NEAR(toe.force - dry.uplift_on_heel->force, tail * x, 1e-9 * toe.force);
    EXPECT_NEAR(toe.moment_about_heel - dry.uplift_on_heel->moment_about_heel, tail * x * (length - 0.5 * x),
                1e-9 * toe.moment_about_heel);
}

// Of a dam: between `zero` and `full`. Sliding and rocking trade places, so the slip tells which joint it was.
TEST(RockingMouth, OfADamLiesBetweenTheGuidelines)
{
    const auto slip = [](const std::string& rule) {
        const RockingResult r = rock_and_slide(shaking(9.0), *model_of(rule).rocking, SlideOptions{});
        EXPECT_EQ(r.slide.status, Status::at_rest) << rule;
        EXPECT_LT(std::abs(r.energy.imbalance), 1e-9) << rule;
        return r.slide.slip;
    };
    const auto mouth = [](const std::string& speed) {
        return "opening = \"mouth\"\nmouth_speed_m_s = " + speed + "\n";
    };
    const double zero = slip("opening = \"zero\"\n"), full = slip("opening = \"full\"\n");
    EXPECT_NEAR(slip(mouth("1e-9")), zero, 1e-9);
    EXPECT_NEAR(slip(mouth("5")), zero, 0.01 * zero); // hardly a metre comes in before the joint shuts
    for (const char* speed : {"1000", "1e6"}) {
        EXPECT_GT(slip(mouth(speed)), 1.02 * zero) << speed;
        EXPECT_LT(slip(mouth(speed)), 0.98 * full) << speed;
    }
}

} // namespace
} // namespace damslip::sliding::filling
