// Seepage below a dam against conformal maps (exact/seepage.hpp), conservation, symmetry, and the reference scene.
#include "core/input_error.hpp"
#include "fe2d/mesh/build_mesh.hpp"
#include "fe2d/seepage/seepage.hpp"
#include "fe_scenes.hpp"
#include "verification/exact/seepage.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace {

using namespace damslip;
using exact::SeepageUnderBase;

/// A base of 10 m at the heel, reservoir 10 m, on a box of the given size; no curtain.
Scene flat_base(double width, double depth)
{
    Scene scene;
    scene.file = "test.toml";
    scene.section.polygon = {{0, 0}, {10, 0}, {0, 12}};
    scene.dam = {2400.0, 25e9, 0.2};
    scene.foundation = Foundation{
        .material = {0.0, 30e9, 0.2}, .mass = RockMass::massless, .width = width, .depth = depth, .permeability = 2e-5};
    scene.reservoir = Reservoir{.level = 10.0};
    return scene;
}

/// A curtain thin and tight enough to be the sheet pile of the closed solution.
Scene with_pile(Scene scene, double distance, double depth)
{
    Curtain curtain;
    curtain.distance = distance;
    curtain.depth = depth;
    curtain.thickness = 0.02;
    curtain.permeability = 1e-13;
    scene.curtain = curtain;
    return scene;
}

fe2d::SeepageResult solve(const Scene& scene, const fe2d::SeepageMeshOptions& options = {})
{
    auto result = fe2d::solve_seepage(scene, scene_uplift_state(scene), options);
    EXPECT_TRUE(result.field.solver.ok()) << text_of(result.field.solver.note());
    return result;
}

double pressure_at(const fe2d::SeepageResult& result, double distance)
{
    for (std::size_t i = 1; i < result.profile.points.size(); ++i) {
        const auto &a = result.profile.points[i - 1], &b = result.profile.points[i];
        if (distance <= b.distance)
            return a.pressure + (b.pressure - a.pressure) * (distance - a.distance) / (b.distance - a.distance);
    }
    return result.profile.points.back().pressure;
}

constexpr double heel_pressure = 98100.0; ///< γ_w h of flat_base [Pa]

// Layer as deep as the base is long; the box ends 30 m = 3T beyond it, where e^{-3π} = 8e-5 of the flow is left. H ~ √r
// at heel and toe: bilinear elements of size h err by about 0.05 √(h/B) there, 2.4e-3 at h = B/450.
TEST(FeSeepage, flat_base_on_a_finite_layer)
{
    const Scene scene = flat_base(70.0, 10.0);
    const SeepageUnderBase exact{5.0, 5.0, 0.0, 10.0};
    const auto result = solve(scene);
    for (const auto& p : result.profile.points)
        ASSERT_NEAR(p.pressure / heel_pressure, exact.head(p.distance - 5.0, SeepageUnderBase::Side::upstream), 2.5e-3);
    EXPECT_NEAR(pressure_at(result, 2.5) / heel_pressure, exact.head(-2.5, SeepageUnderBase::Side::upstream), 4e-4);
    EXPECT_NEAR(result.uplift, 0.5 * heel_pressure * 10.0, 1e-9 * result.uplift); // symmetry
    EXPECT_NEAR(result.inflow, 2e-5 * 10.0 * exact.discharge(), 1e-3 * result.inflow);
    const auto coarse = solve(scene, {.finest = 1.0 / 100.0});
    EXPECT_LT(std::abs(result.inflow - 2e-4 * exact.discharge()),
              0.4 * std::abs(coarse.inflow - 2e-4 * exact.discharge()));
}

