// Vertical ground motion, lift-off with and without flight, inclined base.
#include "block_motions.hpp"
#include "core/input_error.hpp"
#include "sliding/block/rigid_block.hpp"
#include "sliding/block/slide.hpp"
#include "verification/exact/block_slip.hpp"

#include <gtest/gtest.h>

using namespace damslip;
using namespace damslip::sliding;
using namespace damslip::test;

namespace {

RigidBlock friction_block(double mu)
{
    RigidBlock block;
    block.mass = 1.0;
    block.gravity = 10.0;
    block.friction = mu;
    return block;
}

SlideOptions ballistic()
{
    SlideOptions options;
    options.sliding.lift_off = LiftOff::ballistic;
    return options;
}

/// One small step of the vector equation (m I + M^w)(a_g + s'' t) = F + (U + N) n - R t, solved for s'' and N in x and
/// y.
struct VectorSolution {
    double slip_accel, normal;
};

VectorSolution vector_equation(const RigidBlock& b, double a_h, double a_v, double resisting_sign)
{
    const double c = std::cos(b.base_inclination), s = std::sin(b.base_inclination);
    const double Axx = b.mass + b.added_mass.xx, Axy = b.added_mass.xy, Ayy = b.mass + b.added_mass.yy;
    const double mu = resisting_sign * b.friction, coh = resisting_sign * b.cohesion_force;
    // A t s'' - (n - mu t) N = F + U n - coh t - A a_g: two equations for s'' and N.
    const double m11 = Axx * c - Axy * s, m21 = Axy * c - Ayy * s, m12 = -(s - mu * c), m22 = -(c + mu * s);
    const double r1 = b.horizontal_force + b.uplift * s - coh * c + Axx * a_h - Axy * a_v;
    const double r2 = -(b.mass * b.gravity + b.vertical_force) + b.uplift * c + coh * s + Axy * a_h - Ayy * a_v;
    const double det = m11 * m22 - m12 * m21;
    return {(r1 * m22 - m12 * r2) / det, (m11 * r2 - r1 * m21) / det};
}

/// Slip by explicit small steps of that equation; lift-off without flight. First order in the step.
double slip_by_small_steps(const GroundMotion& motion, const RigidBlock& block, int steps_per_sample)
{
    double s = 0.0, v = 0.0;
    const double h = motion.dt / steps_per_sample;
    RigidBlock smooth = block;
    smooth.friction = smooth.cohesion_force = 0.0;
    for (std::size_t k = 0; k + 1 < motion.accel_h.size(); ++k)
        for (int i = 0; i < steps_per_sample; ++i) {
            const double x = (i + 0.5) / steps_per_sample;
            const double a_h = motion.accel_h[k] + x * (motion.accel_h[k + 1] - motion.accel_h[k]);
            const double a_v = motion.accel_v[k] + x * (motion.accel_v[k + 1] - motion.accel_v[k]);
            const VectorSolution open = vector_equation(smooth, a_h, a_v, 1.0);
            double accel;
            if (open.normal <= 0.0)
                accel = open.slip_accel;
            else if (v != 0.0)
                accel = vector_equation(block, a_h, a_v, v > 0.0 ? 1.0 : -1.0).slip_accel;
            else
                accel = std::max(0.0, vector_equation(block, a_h, a_v, 1.0).slip_accel) +
                        std::min(0.0, vector_equation(block, a_h, a_v, -1.0).slip_accel);
            const double v_next = v + h * accel;
            const bool stops = v * v_next < 0.0 && open.normal > 0.0;
            s += stops ? 0.5 * v * v / std::abs(accel) * (v > 0.0 ? 1.0 : -1.0) : h * 0.5 * (v + v_next);
            v = stops ? 0.0 : v_next;
        }
    return s;
}

} // namespace

TEST(BlockVertical, steady_vertical_acceleration_scales_the_yield)
{
    const double mu = 0.3, A = 5.0;
    for (const double a_v : {3.0, -3.0}) {
        const GroundMotion motion = sampled([=](double) { return A; }, [=](double) { return a_v; }, 0.25, 4);
        const double v = A - mu * (10.0 + a_v);
        const double exact = 0.5 * v + v * v / (2.0 * mu * 10.0);
        const double flipped = 0.5 * (A - mu * (10.0 - a_v)) + std::pow(A - mu * (10.0 - a_v), 2) / (2.0 * mu * 10.0);
        const double slip = slide(motion, friction_block(mu)).slip;
        EXPECT_LT(relative(slip, exact), 1e-13);
        EXPECT_GT(relative(slip, flipped), 0.2); // a flipped sign of a_v is another answer
    }
}

