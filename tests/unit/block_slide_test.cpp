// The event-located integrator against closed solutions.
#include "block_motions.hpp"
#include "core/input_error.hpp"
#include "sliding/block/slide.hpp"
#include "verification/exact/block_slip.hpp"

#include <gtest/gtest.h>

using namespace damslip;
using namespace damslip::sliding;
using namespace damslip::test;

namespace {

SlideOptions one_way()
{
    SlideOptions options;
    options.sliding.two_way = false;
    return options;
}

} // namespace

// Newmark (1965). One interval of steady acceleration, then run-out: round-off only.
TEST(BlockSlide, rectangle)
{
    for (const int n : {1, 2, 10, 77}) {
        const SlideResult result = slide(steady(5.0, 1.0, n), block_with_yield(2.0));
        EXPECT_LT(relative(result.slip, exact::slip_under_rectangle(5.0, 1.0, 2.0)), 1e-13);
        EXPECT_EQ(result.status, Status::at_rest);
        EXPECT_NEAR(result.peak_slip_rate, 3.0, 1e-13);
        EXPECT_NEAR(result.last_slip_time, 2.5, 1e-13);
        EXPECT_EQ(result.first_slip_time, 0.0);
        EXPECT_EQ(result.phases, 1);
    }
}

TEST(BlockSlide, triangle)
{
    for (const double a_y : {0.3, 2.0, 2.93, 3.5, 4.9})
        for (const int n : {1, 3, 8}) {
            const auto ground = [](double t) { return t < 0.5 ? 10.0 * t : 10.0 * (1.0 - t); };
            const double exact = exact::slip_under_triangle(5.0, 0.5, a_y);
            EXPECT_LT(relative(slide(sampled(ground, 0.5 / n, 2 * n), block_with_yield(a_y)).slip, exact), 1e-12)
                << a_y << " " << n;
        }
}

// Ground a(t) = A (1 - t/t_d), A/2 <= a_y < A: D = (2/3) t_d^2 (A - a_y)^3 / A^2 (5, 3 m/s^2, 1 s: 16/75 m), at rest
// from 0.8 s on. At dt = 0.1 and 0.005 s the stop falls on a sample, at 0.0625 s inside an interval; round-off only.
TEST(BlockSlide, decaying_ramp_does_not_depend_on_dt)
{
    for (const double dt : {0.1, 0.0625, 0.005}) {
        const GroundMotion motion =
            sampled([](double t) { return 5.0 * (1.0 - t); }, dt, static_cast<int>(std::lround(1.0 / dt)));
        const SlideResult result = slide(motion, block_with_yield(3.0));
        EXPECT_LT(relative(result.slip, 16.0 / 75.0), 1e-13) << dt;
        EXPECT_NEAR(result.last_slip_time, 0.8, 1e-13);
        EXPECT_EQ(result.upstream_slip, 0.0);
        EXPECT_EQ(result.phases, 1);
    }
}

// An asymmetric pulse slides downstream with a_h > 0 (upstream ground acceleration) and not at all, or upstream, with
// the sign flipped.
TEST(BlockSlide, polarity)
{
    const GroundMotion motion = sampled([](double t) { return 5.0 * (1.0 - t); }, 0.1, 10);
    SlideOptions options = one_way();
    EXPECT_GT(slide(motion, block_with_yield(3.0), options).slip, 0.2);
    options.polarity = -1;
    EXPECT_EQ(slide(motion, block_with_yield(3.0), options).slip, 0.0);
    options.sliding.two_way = true;
    EXPECT_LT(relative(slide(motion, block_with_yield(3.0), options).slip, -16.0 / 75.0), 1e-13);
    EXPECT_EQ(slide(motion, block_with_yields(3.0, 5.5), options).slip, 0.0);
}

// Against extended precision with bisection for every event; one- and two-way, equal and unequal yields. The slip is a
// sum of some hundred phases of up to 1e3 intervals: 1e-12.
TEST(BlockSlide, wild_motion_against_extended_precision)
{
    const GroundMotion motion = wild_motion(6.0, 0.01, 3000);
    for (const double a_y : {0.05, 0.5, 1.7, 4.0})
        for (const double a_up : {1.0 * a_y, 1.6 * a_y, 1e9}) {
            SlideOptions options;
            options.sliding.two_way = a_up < 1e8;
            const RigidBlock block = a_up < 1e8 ? block_with_yields(a_y, a_up) : block_with_yield(a_y);
            const double exact = exact::slip_of_interpolant(motion.accel_h, motion.dt, a_y, a_up);
            const SlideResult result = slide(motion, block, options);
            EXPECT_NEAR(result.slip, exact, 1e-12 * (result.downstream_slip + result.upstream_slip))
                << a_y << " " << a_up;
        }
}

// The same piecewise-linear function with 1, 2 and 7 samples per interval.
TEST(BlockSlide, does_not_depend_on_subdivision)
{
    GroundMotion motion = wild_motion(6.0, 0.02, 1500);
    motion.accel_v = wild_motion(-4.0, 0.02, 1500).accel_h;
    for (const double inclination : {0.0, 0.1}) {
        RigidBlock block = block_with_yields(1.1, 2.3);
        block.base_inclination = inclination;
        block.friction += inclination;
        const SlideResult coarse = slide(motion, block);
        ASSERT_GT(coarse.slip, 0.01);
        for (const int parts : {2, 7}) {
            const SlideResult fine = slide(subdivided(motion, parts), block);
            EXPECT_LT(relative(fine.slip, coarse.slip), 1e-12) << parts;
            EXPECT_EQ(fine.phases, coarse.phases);
        }
    }
}