// H = arccos(2x/B - 1)/π: the layer 20 base lengths deep differs from the half plane by what the two closed solutions
// say.
TEST(FeSeepage, flat_base_on_a_deep_layer_follows_the_arccosine)
{
    const Scene scene = flat_base(1200.0, 200.0);
    const SeepageUnderBase exact{5.0, 5.0, 0.0, 200.0};
    const auto result = solve(scene);
    for (const auto& p : result.profile.points) {
        const double x = p.distance - 5.0, deep = std::acos(2.0 * p.distance / 10.0 - 1.0) / std::numbers::pi;
        const double finite = exact.head(x, SeepageUnderBase::Side::upstream);
        ASSERT_NEAR(exact.head_deep(x, SeepageUnderBase::Side::upstream), deep,
                    1e-7); // arccos loses half its digits at 1
        ASSERT_LT(std::abs(finite - deep), 1e-3);
        ASSERT_NEAR(p.pressure / heel_pressure, deep, 2.5e-3 + std::abs(finite - deep));
    }
}

// The two closed solutions against each other: no pile, any split of the base; and a pile in a very deep layer.
TEST(FeSeepage, closed_solutions_agree_at_their_limits)
{
    using Side = SeepageUnderBase::Side;
    const SeepageUnderBase whole{4.0, 6.0, 0.0, 8.0}, other{1.0, 9.0, 0.0, 8.0};
    EXPECT_NEAR(whole.discharge(), other.discharge(), 1e-12); // without pile the split of the base means nothing
    EXPECT_NEAR(whole.head(1.0, Side::upstream), other.head(4.0, Side::upstream), 1e-12);
    const SeepageUnderBase centred{5.0, 5.0, 0.0, 8.0};
    EXPECT_NEAR(centred.head(0.0, Side::upstream), 0.5, 1e-14);
    const SeepageUnderBase deep{3.0, 7.0, 4.0, 1e5};
    for (double x : {-3.0, -1.0, 1.0, 4.0, 7.0})
        EXPECT_NEAR(deep.head(x, Side::upstream), deep.head_deep(x, Side::upstream), 1e-6);
    EXPECT_NEAR(deep.head(0.0, Side::upstream), deep.head_deep(0.0, Side::upstream), 1e-6);
    EXPECT_NEAR(deep.head(0.0, Side::downstream), deep.head_deep(0.0, Side::downstream), 1e-6);
    // Thin layer: resistance B/T + (2 ln 4)/π of the ends (0.88 T), Harr (1962); next term of the order of e^{-πB/T} =
    // 4e-6.
    const SeepageUnderBase thin{20.0, 20.0, 0.0, 10.0};
    EXPECT_NEAR(1.0 / thin.discharge(), 4.0 + 4.0 * std::log(2.0) / std::numbers::pi, 1e-5);
}

// Pile 4 m deep, 3 m from the heel, layer 10 m. The curtain has 0.02 m for the pile's none, which shifts its foot by
// about that.
TEST(FeSeepage, sheet_pile_against_the_conformal_map)
{
    const Scene scene = with_pile(flat_base(70.0, 10.0), 3.0, 4.0);
    const SeepageUnderBase exact{3.0, 7.0, 4.0, 10.0};
    const auto result = solve(scene);
    EXPECT_NEAR(result.uplift / (heel_pressure * 10.0), exact.mean_head(), 1e-3 * exact.mean_head());
    EXPECT_NEAR(*result.pressure_before_curtain / heel_pressure, exact.head(0.0, SeepageUnderBase::Side::upstream),
                3e-3);
    EXPECT_NEAR(*result.pressure_behind_curtain / heel_pressure, exact.head(0.0, SeepageUnderBase::Side::downstream),
                3e-3);
    EXPECT_NEAR(result.inflow, 2e-4 * exact.discharge(), 3e-3 * result.inflow);
    EXPECT_LT(std::abs(result.flow_through_curtain), 1e-5 * result.inflow);
    EXPECT_NEAR(result.flow_under_curtain, result.inflow, 1e-5 * result.inflow);
}