TEST(BlockVertical, falling_vertical_acceleration)
{
    const double A = 2.0, q = 8.0, T = 1.0, mu = 0.4;
    for (const int n : {1, 3, 10, 50}) {
        const GroundMotion motion = sampled([=](double) { return A; }, [=](double t) { return -q * t; }, T / n, n);
        const SlideResult result = slide(motion, friction_block(mu));
        EXPECT_LT(relative(result.slip, exact::slip_under_falling_vertical(A, q, T, mu, 10.0)), 1e-12) << n;
        EXPECT_EQ(result.lift_offs, 0);
    }
}

// N' = 0 at 0.5 s: on a sample for even n, inside an interval for odd n.
TEST(BlockVertical, lift_off_without_flight)
{
    const double A = 2.0, q = 20.0, T = 1.0, mu = 0.4;
    for (const int n : {1, 2, 3, 10, 77}) {
        const GroundMotion motion = sampled([=](double) { return A; }, [=](double t) { return -q * t; }, T / n, n);
        const SlideResult result = slide(motion, friction_block(mu));
        EXPECT_LT(relative(result.slip, exact::slip_with_lift_off(A, q, T, mu, 10.0)), 1e-12) << n;
        EXPECT_EQ(result.lift_offs, 1);
    }
}

// Open base, cohesion or not: no resistance at all; and in one-way sliding no upstream movement.
TEST(BlockVertical, open_base_has_no_resistance)
{
    const GroundMotion motion = sampled([](double) { return -2.0; }, [](double) { return -15.0; }, 0.1, 10);
    RigidBlock block = friction_block(0.5);
    block.cohesion_force = 7.0;
    SlideOptions options;
    options.sliding.run_out_max = 0.0;
    EXPECT_LT(relative(slide(motion, block, options).slip, -1.0), 1e-13);
    options.sliding.two_way = false;
    EXPECT_EQ(slide(motion, block, options).slip, 0.0);
}

TEST(BlockVertical, ballistic_landing)
{
    RigidBlock block = friction_block(0.3);
    block.mass = 2.0;
    block.added_mass.xx = 1.0;
    for (const double A : {3.0, 30.0, 0.3}) // in between: lands and coasts; lands at speed; stopped by the landing
        for (const int n : {1, 4, 31}) {
            const GroundMotion motion = sampled([=](double) { return A; }, [](double) { return -18.0; }, 0.5 / n, n);
            const SlideResult result = slide(motion, block, ballistic());
            EXPECT_LT(relative(result.slip, exact::slip_with_landing(A, 18.0, 0.5, 0.3, 10.0, 2.0, 1.0)), 1e-12)
                << A << " " << n;
            EXPECT_EQ(result.lift_offs, 1);
            EXPECT_NEAR(result.max_gap, 1.0 + 4.0 * 4.0 / 20.0, 1e-12); // y_T = 1 m, y_T' = 4 m/s
            EXPECT_EQ(result.status, Status::at_rest);
        }
}

// N' > 0 throughout: both treatments of lift-off give the same bits.
TEST(BlockVertical, flight_option_changes_nothing_without_lift_off)
{
    GroundMotion motion = wild_motion(6.0, 0.01, 2000);
    motion.accel_v = wild_motion(5.0, 0.01, 2000).accel_h;
    EXPECT_EQ(slide(motion, friction_block(0.2)).slip, slide(motion, friction_block(0.2), ballistic()).slip);
}

// Newmark (1965): a_y = g tan(phi - theta), sliding with cos(phi - theta)/cos(phi) times the excess.
TEST(BlockVertical, inclined_plane)
{
    const double phi = 0.5, theta = 0.2;
    RigidBlock block = friction_block(std::tan(phi));
    block.base_inclination = theta;
    const double exact =
        std::cos(phi - theta) / std::cos(phi) * exact::slip_under_rectangle(6.0, 1.0, 10.0 * std::tan(phi - theta));
    EXPECT_LT(relative(slide(steady(6.0, 1.0, 5), block).slip, exact), 1e-12);
    block.base_inclination = -theta; // dips upstream: the flipped sign is another answer
    EXPECT_GT(relative(slide(steady(6.0, 1.0, 5), block).slip, exact), 0.5);
}

