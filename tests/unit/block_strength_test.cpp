// Strength that changes with slip: cohesion lost, residual friction, tables, drains; closed solutions.
#include "block_motions.hpp"
#include "core/input_error.hpp"
#include "sliding/block/slide.hpp"
#include "verification/exact/block_slip.hpp"

#include <gtest/gtest.h>

using namespace damslip;
using namespace damslip::sliding;
using namespace damslip::test;

namespace {

RigidBlock unit_block()
{
    RigidBlock block;
    block.mass = 1.0;
    block.gravity = 10.0;
    return block;
}

Contact linear_contact(double peak, double residual, double over_slip)
{
    Contact contact;
    contact.friction = peak;
    contact.residual_friction = residual;
    contact.residual_slip = over_slip;
    contact.residual_path = Interpolation::linear;
    return contact;
}

GroundMotion triangle(double A, double t1, int n)
{
    return sampled([=](double t) { return t < t1 ? A * t / t1 : A * (2.0 - t / t1); }, t1 / n, 2 * n);
}

} // namespace

TEST(BlockStrength, cohesion_is_lost_at_first_slip)
{
    RigidBlock block = unit_block();
    block.cohesion_force = 1.5;
    Contact contact;
    contact.friction = 0.3; // yields 4.5 with, 3.0 m/s^2 without cohesion
    for (const int n : {1, 7, 10}) {
        const GroundMotion motion = triangle(5.0, 0.5, n);
        const SlideResult lost = slide(motion, strength_stages(block, contact));
        EXPECT_LT(relative(lost.slip, exact::slip_under_triangle_after_start(5.0, 0.5, 4.5, 3.0)), 1e-12);
        contact.cohesion_lost_at_slip = false;
        const SlideResult kept = slide(motion, strength_stages(block, contact));
        EXPECT_LT(relative(kept.slip, exact::slip_under_triangle(5.0, 0.5, 4.5)), 1e-12);
        contact.cohesion_lost_at_slip = true;
        EXPECT_EQ(slide(triangle(4.4, 0.5, n), strength_stages(block, contact)).slip,
                  0.0); // never started: still bonded
    }
}

// Two pulses: the second starts without cohesion.
TEST(BlockStrength, cohesion_stays_lost)
{
    RigidBlock block = unit_block();
    block.cohesion_force = 1.5;
    Contact contact;
    contact.friction = 0.3;
    GroundMotion motion = triangle(5.0, 0.5, 4);
    const GroundMotion second = triangle(4.0, 0.5, 4);
    motion.accel_h.insert(motion.accel_h.end(), 40, 0.0);
    motion.accel_h.insert(motion.accel_h.end(), second.accel_h.begin(), second.accel_h.end());
    const double exact =
        exact::slip_under_triangle_after_start(5.0, 0.5, 4.5, 3.0) + exact::slip_under_triangle(4.0, 0.5, 3.0);
    const SlideResult result = slide(motion, strength_stages(block, contact));
    EXPECT_LT(relative(result.slip, exact), 1e-12);
    EXPECT_EQ(result.phases, 2);
}

TEST(BlockStrength, residual_friction_by_a_step)
{
    Contact contact;
    contact.friction = 0.3;
    contact.residual_friction = 0.2;
    contact.residual_slip = 0.25;
    for (const int n : {1, 3, 100})
        EXPECT_LT(relative(slide(steady(5.0, 1.0, n), strength_stages(unit_block(), contact)).slip,
                           exact::slip_with_residual(5.0, 1.0, 3.0, 2.0, 0.25)),
                  1e-12);
    contact.residual_slip = 0.0; // at first slip
    EXPECT_LT(relative(slide(steady(5.0, 1.0, 4), strength_stages(unit_block(), contact)).slip,
                       exact::slip_under_rectangle(5.0, 1.0, 2.0)),
              1e-12);
}

// Many small steps of a table are the same as the linear law up to the steps' size: order 1 in the step, so 1e-3 for
// 2000 steps.
TEST(BlockStrength, softening_linear_in_slip)
{
    const double kappa = 10.0 * (0.3 - 0.1) / 0.5;
    const double exact = exact::slip_with_softening(4.0, 1.0, 3.0, kappa, 0.5);
    for (const int n : {1, 2, 10, 200}) {
        const SlideResult result =
            slide(steady(4.0, 1.0, n), strength_stages(unit_block(), linear_contact(0.3, 0.1, 0.5)));
        EXPECT_LT(relative(result.slip, exact), 1e-12) << n;
        EXPECT_EQ(result.accuracy, SlideAccuracy::closed_form);
    }
    Contact steps;
    for (int i = 0; i <= 2000; ++i) steps.friction_table.push_back({0.5 * i / 2000.0, 0.3 - 0.2 * i / 2000.0});
    EXPECT_LT(relative(slide(steady(4.0, 1.0, 10), strength_stages(unit_block(), steps)).slip, exact), 1e-3);
}

// Friction that grows with slip: half a period of a cosine, then at rest under the same ground acceleration, whatever
// the record's length.
TEST(BlockStrength, hardening_linear_in_slip_stops_by_itself)
{
    const double omega = std::sqrt(10.0 * 0.6 / 1.0);
    for (const double duration : {2.0, 10.0})
        for (const int n : {1, 5, 400}) {
            const SlideResult result =
                slide(steady(4.0, duration, n), strength_stages(unit_block(), linear_contact(0.3, 0.9, 1.0)));
            EXPECT_LT(relative(result.slip, exact::slip_with_hardening(4.0, 3.0, omega)), 1e-12);
            EXPECT_NEAR(result.last_slip_time, std::numbers::pi / omega, 1e-12);
            EXPECT_NEAR(result.peak_slip_rate, 1.0 / omega, 1e-12);
        }
}