// The profile of an independent flow solution of the reference scene: its curtain is a sheet pile 7 m from the heel.
// Printed to three digits; both solutions within 2e-3.
TEST(FeSeepage, reference_scene_with_a_thin_curtain)
{
    Scene scene = with_pile(fe2d::test::reference_dam_on_rock(), 7.0, 30.0);
    scene.reservoir = Reservoir{.level = 62.5};
    const auto result = solve(scene);
    const double heel = 9810.0 * 62.5;
    const Point expected[] = {{2, .957}, {4, .944}, {6, .938}, {10, .314}, {20, .289}, {30, .233}, {40, .137}};
    for (const Point& p : expected) EXPECT_NEAR(pressure_at(result, p.x) / heel, p.y, 2e-3) << p.x;
    EXPECT_NEAR(*result.pressure_before_curtain / heel, 0.938, 2e-3);
    EXPECT_NEAR(*result.pressure_behind_curtain / heel, 0.315, 2e-3);
    EXPECT_NEAR(result.uplift, 9.585e6, 0.01 * 9.585e6); // closed solution, exact/seepage.hpp
}

// The curtain as it is, 1 m thick with 1e-8 m/s: 0.94 before it, about 0.32 behind (0.30: its thickness adds to the way
// round its foot), 9.6 MN/m. Through it goes about k Δh/t over its depth: 1e-8 · 0.2...0.63 · 62.5 · 30 = 4e-6...1.2e-5
// m²/s.
TEST(FeSeepage, reference_scene)
{
    Scene scene = fe2d::test::reference_dam_on_rock();
    scene.reservoir = Reservoir{.level = 62.5};
    const auto result = solve(scene);
    const double heel = 9810.0 * 62.5;
    EXPECT_NEAR(*result.pressure_before_curtain / heel, 0.94, 5e-3);
    EXPECT_NEAR(*result.pressure_behind_curtain / heel, 0.31, 1e-2);
    EXPECT_NEAR(result.uplift, 9.6e6, 0.05e6);
    EXPECT_GT(result.flow_through_curtain, 4e-6);
    EXPECT_LT(result.flow_through_curtain, 1.2e-5);
    const auto points = fe2d::uplift_points(result, scene, scene_uplift_state(scene));
    EXPECT_EQ(points.front(), (Point{0.0, 1.0}));
    EXPECT_EQ(points.back(), (Point{45.0, 0.0}));
}

TEST(FeSeepage, what_flows_in_flows_out)
{
    Scene scene = fe2d::test::reference_dam_on_rock();
    scene.reservoir = Reservoir{.level = 62.5};
    scene.tailwater = Tailwater{.level = 5.0};
    scene.drains.emplace();
    scene.drains->distance = 12.0;
    scene.drains->efficiency = 0.67;
    const auto result = solve(scene);
    EXPECT_NEAR(result.inflow, result.outflow + result.drain_flow, 1e-11 * result.inflow);
    EXPECT_NEAR(result.flow_through_curtain + result.flow_under_curtain, result.inflow, 1e-11 * result.inflow);
    EXPECT_GT(result.drain_flow, 0.0);
    // H3 = 5 + 0.33·57.5·33/45 at the drains
    EXPECT_NEAR(pressure_at(result, 12.0), 9810.0 * (5.0 + 0.33 * 57.5 * 33.0 / 45.0), 1.0);
    auto state = scene_uplift_state(scene);
    state.drains = DrainState::ineffective;
    const auto without = fe2d::solve_seepage(scene, state);
    EXPECT_GT(without.uplift, 1.05 * result.uplift);
    EXPECT_EQ(without.drain_flow, 0.0);
}

// A ruptured curtain is rock: with the curtain's elements in the mesh or not, the field is that of the flat base. One
// that the scene says to be ruptured, or as permeable as the rock, is not meshed: the same bits as without it.
TEST(FeSeepage, ruptured_curtain_is_no_curtain)
{
    Scene scene = with_pile(flat_base(70.0, 10.0), 3.0, 4.0);
    auto state = scene_uplift_state(scene);
    state.curtain = CurtainState::damaged;
    const auto ruptured = fe2d::solve_seepage(scene, state);
    const SeepageUnderBase exact{5.0, 5.0, 0.0, 10.0};
    EXPECT_NEAR(ruptured.uplift, 0.5 * heel_pressure * 10.0, 1e-3 * ruptured.uplift);
    EXPECT_NEAR(pressure_at(ruptured, 3.0) / heel_pressure, exact.head(-2.0, SeepageUnderBase::Side::upstream), 1e-3);
    const double without = solve(flat_base(70.0, 10.0)).uplift;
    EXPECT_NEAR(ruptured.uplift, without, 1e-3 * without);
    scene.curtain->intact = false;
    EXPECT_EQ(solve(scene).uplift, without);
    scene.curtain->intact = true;
    EXPECT_NE(solve(scene).uplift, without);
    scene.curtain->permeability = scene.foundation->permeability;
    EXPECT_EQ(solve(scene).uplift, without);
}

