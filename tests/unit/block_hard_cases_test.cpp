// Motions and blocks that break careless integrators: every result must be finite, resolved and right.
#include "block_motions.hpp"
#include "core/input_error.hpp"
#include "sliding/block/slide_batch.hpp"
#include "verification/exact/block_slip.hpp"

#include <gtest/gtest.h>

#include <random>

using namespace damslip;
using namespace damslip::sliding;
using namespace damslip::test;

namespace {

GroundMotion samples(std::vector<double> accel, double dt)
{
    return {"test", dt, std::move(accel), {}, {}};
}

} // namespace

TEST(BlockHardCases, single_spike)
{
    std::vector<double> accel(1001, 0.0);
    accel[500] = 5.0;
    for (const double a_y : {0.01, 1.0, 3.0, 4.999})
        EXPECT_LT(relative(slide(samples(accel, 0.01), block_with_yield(a_y)).slip,
                           exact::slip_under_triangle(5.0, 0.01, a_y)),
                  1e-11);
}

// Scale does not matter: amplitudes of 1e-12 and 1e9 give the same slip in units of A t^2.
TEST(BlockHardCases, amplitudes)
{
    for (const double A : {1e-12, 1e-150, 1.0, 1e9}) {
        const GroundMotion motion = sampled([=](double t) { return A * (1.0 - t); }, 0.0625, 16);
        EXPECT_LT(relative(slide(motion, block_with_yield(0.6 * A)).slip / A, 2.0 / 3.0 * 0.4 * 0.4 * 0.4), 1e-13) << A;
    }
}

// a_y equal to a sample, to the peak, to a plateau: nothing starts at equality.
TEST(BlockHardCases, yield_equal_to_samples)
{
    const RigidBlock block = block_with_yield(5.0);
    ASSERT_EQ(block.friction * block.gravity, 5.0);
    EXPECT_EQ(slide(samples({0.0, 2.0, 5.0, 2.0, 0.0}, 0.1), block).slip, 0.0);
    EXPECT_EQ(slide(samples({0.0, 5.0, 5.0, 5.0, 0.0}, 0.1), block).slip, 0.0);
    EXPECT_EQ(slide(samples({5.0, 5.0}, 0.1), block).slip, 0.0);
    // Through the yield exactly on a sample: a triangle above it.
    const double dt = 0.1, e = 1.0;
    const double exact = e * dt * dt * (1.0 + 2.0 * std::numbers::sqrt2 / 3.0);
    EXPECT_LT(relative(slide(samples({0.0, 5.0, 6.0, 5.0, 4.0, 3.0, 0.0}, dt), block).slip, exact), 1e-13);
    EXPECT_LT(relative(slide_constant_yield(std::vector{0.0, 5.0, 6.0, 5.0, 4.0, 3.0, 0.0}, dt, 5.0).slip, exact),
              1e-13);
}

// Stop exactly on a sample and reversal there at once: a = +-A alternating in steps of two samples, linear between,
// equal yields.
TEST(BlockHardCases, reversals_on_samples)
{
    std::vector<double> accel;
    for (int k = 0; k < 200; ++k) accel.push_back(k % 4 < 2 ? 4.0 : -4.0);
    for (const double a_y : {0.5, 1.0, 2.0, 3.9}) {
        const SlideResult result = slide(samples(accel, 0.25), block_with_yield(a_y));
        const double path = result.downstream_slip + result.upstream_slip;
        EXPECT_NEAR(result.slip, exact::slip_of_interpolant(accel, 0.25, a_y, a_y), 1e-13 * path) << a_y;
        SlideOptions one_way;
        one_way.sliding.two_way = false;
        const SlideResult downstream = slide(samples(accel, 0.25), block_with_yield(a_y), one_way);
        EXPECT_NEAR(slide_constant_yield(accel, 0.25, a_y).slip, downstream.slip, 1e-13 * path);
        EXPECT_EQ(slide_constant_yield(accel, 0.25, a_y).phases, downstream.phases);
    }
}

// a_y = 0: the block starts with the first positive sample and nothing brakes it after the record.
TEST(BlockHardCases, zero_yield_never_stops)
{
    const SlideResult result = slide(samples({0.0, 1.0, 0.0}, 0.1), block_with_yields(0.0, 1.0));
    EXPECT_EQ(result.status, Status::sliding_at_end);
    EXPECT_NEAR(result.slip, 0.01 + 0.1 * 60.0, 1e-9);
}

TEST(BlockHardCases, ten_minutes)
{
    GroundMotion motion = wild_motion(5.0, 0.005, 120000);
    for (std::size_t k = 0; k < motion.accel_h.size(); ++k)
        motion.accel_h[k] += 1.5 * std::sin(0.011 * static_cast<double>(k));
    const double exact = exact::slip_of_interpolant(motion.accel_h, motion.dt, 0.9, 1.3);
    const SlideResult result = slide(motion, block_with_yields(0.9, 1.3));
    EXPECT_NEAR(result.slip, exact, 1e-12 * (result.downstream_slip + result.upstream_slip));
    const double one_way = exact::slip_of_interpolant(motion.accel_h, motion.dt, 0.9, 1e9);
    EXPECT_NEAR(slide_constant_yield(motion.accel_h, motion.dt, 0.9).slip, one_way, 1e-12 * one_way);
}