// N' changes with a_v: no closed form; extended-precision Runge-Kutta with 2e4 steps per second (its error, (5e-5)^4 of
// order one, is 1e-17).
TEST(BlockStrength, linear_in_slip_under_vertical_motion_is_a_series)
{
    const SlipStages stages = strength_stages(unit_block(), linear_contact(0.3, 0.9, 1.0));
    for (const double q : {1.5, -1.5}) {
        const double exact = exact::slip_with_sloped_friction(4.0, 0.3, 0.6, 10.0, 0.5, q, 20000);
        for (const int n : {1, 8, 200}) {
            const GroundMotion motion =
                sampled([](double) { return 4.0; }, [=](double t) { return 0.5 + q * t; }, 3.0 / n, n);
            const SlideResult result = slide(motion, stages);
            EXPECT_GT(result.slip, exact * (1.0 - 1e-12)); // q < 0 may start again later as N' falls
            if (q > 0.0) {
                EXPECT_LT(relative(result.slip, exact), 1e-12) << n;
            }
            EXPECT_EQ(result.accuracy, SlideAccuracy::series);
            EXPECT_FALSE(result.notes.empty());
        }
    }
}

// A table with slopes of zero must be the block without a table; and a table of one slope the same as two halves of it.
TEST(BlockStrength, tables_are_consistent)
{
    const GroundMotion motion = wild_motion(6.0, 0.01, 2500);
    Contact flat;
    flat.friction_table = {{0.0, 0.15}, {0.05, 0.15}, {0.1, 0.15}};
    const double plain = slide(motion, block_with_yield(1.5)).slip;
    for (const Interpolation path : {Interpolation::steps, Interpolation::linear}) {
        flat.residual_path = path;
        const SlideResult result = slide(motion, strength_stages(unit_block(), flat));
        EXPECT_NEAR(result.slip, plain, 1e-12 * (result.downstream_slip + result.upstream_slip));
    }
    Contact one = linear_contact(0.3, 0.1, 0.2), two = one;
    two.friction_table = {{0.0, 0.3}, {0.07, 0.23}, {0.2, 0.1}};
    const SlideResult a = slide(motion, strength_stages(unit_block(), one)),
                      b = slide(motion, strength_stages(unit_block(), two));
    EXPECT_NEAR(a.slip, b.slip,
                1e-11 * (a.downstream_slip + a.upstream_slip)); // softening amplifies the round-off of 0.07 and 0.23
    const SlideResult fine = slide(subdivided(motion, 7), strength_stages(unit_block(), one));
    EXPECT_NEAR(a.slip, fine.slip, 1e-11 * (a.downstream_slip + a.upstream_slip));
}

// Drains sheared off: uplift 2 to 4 N/m at slip 0.1 m, the yield falls from 0.5 (10 - 2) to 0.5 (10 - 4).
TEST(BlockStrength, drains_lost_at_a_slip)
{
    RigidBlock block = unit_block();
    block.uplift = 2.0;
    Contact contact;
    contact.friction = 0.5;
    RigidBlock drained_no_more = block;
    drained_no_more.uplift = 4.0;
    drained_no_more.friction = std::nan(""); // strength stays that of the stages
    drained_no_more.cohesion_force = std::nan("");
    const SlipStages stages = with_block_from(strength_stages(block, contact), 0.1, drained_no_more);
    EXPECT_LT(relative(slide(steady(5.0, 1.0, 9), stages).slip, exact::slip_with_residual(5.0, 1.0, 4.0, 3.0, 0.1)),
              1e-12);
    contact = linear_contact(0.5, 0.3, 0.2);
    const SlipStages mixed = with_block_from(strength_stages(block, contact), 0.1, drained_no_more);
    ASSERT_EQ(mixed.size(), 3u);
    EXPECT_NEAR(mixed[1].block.friction, 0.4, 1e-15);
    EXPECT_EQ(mixed[0].block.uplift, 2.0);
    EXPECT_EQ(mixed[1].block.uplift, 4.0);
    EXPECT_EQ(mixed[2].block.uplift, 4.0);
    EXPECT_EQ(mixed[2].block.friction, 0.3);
}

TEST(BlockStrength, refuses_bad_stages)
{
    const GroundMotion motion = steady(1.0, 1.0);
    SlipStages stages{
        {0.0, block_with_yield(1.0), 0.0}, {0.2, block_with_yield(1.0), 0.0}, {0.1, block_with_yield(1.0), 0.0}};
    EXPECT_THROW(slide(motion, stages), InputError);
    EXPECT_THROW(slide(motion, SlipStages{}), InputError);
    EXPECT_THROW(slide(motion, SlipStages{{0.1, block_with_yield(1.0), 0.0}}), InputError);
    EXPECT_THROW(slide(motion, SlipStages{{0.0, block_with_yield(1.0), -0.5}}), InputError); // endless slope
    EXPECT_THROW(slide(motion, SlipStages{{0.0, block_with_yield(1.0), -0.5}, {1.0, block_with_yield(1.0), 0.0}}),
                 InputError); // mu < 0
}