// Equal levels on both sides of an inclined base: still water, p = γ_w (h - y) on every node, no flow.
TEST(FeSeepage, still_water_is_hydrostatic)
{
    Scene scene = flat_base(70.0, 12.0);
    scene.section.polygon = {{0, 0}, {10, -1.5}, {0, 12}};
    scene.tailwater = Tailwater{.level = 10.0};
    const auto result = solve(scene);
    for (const auto& p : result.profile.points) {
        const double y = -1.5 * p.distance / std::hypot(10.0, 1.5);
        ASSERT_NEAR(p.pressure, 9810.0 * (10.0 - y), 1e-9 * 98100.0);
    }
    EXPECT_LT(std::abs(result.inflow), 1e-15);
}

// Water higher downstream: the mirrored problem. Dry on both sides: no pressure.
TEST(FeSeepage, reversed_flow_and_no_water)
{
    Scene scene = flat_base(70.0, 10.0);
    const auto forward = solve(scene);
    scene.reservoir.reset();
    scene.tailwater = Tailwater{.level = 10.0};
    const auto reversed = solve(scene);
    EXPECT_NEAR(reversed.inflow, -forward.inflow, 1e-10 * forward.inflow);
    for (double x : {0.5, 2.0, 5.0, 9.0})
        EXPECT_NEAR(pressure_at(reversed, 10.0 - x), pressure_at(forward, x), 1e-6 * heel_pressure);
    EXPECT_TRUE(fe2d::uplift_points(reversed, scene, scene_uplift_state(scene)).empty());
    scene.tailwater.reset();
    EXPECT_EQ(solve(scene).uplift, 0.0);
}

// Scaling by 2: uplift by 4 (pressure and base doubled), flow by 2 (head doubled, the ratio of lengths the same).
TEST(FeSeepage, default_box_scales_with_the_base)
{
    Scene scene = fe2d::test::reference_dam_on_rock();
    scene.foundation.reset();
    scene.reservoir = Reservoir{.level = 62.5};
    const auto single = solve(scene);
    ASSERT_FALSE(single.notes.empty());
    EXPECT_NE(text_of(single.notes.back()).find("300 m x 100 m"), std::string::npos);
    Scene with_box = fe2d::test::reference_dam_on_rock();
    with_box.reservoir = Reservoir{.level = 62.5};
    EXPECT_NEAR(solve(with_box).uplift, single.uplift, 1e-9 * single.uplift);
    for (Point& p : scene.section.polygon) p = {2.0 * p.x, 2.0 * p.y};
    scene.curtain->distance *= 2.0;
    scene.curtain->depth *= 2.0;
    scene.curtain->thickness *= 2.0;
    scene.reservoir->level *= 2.0;
    const auto twice = solve(scene);
    EXPECT_NEAR(twice.uplift, 4.0 * single.uplift, 1e-9 * twice.uplift);
    EXPECT_NEAR(twice.inflow, 2.0 * single.inflow, 1e-9 * twice.inflow);
}

// The FE model's own mesh (0.75 m on the base) gives the uplift of the fine one within 1 %.
TEST(FeSeepage, on_the_mesh_of_the_whole_model)
{
    Scene scene = fe2d::test::reference_dam_on_rock();
    scene.reservoir = Reservoir{.level = 62.5};
    const auto fine = solve(scene);
    const auto coarse = fe2d::solve_seepage_on(fe2d::build_mesh(scene), scene, scene_uplift_state(scene));
    ASSERT_TRUE(coarse.field.solver.ok());
    EXPECT_NEAR(coarse.uplift, fine.uplift, 0.01 * fine.uplift);
    EXPECT_TRUE(std::isnan(coarse.field.head[coarse.mesh.contact.dam_nodes[3]])); // the dam holds no water
}

