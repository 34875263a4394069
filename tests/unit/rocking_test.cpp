#include "analysis/accuracy/rung.hpp"
#include "analysis/sweep/sweep_method.hpp"
#include "core/input_error.hpp"
#include "program_answer.hpp"
#include "scene/read.hpp"
#include "sliding/block/yield.hpp"
#include "sliding/equilibrium/base_limits.hpp"
#include "sliding/rocking/corner.hpp"
#include "sliding/rocking/rocking.hpp"
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

// Sliding and rocking at once: the energy closes, and below its start nothing rocks. Above a dry joint sliding friction tips the
// block where mu > b/h = 0.4, whatever the uplift that it stood on before; below that it slides and stays flat.
TEST(Rocking, SlidesAndRocksOnBothRules)
{
    const double weight = tower(1.0).mass * g;
    const UpliftResultant dry{0.0, 0.0}, full{0.3 * weight, 0.6 * weight};
    for (const UpliftResultant& open : {dry, full}) {
        const RockingBlock block = wet_tower(open, 0.41);
        const RockingResult r = rock_and_slide(shaking(9.0), block, {});
        EXPECT_GT(r.rocks, 2) << open.force;
        EXPECT_LT(std::abs(r.energy.imbalance), 1e-9) << open.force;
        EXPECT_EQ(rock_and_slide(shaking(2.5), block, {}).rocks, 0) << open.force; // a_h below 0.7 g 2/5
    }
    EXPECT_GT(rock_and_slide(shaking(9.0), wet_tower(full, 0.41), {}).slide.phases, 2);
    SlideOptions two_way;
    two_way.sliding.two_way = true;
    const RockingResult flat = rock_and_slide(shaking(9.0), wet_tower(dry, 0.38), two_way);
    EXPECT_EQ(flat.rocks, 0);
    EXPECT_GT(flat.slide.phases, 2);
}

TEST(Rocking, IsAMethodOfSweepsAndARungOfTheLadder)
{
    EXPECT_EQ(sweep_method("rocking").kind, SweepKind::rocking);
    const auto rung = parse_rung("rigid:h+v,rocking");
    ASSERT_TRUE(rung);
    EXPECT_EQ(rung_id(*rung), "rigid:h+v,rocking");
    EXPECT_EQ(model_of(*rung), "rigid:h+v,rocking");
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
