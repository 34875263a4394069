#include "analysis/accuracy/hierarchy.hpp"
#include "analysis/sweep/sweep_axes.hpp"
#include "core/input_error.hpp"
#include "program_answer.hpp"
#include "scene/read.hpp"
#include "sliding/block/rigid_block.hpp"
#include "sliding/equilibrium/base_state.hpp"
#include "sliding/rocking/rocking.hpp"
#include "sliding/rocking/rocking_motion.hpp"
#include "verification/exact/rocking_block.hpp"
#include "verification/exact/sampled_ground.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <unistd.h>

/// The block that rocks and slides: what the closed solutions of `verify` (sliding.rocking) do not hold it against.
namespace damslip::sliding {
namespace {

using exact::ground_of;
using exact::stillness;

constexpr double g = 9.81;

GroundMotion shaking(double peak)
{
    return ground_of(
        [=](double t) {
            return peak * (0.5 * std::sin(6.0 * t) + 0.3 * std::sin(11.3 * t + 1.0) + 0.2 * std::sin(25.7 * t));
        },
        12.0, 1200);
}

RockingBlock tower(double friction)
{
    return rectangular_block(4.0, 10.0, 2500.0, g, friction);
}

// The textbook's equations (X, Y of the centroid from the toe, Shenton 1996), written for a toe that slides downstream all
// the way and integrated by themselves: I th'' = -N (X - mu Y), N = m (g + X th'' - Y th'^2), m x_G'' = -mu N, x_G = s - X.
struct Falling {
    double mu;
    std::array<double, 4> rates(const std::array<double, 4>& y) const // theta, theta', s, s'
    {
        const double X = 2.0 * std::cos(y[0]) - 5.0 * std::sin(y[0]), Y = 2.0 * std::sin(y[0]) + 5.0 * std::cos(y[0]);
        const double inertia = (16.0 + 100.0) / 12.0, arm = X - mu * Y; // of unit mass
        const double accel = -(g - Y * y[1] * y[1]) * arm / (inertia + X * arm);
        const double normal = g + X * accel - Y * y[1] * y[1];
        return {y[1], accel, y[3], -mu * normal - Y * accel - X * y[1] * y[1]};
    }
    std::array<double, 4> after(std::array<double, 4> y, double duration, int steps) const // classical Runge-Kutta
    {
        const double h = duration / steps;
        const auto moved = [](std::array<double, 4> a, double f, const std::array<double, 4>& b) {
            for (std::size_t i = 0; i < 4; ++i) a[i] += f * b[i];
            return a;
        };
        for (int k = 0; k < steps; ++k) {
            const auto a = rates(y), b = rates(moved(y, h / 2, a)), c = rates(moved(y, h / 2, b)),
                       d = rates(moved(y, h, c));
            for (std::size_t i = 0; i < 4; ++i) y[i] += h / 6 * (a[i] + 2 * b[i] + 2 * c[i] + d[i]);
        }
        return y;
    }
};

// 2e4 steps of order 4 leave 1e-14 of this quarter period of some 1.5 s.
TEST(Rocking, SlidesWhileItFallsBackAsTheTextbookHasIt)
{
    for (const double mu : {0.0, 0.05, 0.1}) {
        SCOPED_TRACE(mu);
        const auto expected = Falling{mu}.after({0.2, 0.0, 0.0, 0.0}, 0.6, 20000);
        ASSERT_GT(expected[0], 0.0); // has not landed
        ASSERT_GT(expected[3], 0.0); // slides downstream
        SlideOptions options;
        options.history = HistoryOutput::samples;
        options.sliding.run_out_max = 0.0;
        const RockingResult r = rock_and_slide(stillness(0.6, 60), tower(mu), options, {0.2, 0.0});
        EXPECT_NEAR(r.rotation.back(), expected[0], 1e-11);
        EXPECT_NEAR(r.slide.slip, expected[2], 1e-11);
        EXPECT_NEAR(r.slide.history.slip_rate.back(), expected[3], 1e-11);
        EXPECT_EQ(r.landings, 0);
    }
}

TEST(Rocking, TheOtherPolarityIsTheMirroredMotion)
{
    SlideOptions other;
    other.polarity = -1;
    const RockingResult a = rock_and_slide(shaking(9.0), tower(0.42)),
                        b = rock_and_slide(shaking(9.0), tower(0.42), other);
    ASSERT_GT(a.landings, 3);
    ASSERT_NE(a.slide.slip, 0.0);
    EXPECT_NEAR(a.slide.slip, -b.slide.slip, 1e-9);
    EXPECT_NEAR(a.max_toe_rotation, b.max_heel_rotation, 1e-9);
    EXPECT_NEAR(a.max_heel_rotation, b.max_toe_rotation, 1e-9);
}

// The record is linear between samples: samples put between them change nothing but the steps.
TEST(Rocking, DoesNotDependOnTheSampling)
{
    const GroundMotion coarse = shaking(9.0);
    GroundMotion fine;
    fine.dt = coarse.dt / 3;
    for (std::size_t k = 0; k + 1 < coarse.accel_h.size(); ++k)
        for (int part = 0; part < 3; ++part)
            fine.accel_h.push_back(coarse.accel_h[k] + (coarse.accel_h[k + 1] - coarse.accel_h[k]) * part / 3.0);
    fine.accel_h.push_back(coarse.accel_h.back());
    const RockingResult a = rock_and_slide(coarse, tower(0.42)), b = rock_and_slide(fine, tower(0.42));
    ASSERT_GT(a.landings, 3);
    EXPECT_NEAR(a.slide.slip, b.slide.slip, 1e-8);
    EXPECT_NEAR(a.max_toe_rotation, b.max_toe_rotation, 1e-8);
}

TEST(Rocking, EndsAtRestOverturnedOrStillMoving)
{
    EXPECT_EQ(rock_and_slide(shaking(3.0), tower(5.0)).slide.status, Status::at_rest); // 3.92 m/s2 starts it
    const RockingResult fallen = rock_and_slide(ground_of([](double) { return 6.0; }, 10.0, 500), tower(5.0));
    EXPECT_EQ(fallen.slide.status, Status::overturned);
    EXPECT_NEAR(fallen.max_toe_rotation, std::acos(0.0), 1e-9);
    EXPECT_FALSE(reported(fallen.slide.status, fallen.slide.slip));
    EXPECT_EQ(judge(fallen.slide.status, fallen.slide.max_slip, 0.0, 1.0), damslip::Verdict::fail);
    SlideOptions brief;
    brief.sliding.run_out_max = 0.1;
    const RockingResult moving = rock_and_slide(stillness(0.1, 10), tower(5.0), brief, {0.3, 0.0});
    EXPECT_EQ(moving.slide.status, Status::sliding_at_end);
    EXPECT_NEAR(moving.slide.end_time, 0.2, 1e-12);
}

TEST(Rocking, OneWayNeverSlidesUpstream)
{
    SlideOptions one_way;
    one_way.sliding.two_way = false;
    const RockingResult r = rock_and_slide(shaking(6.0), tower(0.35), one_way);
    EXPECT_EQ(r.slide.upstream_slip, 0.0);
    EXPECT_GT(r.slide.downstream_slip, 0.0);
    EXPECT_GT(rock_and_slide(shaking(6.0), tower(0.35)).slide.upstream_slip, 0.0);
}

// Energy may not be gained: restitution 1 of a rectangle keeps all of it, of a block whose heel is further from its centroid
// than its toe less than 1 has to do.
TEST(Rocking, RestitutionGainsNoEnergy)
{
    SlideOptions bounces;
    bounces.sliding.restitution = 1.0;
    bounces.sliding.run_out_max = 0.0;
    const RockingResult r = rock_and_slide(stillness(10.0, 1000), tower(50.0), bounces, {0.2, 0.0});
    EXPECT_GT(r.landings, 3);
    EXPECT_NEAR(r.energy.landings, 0.0, 1e-9 * r.energy.kinetic);
    RockingBlock leaning = tower(50.0);
    leaning.centroid.x = 3.0; // nearer to the toe
    leaning.moment = leaning.mass * g * leaning.centroid.x;
    const RockingResult lean = rock_and_slide(stillness(10.0, 1000), leaning, bounces, {0.1, 0.0});
    EXPECT_GT(lean.landings, 2);
    EXPECT_GE(lean.energy.landings, 0.0);
    EXPECT_NEAR(lean.energy.imbalance, 0.0, 1e-9);
}

// Dry, bonded: at a the resultant lies b/2 - a h/(2 g) from the toe, three times that (b at most) is closed, and it slides at
// m a = c b' + mu m g: (1.5 c b + mu m g)/(m + 1.5 c h/g). The same as base_limits().yield_with_crack.
TEST(Rocking, TheBondHoldsWhereTheJointIsClosed)
{
    const Scene scene = parse_scene("[section]\npolygon_m = [[0, 0], [6, 0], [6, 10], [0, 10]]\n[dam]\n"
                                    "density_kg_m3 = 2500\n[contact]\nfriction = 0.3\ncohesion_kPa = 50\n",
                                    "dam.toml", FileCheck::skip);
    const double mass = 2500.0 * 60.0, c = 50e3;
    const double by_hand = (1.5 * c * 6.0 + 0.3 * mass * g) / (mass + 1.5 * c * 10.0 / g);
    const StaticCase static_case = scene_static_case(scene);
    const BaseState state = base_state(scene, static_case);
    const RockingBlock block = make_rocking_block(
        scene, state, {}, strength_stages(make_rigid_block(scene, state, std::nullopt), scene.contact));
    const RockingResult r = rock_and_slide(ground_of([](double t) { return t; }, 6.0, 123), block);
    EXPECT_NEAR(r.bond_lost_time, by_hand, 1e-10);
    EXPECT_NEAR(r.slide.first_slip_time, by_hand, 1e-10);
    EXPECT_NEAR(base_limits(scene).yield_with_crack, by_hand, 1e-10);
}

// One corner's equations are the other's seen from there: the kinetic energy of one motion of the body is the same.
TEST(Rocking, BothCornersSeeOneBody)
{
    RockingBlock block = tower(0.5);
    block.water = {3e4, -2e3, 1e3, 1.2e5, -8e3, 9e5};
    const Corner toe = corner(block, block.stages.front(), Stance::toe),
                 heel = corner(block, block.stages.front(), Stance::heel);
    const double rate = 0.7, v = 0.3; // about the toe; its heel sinks by -L rate
    const Momentum seen_from_heel = momentum(heel, v, rate * 4.0, rate), seen_from_toe = momentum(toe, v, 0.0, rate);
    EXPECT_NEAR(seen_from_heel.t, seen_from_toe.t, 1e-12 * std::abs(seen_from_toe.t));
    EXPECT_NEAR(seen_from_heel.n, seen_from_toe.n, 1e-12 * std::abs(seen_from_toe.n));
    const double energy = 0.5 * (seen_from_heel.t * v + seen_from_heel.n * rate * 4.0 + seen_from_heel.r * rate);
    EXPECT_NEAR(energy, kinetic_energy(toe, 0.0, v, rate), 1e-12 * energy);
}

/// A tower on water whose uplift is a tenth of the weight in the middle of the base; while it rocks, `open`.
RockingBlock wet_tower(std::optional<UpliftResultant> open, double friction = 50.0)
{
    RockingBlock block = tower(friction);
    block.stages.front().slip.block.uplift = 0.1 * block.mass * g;
    block.stages.front().uplift_distance = 2.0;
    block.uplift_on_toe = block.uplift_on_heel = open;
    return block;
}

double lifts_at(const RockingBlock& block, double slope)
{
    SlideOptions brief;
    brief.sliding.run_out_max = 0.0;
    const GroundMotion ramp = ground_of([=](double t) { return slope * t; }, 5.0, 97);
    return std::abs(slope) * rock_and_slide(ramp, block, brief).first_rock_time;
}

// Moments about the toe: m a 5 = (m g - U) 2, with the uplift of the open joint, and all the same about the heel.
TEST(Rocking, StartsWithTheUpliftOfTheJointThatIsOpenToTheCorner)
{
    const double weight = tower(1.0).mass * g, by_hand = g * 2.0 / 5.0;
    for (const double slope : {1.0, -1.0}) {
        EXPECT_NEAR(lifts_at(wet_tower({}), slope), 0.9 * by_hand, 1e-9);
        EXPECT_NEAR(lifts_at(wet_tower(UpliftResultant{0.0, 0.0}), slope), by_hand, 1e-9);
        EXPECT_NEAR(lifts_at(wet_tower(UpliftResultant{0.3 * weight, 0.6 * weight}), slope), 0.7 * by_hand, 1e-9);
    }
}

// Released, a block above a dry joint falls back as one without water does; above a full one as one that is lighter, about
// its toe, by the moment of the water.
TEST(Rocking, FallsBackOnTheUpliftOfTheOpenJoint)
{
    SlideOptions brief;
    brief.sliding.run_out_max = 0.0;
    const exact::Rocker dry{4.0, 10.0, g};
    const double released = 0.5 * dry.slenderness();
    const auto lands = [&](const RockingBlock& block) {
        return rock_and_slide(stillness(5.0, 400), block, brief, {released, 0.0}).first_landing_time;
    };
    EXPECT_NEAR(lands(wet_tower(UpliftResultant{0.0, 0.0})), dry.quarter_period(0.5), 1e-9);
    EXPECT_GT(lands(wet_tower({})), 1.02 * dry.quarter_period(0.5));
    const double weight = tower(1.0).mass * g;
    const RockingResult full = rock_and_slide(
        stillness(5.0, 400), wet_tower(UpliftResultant{0.3 * weight, 0.6 * weight}), brief, {released, 0.0});
    EXPECT_GT(full.first_landing_time, lands(wet_tower({})));
    EXPECT_LT(std::abs(full.energy.imbalance), 1e-9);
}

/// The wet tower under a full joint whose friction, mu < b/h, lets go of it before it can stand on a corner: at rest it tips at
/// a_t = 0.7 g b/h, then the crack lets in so much water that it slides with the rest of the acceleration: a_t is its yield.
RockingBlock tower_on_a_full_joint()
{
    const double weight = tower(1.0).mass * g;
    return wet_tower(UpliftResultant{0.3 * weight, 0.6 * weight}, 0.39);
}

// Between A (1 - t/t_d) >= a_t and rest the slip is (2/3) t_d^2 (A - a_t)^3/A^2, as of a sliding block that yields at a_t. With
// the water of the shut joint it would not slide below 0.351 g, with that of the open one from 0.273 g on.
TEST(Rocking, SlidesFlatWithTheCrackThatKeepsItsBalance)
{
    const double tips = 0.7 * g * 0.4, start = 0.4 * g, decay = 1.5;
    const double exact = 2.0 / 3.0 * decay * decay * std::pow(start - tips, 3) / (start * start);
    for (const double sense : {1.0, -1.0}) {
        SlideOptions two_way;
        two_way.sliding.two_way = true;
        const GroundMotion ramp = ground_of([=](double t) { return sense * start * (1.0 - t / decay); }, decay, 37);
        const RockingResult r = rock_and_slide(ramp, tower_on_a_full_joint(), two_way);
        EXPECT_NEAR(r.slide.slip, sense * exact, 1e-10 * exact);
        EXPECT_NEAR(r.slide.first_slip_time, 0.0, 1e-12);
        EXPECT_EQ(r.slide.phases, 1);
        EXPECT_EQ(r.rocks, 0);
        EXPECT_EQ(r.slide.status, Status::at_rest);
        EXPECT_NEAR(r.energy.friction, tower(1.0).mass * tips * exact, 1e-9 * r.energy.friction);
        EXPECT_LT(std::abs(r.energy.imbalance), 1e-9);
    }
}

/// The same block with water that takes time to come and go: its share w of the full joint grows with the moment that would tip
/// the block on the full joint, w' = (10 (a - s'') - 0.7 g 4)/(10 g lag), in [0, 1]. Explicit steps of lag/10.
struct LateWater {
    double lag; ///< [s]
    double slip = 0.0, rate = 0.0, accel = 0.0, share = 0.0;
    void step(double ground, double dt)
    {
        share = std::clamp(share + dt / lag * ((ground - accel) / g - 0.28), 0.0, 1.0);
        const double held = 0.39 * g * (0.9 - 0.2 * share);
        const bool rests = rate == 0.0 && std::abs(ground) <= held;
        accel = rests ? 0.0 : ground - std::copysign(held, rate != 0.0 ? rate : ground);
        double next = rate + accel * dt;
        if (rate * next < 0.0) next = accel = 0.0; // it stops
        slip += 0.5 * (rate + next) * dt;
        rate = next;
    }
};

// The limit of fast water is reached in proportion to its lag.
TEST(Rocking, SlidesAsWaterThatTakesAMomentLetsIt)
{
    const GroundMotion motion =
        ground_of([](double t) { return 1.2 + 2.4 * std::sin(7.0 * t) * std::sin(0.5 * t); }, 6.0, 6000);
    SlideOptions brief;
    brief.sliding.run_out_max = 0.0;
    const RockingResult r = rock_and_slide(motion, tower_on_a_full_joint(), brief);
    ASSERT_EQ(r.rocks, 0);
    ASSERT_GT(r.slide.phases, 3);
    const auto off_by = [&](int parts) {
        const double dt = motion.dt / parts;
        LateWater block{10.0 * dt};
        for (std::size_t k = 0; k + 1 < motion.accel_h.size(); ++k)
            for (int i = 0; i < parts; ++i) {
                const double share = (i + 0.5) / parts;
                block.step((1.0 - share) * motion.accel_h[k] + share * motion.accel_h[k + 1], dt);
            }
        return block.slip / r.slide.slip - 1.0;
    };
    const double fast = off_by(400), faster = off_by(4000);
    EXPECT_NEAR(fast / faster, 10.0, 0.5);
    EXPECT_NEAR((10.0 * faster - fast) / 9.0, 0.0, 2e-5); // without lag; what is left is of its square
}

// A thrust on top, shaken so that it rocks, too: on its toe it would slide, come back, stand, and tip again without end.
TEST(Rocking, AFullJointEndsWithoutEndlessLandings)
{
    RockingBlock block = tower_on_a_full_joint();
    block.force_t = 0.1 * block.mass * g;
    block.moment += 3.0 * block.force_t;
    for (const double peak : {4.0, 7.0, 10.0}) {
        const RockingResult r = rock_and_slide(shaking(peak), block, {});
        EXPECT_EQ(r.slide.status, Status::at_rest) << peak;
        EXPECT_GT(r.slide.slip, 0.0) << peak;
        EXPECT_LT(r.landings, 2000) << peak;
        EXPECT_LT(std::abs(r.energy.imbalance), 1e-9) << peak;
    }
}

// Sliding and rocking at once: the energy closes, and below its start nothing rocks. A joint that would be
// dry once open is shut and wet until then: sliding tips the block where 0.9 mu > b/h = 0.4, and below that it stays flat.
TEST(Rocking, SlidesAndRocksOnBothRules)
{
    const double weight = tower(1.0).mass * g;
    const UpliftResultant dry{0.0, 0.0}, full{0.3 * weight, 0.6 * weight};
    for (const UpliftResultant& open : {dry, full}) {
        const RockingBlock block = wet_tower(open, open.force == 0.0 ? 0.45 : 0.41);
        const RockingResult r = rock_and_slide(shaking(9.0), block, {});
        EXPECT_GT(r.rocks, 2) << open.force;
        EXPECT_LT(std::abs(r.energy.imbalance), 1e-9) << open.force;
        EXPECT_EQ(rock_and_slide(shaking(2.5), block, {}).rocks, 0) << open.force; // a_h below 0.7 g 2/5
    }
    EXPECT_GT(rock_and_slide(shaking(9.0), wet_tower(full, 0.41), {}).slide.phases, 2);
    SlideOptions two_way;
    two_way.sliding.two_way = true;
    const RockingResult flat = rock_and_slide(shaking(9.0), wet_tower(dry, 0.44), two_way);
    EXPECT_EQ(flat.rocks, 0);
    EXPECT_GT(flat.slide.phases, 2);
}

// Between b/h and that the block that stood on a dry joint would be held by more friction than the one that slides on the shut one:
// it would stop, come back and start again without end.
TEST(Rocking, AJointThatDriesEndsWithoutEndlessLandings)
{
    RockingBlock block = wet_tower(UpliftResultant{0.0, 0.0}, 0.42);
    block.force_t = 0.1 * block.mass * g;
    block.moment += 3.0 * block.force_t;
    for (const double peak : {7.0, 10.0, 14.0}) {
        const RockingResult r = rock_and_slide(shaking(peak), block, {});
        EXPECT_EQ(r.slide.status, Status::at_rest) << peak;
        EXPECT_LT(std::abs(r.energy.imbalance), 1e-9) << peak;
    }
}

TEST(Rocking, IsAMethodOfSweepsAndAModelLevel)
{
    EXPECT_EQ(sweep_method("rocking").kind, SweepKind::rocking);
    const auto model_level = parse_model_level("rigid:h+v,rocking");
    ASSERT_TRUE(model_level);
    EXPECT_EQ(model_level_id(*model_level), "rigid:h+v,rocking");
    EXPECT_EQ(model_of(*model_level), "rigid:h+v,rocking");
}

TEST(Rocking, RefusesARestitutionAboveOne)
{
    try {
        parse_scene(
            "[section]\nheight_m = 10\nbase_m = 8\n[dam]\ndensity_kg_m3 = 2400\n[contact]\nfriction = 0.7\n[sliding]\n"
            "restitution = 1.5\n",
            "dam.toml", FileCheck::skip);
        ADD_FAILURE() << "accepted";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("sliding.restitution"), std::string::npos) << error.what();
        EXPECT_NE(std::string(error.what()).find("1.5"), std::string::npos);
    }
}

} // namespace
} // namespace damslip::sliding