// Relief wells of no depth relieve nothing but their own point; deeper ones take more water and leave less uplift.
TEST(FeSeepage, deeper_drains_take_more_water)
{
    Scene scene = flat_base(70.0, 20.0);
    scene.drains.emplace();
    scene.drains->distance = 3.0;
    EXPECT_DOUBLE_EQ(fe2d::drain_line(scene, scene_uplift_state(scene))->depth, 2.5); // a quarter of the base
    const auto quarter = solve(scene);
    scene.drains->depth = 2.5;
    EXPECT_EQ(solve(scene).uplift, quarter.uplift);
    scene.drains->depth = 5.0;
    const auto deeper = solve(scene);
    EXPECT_GT(deeper.drain_flow, 1.05 * quarter.drain_flow);
    EXPECT_LT(deeper.uplift, quarter.uplift);
    scene.curtain = with_pile(scene, 1.0, 4.0).curtain;
    scene.drains->depth.reset();
    EXPECT_DOUBLE_EQ(fe2d::drain_line(scene, scene_uplift_state(scene))->depth, 2.0); // half the curtain
}

// Behind a curtain the head may be lower than the drains' own: a line that would give more than it takes does nothing, so that it
// leaves the uplift without it (1464 kN/m; held at their head they raised it to 3682 with E = 0), and working ones what they left before.
TEST(FeSeepage, drains_give_no_water)
{
    Scene scene;
    scene.file = "test.toml";
    scene.section.polygon = {{0, 0}, {24, 0}, {4, 30}, {0, 30}};
    scene.dam = {2400.0, 25e9, 0.2};
    scene.reservoir = Reservoir{.level = 27.0};
    scene.curtain.emplace().distance = 2.0;
    const double without = solve(scene).uplift;
    scene.drains.emplace().distance = 4.0;
    double last = without * (1.0 + 1e-3); // another mesh
    for (const double efficiency : {0.0, 0.5, 0.67, 0.9}) {
        scene.drains->efficiency = efficiency;
        const auto with = solve(scene);
        EXPECT_LE(with.uplift, last) << efficiency;
        EXPECT_GE(with.drain_flow, -1e-9 * with.inflow) << efficiency;
        last = with.uplift * (1.0 + 1e-9);
    }
    EXPECT_NEAR(last, 1077e3, 1e3);
}

// On a mesh whose rock has fewer nodes below the base than the dam has, drains are the rock's nodes nearest to their line.
TEST(FeSeepage, drains_below_sides_that_do_not_match)
{
    Scene scene = flat_base(70.0, 20.0);
    scene.drains.emplace();
    scene.drains->distance = 8.0;
    scene.drains->depth = 5.0;
    scene.mesh.size = 0.5;
    scene.mesh.contact_size = 0.25;
    const auto flow = [&] {
        return fe2d::solve_seepage_on(fe2d::build_mesh(scene), scene, scene_uplift_state(scene)).drain_flow;
    };
    const double matching = flow();
    scene.mesh.rock_contact_size = 0.5; // a node at 8 m, too
    EXPECT_NEAR(flow(), matching, 0.1 * matching); // elements twice as long along the base
}

TEST(FeSeepage, what_does_not_fit_is_refused)
{
    Scene scene = flat_base(70.0, 10.0);
    const auto refused = [](const Scene& s, const char* words) {
        try {
            (void)fe2d::solve_seepage(s, scene_uplift_state(s));
            ADD_FAILURE() << words;
        } catch (const InputError& error) {
            EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
        }
    };
    refused(with_pile(scene, 9.99, 4.0), "curtain: 9.99 to 10.01 m from the heel is not below the base");
    refused(with_pile(scene, 3.0, 10.0), "depth 10 m does not end inside the foundation");
    scene.foundation->width = 11.0;
    refused(scene, "is too small for seepage");
}

} // namespace