TEST(BlockHardCases, bad_motions_are_refused)
{
    const RigidBlock block = block_with_yield(1.0);
    EXPECT_THROW(slide(samples({1.0}, 0.1), block), InputError);
    EXPECT_THROW(slide(samples({1.0, 2.0}, 0.0), block), InputError);
    EXPECT_THROW(slide(samples({1.0, 2.0}, -1.0), block), InputError);
    EXPECT_THROW(slide(samples({1.0, std::nan("")}, 0.1), block), InputError);
    GroundMotion motion = samples({1.0, 2.0}, 0.1);
    motion.accel_v = {1.0};
    EXPECT_THROW(slide(motion, block), InputError);
}

/// Random block, strength, motion and options. `grid` rounds the values to multiples of it times their range: with a
/// coarse grid coincidences (equal samples, N' = 0 or the yield exactly on a sample) are common; 0 leaves them as
/// drawn.
struct RandomCase {
    SlipStages stages;
    GroundMotion motion{"random", 0.02, {}, {}, {}};
    SlideOptions options;

    RandomCase(std::mt19937& random, bool rounded)
    {
        const auto pick = [&](double lo, double hi, double grid) {
            const double x = lo + (hi - lo) * (static_cast<double>(random()) / 4294967296.0);
            return rounded ? std::round(x / grid) * grid : x;
        };
        const auto coin = [&] { return random() % 2 == 0; };
        RigidBlock block;
        block.mass = 1.0;
        block.gravity = 10.0;
        block.added_mass = {pick(0.0, 1.0, 0.5), 0.0, pick(0.0, 0.3, 0.1)};
        block.horizontal_force = pick(-3.0, 3.0, 1.0);
        block.uplift = pick(0.0, 6.0, 2.0);
        block.cohesion_force = pick(0.0, 2.0, 1.0);
        block.base_inclination = coin() ? 0.0 : pick(-0.4, 0.4, 0.2);
        Contact contact;
        contact.friction = pick(0.0, 1.2, 0.1);
        contact.cohesion_lost_at_slip = coin();
        if (coin()) {
            contact.residual_friction = pick(0.0, 1.2, 0.1);
            contact.residual_slip = pick(0.0, 0.02, 0.005);
            contact.residual_path = coin() ? Interpolation::steps : Interpolation::linear;
        }
        for (int k = 0; k < 60; ++k) {
            motion.accel_h.push_back(pick(-10.0, 10.0, 2.0));
            motion.accel_v.push_back(pick(-14.0, 14.0, 2.0));
        }
        options.sliding.lift_off = coin() ? LiftOff::no_friction : LiftOff::ballistic;
        options.sliding.two_way = coin();
        options.sliding.run_out_max = 1.0;
        stages = strength_stages(block, contact);
    }
};

// Coincidences on purpose: finite, resolved, the same bits with skipping. The slip itself may jump there (does a bond
// break that is just reached?).
TEST(BlockHardCases, coincidences_are_resolved)
{
    std::mt19937 random(20240501);
    for (int trial = 0; trial < 4000; ++trial) {
        const RandomCase c(random, true);
        const SlideResult result = slide(c.motion, c.stages, c.options);
        EXPECT_TRUE(std::isfinite(result.slip)) << trial;
        EXPECT_NE(result.status, Status::not_resolved)
            << trial << " theta " << c.stages[0].block.base_inclination << " cohesion "
            << c.stages.back().block.cohesion_force << " slope " << c.stages[0].friction_slope << " flight "
            << (c.options.sliding.lift_off == LiftOff::ballistic) << " mu " << c.stages[0].block.friction;
        EXPECT_GE(result.downstream_slip, 0.0);
        EXPECT_GE(result.upstream_slip, 0.0);
        if (!c.options.sliding.two_way) {
            EXPECT_EQ(result.upstream_slip, 0.0);
        }
        EXPECT_EQ(slide(SkippingMotion(c.motion), c.stages, c.options).slip, result.slip) << trial;
    }
}

// Without coincidences the slip does not depend on how the motion is sampled: 1e-9, as starts just above the yield
// amplify round-off.
TEST(BlockHardCases, random_cases_do_not_depend_on_subdivision)
{
    std::mt19937 random(20240502);
    for (int trial = 0; trial < 4000; ++trial) {
        RandomCase c(random, false);
        // A block that is kept from moving upstream by decree, flies and lies on an incline has no well-defined
        // take-off: left out.
        if (!c.options.sliding.two_way && c.stages[0].block.base_inclination != 0.0)
            c.options.sliding.lift_off = LiftOff::no_friction;
        const SlideResult result = slide(c.motion, c.stages, c.options);
        EXPECT_NE(result.status, Status::not_resolved)
            << trial << " theta " << c.stages[0].block.base_inclination << " cohesion "
            << c.stages.back().block.cohesion_force << " slope " << c.stages[0].friction_slope << " flight "
            << (c.options.sliding.lift_off == LiftOff::ballistic) << " mu " << c.stages[0].block.friction;
        const SlideResult fine = slide(subdivided(c.motion, 3), c.stages, c.options);
        EXPECT_NEAR(fine.slip, result.slip, 1e-9 * (1.0 + result.downstream_slip + result.upstream_slip))
            << trial << " stages " << c.stages.size() << " theta " << c.stages[0].block.base_inclination << " cohesion "
            << c.stages[0].block.cohesion_force << " slope " << c.stages[0].friction_slope << " flight "
            << (c.options.sliding.lift_off == LiftOff::ballistic) << " two-way " << c.options.sliding.two_way;
    }
}
