// Yield accelerations of the rigid block: closed forms of one vertical face, the 2 x 2 added mass, limits.
#include "block_motions.hpp"
#include "core/input_error.hpp"
#include "sliding/block/rigid_block.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace damslip::sliding;
using namespace damslip::test;

namespace {

/// A block with every term of the closed forms different from zero and of the same size.
RigidBlock full_block(double inclination)
{
    RigidBlock block;
    block.mass = 4.0e6;
    block.added_mass.xx = 2.3e6;
    block.vertical_force = 1.5e6;
    block.horizontal_force = 9.0e6;
    block.uplift = 7.0e6;
    block.cohesion_force = 3.0e6;
    block.friction = 0.8;
    block.base_inclination = inclination;
    return block;
}

/// The formulas of the vertical face, written out and not through any vector.
struct ClosedForm {
    double yield_down, factor_down, yield_up, factor_up;
};

ClosedForm closed_form(const RigidBlock& b, double a_v)
{
    const double c = std::cos(b.base_inclination), s = std::sin(b.base_inclination), mu = b.friction;
    const double M_w = b.added_mass.xx, M = b.mass + M_w, V = b.mass * (b.gravity + a_v) + b.vertical_force,
                 W = b.horizontal_force;
    const double strength = b.cohesion_force + mu * (V * c - b.uplift - W * s);
    const double k = c + mu * s, k_up = c - mu * s;
    return {(strength - W * c - V * s) / (M * k), M * k / (b.mass + M_w * k * c),
            (strength + W * c + V * s) / (M * k_up), M * k_up / (b.mass + M_w * k_up * c)};
}

} // namespace

// Closed solution, so only round-off counts: a dozen operations on terms that do not cancel by more than a factor of
// ten.
TEST(BlockYield, reduces_to_the_closed_forms_of_a_vertical_face)
{
    for (const double inclination : {0.0, 0.2, -0.15, 0.7})
        for (const double a_v : {0.0, 2.5, -4.0}) {
            const RigidBlock block = full_block(inclination);
            const ClosedForm exact = closed_form(block, a_v);
            EXPECT_LT(relative(yield_downstream(block).law.at(a_v), exact.yield_down), 1e-14)
                << inclination << " " << a_v;
            EXPECT_LT(relative(yield_downstream(block).factor, exact.factor_down), 1e-14);
            EXPECT_LT(relative(yield_upstream(block).law.at(a_v), exact.yield_up), 1e-14);
            EXPECT_LT(relative(yield_upstream(block).factor, exact.factor_up), 1e-14);
        }
}

// STYLE of the examples: 62.5 m triangular dam, (0.77 * 34.488281e6 - 19.160156e6) / (3.515625e6 + 2.278646e6)
// = 1.27640 m/s^2, eq. (4-3).
TEST(BlockYield, triangular_dam_by_hand)
{
    RigidBlock dam;
    dam.mass = 0.5 * 45.0 * 62.5 * 2500.0;
    dam.added_mass.xx = 7.0 / 12.0 * 1000.0 * 62.5 * 62.5;
    dam.horizontal_force = 0.5 * 1000.0 * 9.81 * 62.5 * 62.5;
    dam.friction = 0.77;
    EXPECT_NEAR(yield_acceleration(dam), 1.27640, 5e-6);
    EXPECT_EQ(yield_downstream(dam).factor, 1.0);
}

// Newmark (1965): a dry block on a plane dipping theta < phi has a_y = g tan(phi - theta) for a horizontal push and
// slides with (a_h - a_y) cos(phi - theta)/cos(phi) along the plane.
TEST(BlockYield, newmark_inclined_plane)
{
    const double phi = 0.6, theta = 0.25;
    RigidBlock block;
    block.mass = 1234.0;
    block.friction = std::tan(phi);
    block.base_inclination = theta;
    EXPECT_LT(relative(yield_acceleration(block), block.gravity * std::tan(phi - theta)), 1e-14);
    EXPECT_LT(relative(yield_downstream(block).factor, std::cos(phi - theta) / std::cos(phi)), 1e-14);
    EXPECT_LT(relative(yield_upstream(block).law.constant, block.gravity * std::tan(phi + theta)), 1e-14);
    EXPECT_LT(relative(yield_upstream(block).factor, std::cos(phi + theta) / std::cos(phi)), 1e-14);
}