TEST(BlockVertical, unequal_yields_on_two_pulses)
{
    const auto ground = [](double t) {
        return t < 1.0 ? 5.0 * (1.0 - std::abs(2.0 * t - 1.0)) : -5.0 * (1.0 - std::abs(2.0 * t - 3.0));
    };
    const double exact = exact::slip_under_triangle(5.0, 0.5, 3.0) - exact::slip_under_triangle(5.0, 0.5, 4.0);
    for (const int n : {2, 6, 20}) {
        const SlideResult result = slide(sampled(ground, 1.0 / n, 2 * n), block_with_yields(3.0, 4.0));
        EXPECT_LT(relative(result.slip, exact), 1e-12);
        EXPECT_LT(relative(result.upstream_slip, exact::slip_under_triangle(5.0, 0.5, 4.0)), 1e-12);
        EXPECT_LT(relative(result.max_slip, exact::slip_under_triangle(5.0, 0.5, 3.0)), 1e-12);
        EXPECT_EQ(result.phases, 2);
    }
}

// Full tensor, inclined base, vertical motion that opens the base, against small steps of the x, y equation. The steps
// are first order in the events; 200 per sample leave 1e-4 (halving them halves the difference), far below what any
// wrong sign or term makes.
TEST(BlockVertical, everything_at_once_against_small_steps)
{
    GroundMotion motion = wild_motion(7.0, 0.01, 1000);
    motion.accel_v = sampled([](double t) { return 9.5 * std::sin(13.0 * t); }, 0.01, 1000).accel_h;
    for (const double inclination : {0.0, 0.15, -0.1}) {
        RigidBlock block;
        block.mass = 3.0;
        block.added_mass = {1.2, -0.4, 0.3};
        block.horizontal_force = 4.0;
        block.vertical_force = 2.0;
        block.uplift = 9.0;
        block.cohesion_force = 0.5;
        block.friction = 0.55;
        block.base_inclination = inclination;
        SlideOptions options;
        options.sliding.run_out_max = 0.0;
        const SlideResult result = slide(motion, block, options);
        EXPECT_GT(result.lift_offs, 3);
        EXPECT_NEAR(result.slip, slip_by_small_steps(motion, block, 200),
                    1e-3 * (result.downstream_slip + result.upstream_slip))
            << inclination;
    }
}

TEST(BlockVertical, history_at_the_samples)
{
    GroundMotion motion = sampled([](double t) { return 5.0 * (1.0 - t); }, [](double t) { return -4.0 * t; }, 0.1, 10);
    SlideOptions options;
    options.history = HistoryOutput::samples;
    const SlideResult result = slide(motion, friction_block(0.3), options);
    const SlideHistory& h = result.history;
    ASSERT_GE(h.time.size(), 11u);
    EXPECT_EQ(h.slip.front(), 0.0);
    EXPECT_EQ(h.slip.back(), result.slip);
    EXPECT_NEAR(h.yield[5], 0.3 * (10.0 - 2.0), 1e-14);
    EXPECT_NEAR(h.normal_force[5], 8.0, 1e-14);
    const double t = 0.5; // s'' = 5 (1 - t) - 0.3 (10 - 4 t) = 2 - 3.8 t
    EXPECT_NEAR(h.slip_rate[5], 2.0 * t - 1.9 * t * t, 1e-14);
    EXPECT_NEAR(h.slip[5], t * t - 1.9 / 3.0 * t * t * t, 1e-14);
}

TEST(BlockVertical, static_sliding_is_told)
{
    RigidBlock block = friction_block(0.3);
    block.horizontal_force = 4.0;
    const SlideResult result = slide(sampled([](double) { return 0.0; }, 0.1, 10), block);
    EXPECT_EQ(result.status, Status::static_failure);
    EXPECT_LT(relative(result.slip, 0.5), 1e-13); // s'' = 1 for the record's 1 s, no run-out
    ASSERT_FALSE(result.notes.empty());
    EXPECT_NE(text_of(result.notes.front()).find("0.4"), std::string::npos) << text_of(result.notes.front());
    EXPECT_NEAR(critical_friction(block), 0.4, 1e-15);
}
