// One dam with everything an examiner puts together, by hand: tailwater, drains with a gallery, k_h with Zangar's pressure, k_v.
#include "core/units.hpp"
#include "scene/read.hpp"
#include "sliding/equilibrium/limit_equilibrium.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

namespace damslip {
namespace {

// H 50 m, base 40 m, crest 6 m, neck 8 m, vertical upstream face; 2400 kg/m3, water 46 m and 5 m. Drains 6 m from the heel,
// E = 0.6, gallery at 8 m. mu 0.8, c 200 kPa. k_h = 0.12, k_v = -0.06 (lightens).
const char* const dam = R"([section]
height_m = 50
base_m = 40
crest_m = 6
neck_m = 8
[dam]
density_kg_m3 = 2400
[reservoir]
level_m = 46
model = "added-mass"
[tailwater]
level_m = 5
[added_mass]
formula = "zangar"
[drains]
distance_m = 6
efficiency = 0.6
gallery_level_m = 8
[uplift]
model = "drains"
[contact]
friction = 0.8
cohesion_kPa = 200
[[combination]]
name = "all"
k_h = 0.12
k_v = -0.06
crack = "none"
[[combination]]
name = "partial factors"
k_h = 0.12
k_v = -0.06
friction_divisor = 1.2
cohesion_divisor = 2.7
crack = "none"
[[combination]]
name = "profile"
k_h = 0.12
k_profile_m = [[0, 0], [50, 1.5]]
crack = "none"
)";

TEST(TextbookDam, EverythingTogetherIsTheSumByHand)
{
    const double g = 9.81, gamma = 1000.0 * g;
    // weight: rectangle 6 x 50 and triangle 34 x 42
    const double w1 = 6.0 * 50.0 * 2400.0 * g, w2 = 0.5 * 34.0 * 42.0 * 2400.0 * g;
    const double x1 = 3.0, y1 = 25.0, x2 = 6.0 + 34.0 / 3.0, y2 = 14.0;
    // water: heads 46 and 5 m; on the downstream face its weight, 5 m high and 5 * 34/42 m long, a third from the toe
    const double thrust = 0.5 * gamma * 46.0 * 46.0, back = 0.5 * gamma * 25.0, wide = 5.0 * 34.0 / 42.0;
    const double on_toe = 0.5 * gamma * 5.0 * wide, x_toe = 40.0 - wide / 3.0;
    // drains: H3 = 8 + 0.4 (46 - 8) 34/40
    const double at_drain = 8.0 + 0.4 * 38.0 * 34.0 / 40.0;
    const double u1 = gamma * 6.0 * 0.5 * (46.0 + at_drain), u2 = gamma * 34.0 * 0.5 * (at_drain + 5.0);
    const auto centre = [](double from, double length, double p, double q) { // of a trapezoid
        return from + length * (p + 2.0 * q) / (3.0 * (p + q));
    };
    const double xu1 = centre(0.0, 6.0, 46.0, at_drain), xu2 = centre(6.0, 34.0, at_drain, 5.0);
    // earthquake: a = k 9.80665; inertia up and downstream; Zangar 0.73/2 (2/3 + pi/4) rho h^2 a, its moment 0.73 7/24 rho h^3 a
    const double a = 0.12 * units::standard_gravity, a_v = 0.06 * units::standard_gravity, m = (w1 + w2) / g;
    const double zangar = 0.365 * (2.0 / 3.0 + std::numbers::pi / 4.0) * 1000.0 * 46.0 * 46.0 * a;
    const double zangar_moment = 0.73 * 7.0 / 24.0 * 1000.0 * std::pow(46.0, 3) * a;
    const double lifted = m * a_v;

    const double normal = w1 + w2 + on_toe - u1 - u2 - lifted, shear = thrust - back + m * a + zangar;
    const double xc = (w1 * x1 + w2 * x2) / (w1 + w2), yc = (w1 * y1 + w2 * y2) / (w1 + w2);
    const double about_heel = w1 * x1 + w2 * x2 + on_toe * x_toe - u1 * xu1 - u2 * xu2 - lifted * xc +
                              thrust * 46.0 / 3.0 - back * 5.0 / 3.0 + m * a * yc + zangar_moment;
    const double e = about_heel / normal - 20.0;
    const double toe = normal / 40.0 * (1.0 + 6.0 * e / 40.0), heel = normal / 40.0 * (1.0 - 6.0 * e / 40.0);

    const auto states = sliding::evaluate_combinations(parse_scene(dam, "dam.toml", FileCheck::skip));
    const sliding::Equilibrium& all = states[0];
    EXPECT_NEAR(all.base.effective_normal / normal, 1.0, 1e-12);
    EXPECT_NEAR(all.shear / shear, 1.0, 1e-9);
    EXPECT_NEAR(all.toe_stress / toe, 1.0, 1e-8);
    EXPECT_NEAR(all.heel_stress / heel, 1.0, 1e-8);
    EXPECT_NEAR(all.sliding_factor, (200e3 * 40.0 + 0.8 * normal) / shear, 1e-8);
    const double holds = w1 * (40.0 - x1) + w2 * (40.0 - x2) + on_toe * (40.0 - x_toe) + back * 5.0 / 3.0;
    const double turns =
        thrust * 46.0 / 3.0 + u1 * (40.0 - xu1) + u2 * (40.0 - xu2) + m * a * yc + zangar_moment + lifted * (40.0 - xc);
    EXPECT_NEAR(all.overturning_factor, holds / turns, 1e-8);
    EXPECT_NEAR(states[1].sliding_factor, (200e3 / 2.7 * 40.0 + 0.8 / 1.2 * normal) / shear, 1e-8);

    // 1.5 y/50 of k_h at each height: of the rectangle 0.75, at 2/3 H; of the triangle, 42 m high, the integral of its width
    const double rectangle = 0.75 * w1, triangle = 1.5 / 50.0 * 14.0 * w2; // its centroid is at 14 m
    const double arm = rectangle * 50.0 * 2.0 / 3.0 + 1.5 / 50.0 * w2 * 42.0 * 42.0 / 6.0;
    for (const sliding::Load& load : states[2].loads)
        if (load.kind == sliding::LoadKind::inertia) {
            EXPECT_NEAR(load.force.horizontal.x / ((rectangle + triangle) * a / g), 1.0, 1e-12);
            EXPECT_NEAR(load.force.horizontal.moment / (-arm * a / g), 1.0, 1e-12);
        }
}

// The horizontal rule takes the same push downstream off a battered face and leaves out what it presses down.
TEST(TextbookDam, HorizontalRuleLeavesOutTheVerticalPart)
{
    std::string text = dam;
    text.replace(text.find("neck_m = 8\n"), 11, "neck_m = 8\nupstream_slope = 0.1\nupstream_slope_height_m = 20\n");
    const auto hydrodynamic = [&](const std::string& rule) {
        std::string with = text;
        with.replace(with.find("formula = \"zangar\"\n"), 19,
                     "formula = \"zangar\"\nzangar_table_deg = [[0, 0.7], [90, 0.7]]\ninclined_face = \"" + rule +
                         "\"\n");
        for (const sliding::Load& load :
             sliding::evaluate_combinations(parse_scene(with, "dam.toml", FileCheck::skip)).front().loads)
            if (load.kind == sliding::LoadKind::hydrodynamic) return load.force.total();
        return sliding::Force{};
    };
    const sliding::Force normal = hydrodynamic("normal-component"), horizontal = hydrodynamic("horizontal");
    EXPECT_LT(normal.y, 0.0);
    EXPECT_EQ(horizontal.y, 0.0);
    // k_v along the normal pushes back a little; 0.35 (2/3 + pi/4) rho h^2 a is the horizontal part alone
    const double a = 0.12 * units::standard_gravity;
    EXPECT_NEAR(horizontal.x / (0.35 * (2.0 / 3.0 + std::numbers::pi / 4.0) * 1000.0 * 46.0 * 46.0 * a), 1.0, 1e-9);
}

} // namespace
} // namespace damslip