// The tensor solution must satisfy both components of (m I + M^w)(a_g + s'' t) = F + (U + N') n - R t, written in x and
// y, not in t and n.
TEST(BlockYield, tensor_solution_satisfies_the_equation_of_motion)
{
    RigidBlock b = full_block(0.3);
    b.added_mass = {2.0e6, -0.7e6, 0.6e6};
    const double c = std::cos(0.3), s = std::sin(0.3);
    for (const SlipDirection direction : {SlipDirection::downstream, SlipDirection::upstream})
        for (const double a_v : {0.0, -3.0}) {
            const BaseEquations e = base_equations(b);
            const double a_h = sign(direction) * 12.0;
            const double ss =
                sign(direction) * excess_drive(e, b, direction).at(a_h, a_v) / sliding_mass(e, b.friction, direction);
            const double N = e.normal.at(a_h, a_v) + e.mass_tn * ss;
            const double R = sign(direction) * (b.cohesion_force + b.friction * N);
            const double ax = -a_h + ss * c, ay = a_v - ss * s;
            const double left_x = (b.mass + b.added_mass.xx) * ax + b.added_mass.xy * ay;
            const double left_y = b.added_mass.xy * ax + (b.mass + b.added_mass.yy) * ay;
            const double right_x = b.horizontal_force + (b.uplift + N) * s - R * c;
            const double right_y = -(b.mass * b.gravity + b.vertical_force) + (b.uplift + N) * c + R * s;
            EXPECT_NEAR(left_x / right_x, 1.0, 1e-13);
            EXPECT_NEAR(left_y / right_y, 1.0, 1e-13);
            const Yield yield = direction == SlipDirection::downstream ? yield_downstream(b) : yield_upstream(b);
            EXPECT_NEAR(yield.factor * (std::abs(a_h) - yield.law.at(a_v)) / std::abs(ss), 1.0, 1e-13);
        }
}

// a_v up presses the block on its base: the yield rises by mu m/(m + M_w) per m/s^2. A flipped sign of a_v fails here.
TEST(BlockYield, vertical_acceleration_up_raises_the_yield)
{
    const RigidBlock block = full_block(0.0);
    EXPECT_NEAR(yield_downstream(block).law.per_a_v, 0.8 * 4.0 / 6.3, 1e-15);
    EXPECT_GT(yield_acceleration(block, 1.0), yield_acceleration(block, 0.0));
}

TEST(BlockYield, negative_yield_is_static_sliding_and_names_the_friction_that_holds)
{
    RigidBlock block = full_block(0.1);
    block.friction = 0.05;
    EXPECT_LT(yield_acceleration(block), 0.0);
    EXPECT_EQ(static_state(block), StaticState::slides_downstream);
    block.friction = critical_friction(block);
    EXPECT_NEAR(yield_acceleration(block), 0.0, 1e-14);
    block.friction *= 1.0 + 1e-12;
    EXPECT_EQ(static_state(block), StaticState::at_rest);
    block.base_inclination = -1.2;
    EXPECT_EQ(static_state(block), StaticState::slides_upstream);
    block.uplift = 1e9;
    EXPECT_EQ(static_state(block), StaticState::lifts_off);
    EXPECT_TRUE(std::isinf(critical_friction(block)));
}

// mu tan(theta) >= 1: a push along the base only presses the block on it, k^- <= 0; no ground acceleration makes it
// slide that way.
TEST(BlockYield, steep_base_has_no_upstream_yield)
{
    RigidBlock block;
    block.mass = 1.0;
    block.friction = 1.5;
    block.base_inclination = 0.8;
    block.cohesion_force = 10.0;
    EXPECT_EQ(yield_upstream(block).law.constant, HUGE_VAL);
    EXPECT_EQ(yield_upstream(block).factor, 0.0);
    EXPECT_TRUE(std::isfinite(yield_acceleration(block)));
    block.base_inclination = std::atan(1.0 / 1.5); // k^- = 0 up to round-off
    EXPECT_EQ(yield_upstream(block).law.constant, HUGE_VAL);
}

TEST(BlockYield, refuses_what_is_no_block)
{
    const auto refused = [](auto change) {
        RigidBlock block = full_block(0.0);
        change(block);
        EXPECT_THROW(check_block(block), damslip::InputError);
    };
    refused([](RigidBlock& b) { b.mass = 0.0; });
    refused([](RigidBlock& b) { b.friction = -0.1; });
    refused([](RigidBlock& b) { b.friction = std::nan(""); });
    refused([](RigidBlock& b) { b.uplift = HUGE_VAL; });
    refused([](RigidBlock& b) { b.base_inclination = 1.6; });
    refused([](RigidBlock& b) { b.added_mass = {1.0, 2.0, 1.0}; });
    // Painleve's jam: m + M_w k cos(theta) < 0 for a steep base that dips upstream.
    refused([](RigidBlock& b) {
        b.base_inclination = -0.9;
        b.friction = 3.0;
        b.added_mass.xx = 5e7;
    });
    EXPECT_NO_THROW(check_block(full_block(0.3)));
}
