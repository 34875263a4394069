// Static loads on the faces of the section, each against a hand calculation.
#include "sliding/loads/static_loads.hpp"

#include "scene/section.hpp"
#include "verification/exact/reference_scene.hpp"

#include <gtest/gtest.h>

namespace damslip::sliding {
namespace {

constexpr double round_off = 1e-14; // a handful of products of doubles

void expect_near_relative(double computed, double expected, double tolerance)
{
    EXPECT_NEAR(computed, expected, tolerance * std::abs(expected) + 1e-300);
}

const Load* find(const std::vector<Load>& loads, LoadKind kind)
{
    for (const Load& load : loads)
        if (load.kind == kind) return &load;
    return nullptr;
}

Scene with_reservoir(Scene scene, double level)
{
    scene.reservoir = Reservoir{};
    scene.reservoir->level = level;
    return scene;
}

TEST(Loads, MomentIsCounterClockwiseAboutTheHeel)
{
    EXPECT_DOUBLE_EQ(force_at({0.0, 2.0}, 3.0, 0.0).moment,
                     -6.0); // downstream push above the heel tips towards the toe
    EXPECT_DOUBLE_EQ(force_at({5.0, 0.0}, 0.0, 2.0).moment, 10.0); // lift downstream of the heel turns back
    const Force f = force_at({5.0, 1.0}, 2.0, -3.0);
    EXPECT_DOUBLE_EQ(moment_about(f, {5.0, 1.0}), 0.0);
}

// Reference dam: area by hand 12 x 62.5 + 33 x 51.5 / 2 = 1599.75 m^2.
TEST(Loads, ReferenceDamWeightAndThrust)
{
    const Scene scene = exact::reference_scene(exact::ReferenceUplift::none, 0.77);
    const auto loads = static_loads(scene, scene_load_case(scene));
    ASSERT_EQ(loads.size(), 2u);
    const double weight = 1599.75 * 2500.0 * 9.81;
    expect_near_relative(loads[0].force.total().y, -weight, round_off);
    // Static moment of the area about the heel line: 12^2/2 x 62.5 + 849.75 x (12 + 33/3) m^3.
    expect_near_relative(loads[0].force.total().moment, -(4500.0 + 849.75 * 23.0) * 2500.0 * 9.81, round_off);
    const Force water = loads[1].force.total();
    expect_near_relative(water.x, 0.5 * 9810.0 * 62.5 * 62.5, round_off);
    EXPECT_EQ(water.y, 0.0);
    expect_near_relative(water.moment, -9810.0 * 62.5 * 62.5 * 62.5 / 6.0, round_off); // acts at h/3
}

// Kinked upstream face: batter 4 m over the lower 20 m, then vertical to 30 m; water at 25 m. Vertical water: a
// trapezoid of 5 m (at the kink) and 25 m depth over 4 m = 60 m^2, its centroid 4 (25 + 2 x 5)/(3 (25 + 5)) from the
// heel.
TEST(Loads, KinkedUpstreamFaceCarriesItsWaterWedge)
{
    const Scene scene = with_reservoir(exact::bare_scene({{0, 0}, {30, 0}, {10, 30}, {4, 30}, {4, 20}}), 25.0);
    const auto loads = static_loads(scene, scene_load_case(scene));
    const Load* water = find(loads, LoadKind::reservoir);
    ASSERT_NE(water, nullptr);
    expect_near_relative(water->force.horizontal.x, 0.5 * 9810.0 * 625.0, round_off);
    expect_near_relative(water->force.horizontal.moment, -0.5 * 9810.0 * 625.0 * 25.0 / 3.0, round_off);
    expect_near_relative(water->force.vertical.y, -60.0 * 9810.0, round_off);
    expect_near_relative(water->force.vertical.moment, -60.0 * 9810.0 * 4.0 * 35.0 / 90.0, 2 * round_off);
}

// An overhanging upstream face (leans over the water) is pushed up.
TEST(Loads, OverhangIsPushedUp)
{
    const Scene scene = with_reservoir(exact::bare_scene({{0, 0}, {20, 0}, {20, 10}, {-2, 10}}), 10.0);
    const auto loads = static_loads(scene, scene_load_case(scene));
    expect_near_relative(find(loads, LoadKind::reservoir)->force.vertical.y, 0.5 * 2.0 * 10.0 * 9810.0, round_off);
}

// Triangle of slope 0.8: tailwater 10 m deep stands on the face as a wedge of 8 m x 10 m / 2, centroid 8/3 m from the
// toe.
TEST(Loads, TailwaterPushesUpstreamAndRestsOnTheSlope)
{
    Scene scene = exact::bare_scene(exact::triangle(40.0, 50.0));
    scene.tailwater = Tailwater{10.0};
    const auto loads = static_loads(scene, scene_load_case(scene));
    const Load* water = find(loads, LoadKind::tailwater);
    ASSERT_NE(water, nullptr);
    EXPECT_EQ(find(loads, LoadKind::reservoir), nullptr);
    expect_near_relative(water->force.horizontal.x, -0.5 * 9810.0 * 100.0, round_off);
    expect_near_relative(water->force.horizontal.moment, 0.5 * 9810.0 * 100.0 * 10.0 / 3.0, round_off);
    expect_near_relative(water->force.vertical.y, -40.0 * 9810.0, round_off);
    expect_near_relative(water->force.vertical.moment, -40.0 * 9810.0 * (40.0 - 8.0 / 3.0), 4 * round_off);
}

// 3 m over a 12 m crest: the upstream face carries the trapezoid between 3 and 65.5 m, the crest 36 m^2 of water.
TEST(Loads, OvertoppingLoadsFaceAndCrest)
{
    Scene scene = exact::reference_scene(exact::ReferenceUplift::none, 0.77);
    scene.reservoir->level = 65.5;
    const auto loads = static_loads(scene, scene_load_case(scene));
    expect_near_relative(find(loads, LoadKind::reservoir)->force.total().x, 0.5 * 9810.0 * (65.5 * 65.5 - 9.0),
                         round_off);
    const Force crest = find(loads, LoadKind::crest_water)->force.total();
    EXPECT_EQ(crest.x, 0.0);
    expect_near_relative(crest.y, -36.0 * 9810.0, round_off);
    expect_near_relative(crest.moment, -36.0 * 9810.0 * 6.0, round_off);
}

// With a toe below the heel, no tailwater is not the same as tailwater at level 0.
TEST(Loads, DryToeBelowTheHeelCarriesNoWater)
{
    Scene scene = exact::bare_scene({{0, 0}, {20, -4}, {20, 10}, {0, 10}});
    EXPECT_EQ(find(static_loads(scene, scene_load_case(scene)), LoadKind::tailwater), nullptr);
    scene.tailwater = Tailwater{0.0};
    const auto loads = static_loads(scene, scene_load_case(scene));
    expect_near_relative(find(loads, LoadKind::tailwater)->force.total().x, -0.5 * 9810.0 * 16.0, round_off);
}

TEST(Loads, SiltIceAndPointForces)
{
    Scene scene = with_reservoir(exact::bare_scene({{0, 0}, {30, 0}, {10, 30}, {3, 30}}), 28.0);
    scene.silt = Silt{12.0, 8000.0, 0.4};
    scene.ice = Ice{150e3, 28.0};
    scene.forces = {{"anchor", {5.0, 30.0}, 20e3, -500e3}};
    LoadCase load_case = scene_load_case(scene);
    auto loads = static_loads(scene, load_case);
    // Horizontal thrust only, on the vertical projection, whatever the batter: 1/2 K_s gamma' h^2 at h/3.
    const Force silt = find(loads, LoadKind::silt)->force.total();
    expect_near_relative(silt.x, 0.5 * 0.4 * 8000.0 * 144.0, round_off);
    EXPECT_EQ(silt.y, 0.0);
    expect_near_relative(silt.moment, -silt.x * 4.0, round_off);
    EXPECT_EQ(find(loads, LoadKind::ice)->force.total(), force_at({0.0, 28.0}, 150e3, 0.0));
    EXPECT_EQ(find(loads, LoadKind::point_force)->force.total().moment, 5.0 * -500e3 - 30.0 * 20e3);

    load_case.reservoir_level = 25.0; // ice at the surface follows it
    load_case.ice_factor = 2.0;
    EXPECT_EQ(find(static_loads(scene, load_case), LoadKind::ice)->force.total(), force_at({0.0, 25.0}, 300e3, 0.0));
    load_case.ice = IceLoad::off;
    EXPECT_EQ(find(static_loads(scene, load_case), LoadKind::ice), nullptr);
}

} // namespace
} // namespace damslip::sliding
