// Uplift profiles, their resultants and the cracked base.
#include "sliding/uplift/uplift.hpp"

#include "core/input_error.hpp"
#include "verification/exact/cracked_base.hpp"
#include "verification/exact/reference_scene.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace damslip::sliding {
namespace {

using exact::ReferenceUplift;

Scene drained(double heel_level, double efficiency, std::optional<double> tailwater = {},
              std::optional<double> gallery = {})
{
    Scene scene = exact::bare_scene(exact::triangle(40.0, 50.0));
    scene.reservoir = Reservoir{};
    scene.reservoir->level = heel_level;
    if (tailwater) scene.tailwater = Tailwater{*tailwater};
    scene.uplift.emplace().model = UpliftModel::drains;
    scene.drains = Drains{};
    scene.drains->distance = 8.0;
    scene.drains->efficiency = efficiency;
    scene.drains->gallery_level = gallery;
    return scene;
}

PressureProfile profile_of(const Scene& scene, const Crack& crack = {})
{
    return uplift_profile(scene, scene_uplift_state(scene), crack);
}

TEST(Uplift, ResultantOfATrapezoidWithAJump)
{
    const PressureProfile p{{{0, 6.0}, {2, 4.0}, {2, 1.0}, {6, 1.0}}};
    const UpliftResultant r = resultant(p);
    EXPECT_DOUBLE_EQ(r.force, 10.0 + 4.0);
    EXPECT_DOUBLE_EQ(r.moment_about_heel, 2.0 / 6.0 * (6.0 * 2.0 + 4.0 * 4.0) + 4.0 * 4.0);
    EXPECT_EQ(pressure_at(p, 2.0), 4.0);
    EXPECT_EQ(pressure_at(p, 2.5), 1.0);
    EXPECT_EQ(pressure_at(p, 7.0), 0.0);
    EXPECT_EQ(part(p, 2.0, 6.0).front(), (ProfilePoint{2.0, 1.0}));
}

// p0 = 613125 Pa: linear 22.5 p0, printed curtain 18.5 p0; the SPEC points by the trapezoid rule by hand: 15.439 p0.
TEST(Uplift, ReferenceDam)
{
    const double p0 = 9810.0 * 62.5;
    EXPECT_NEAR(resultant(profile_of(exact::reference_scene(ReferenceUplift::linear, 1.0))).force, 22.5 * p0, 1e-8);
    const auto curtain = profile_of(exact::reference_scene(ReferenceUplift::printed_curtain, 1.0));
    EXPECT_NEAR(resultant(curtain).force, 18.5 * p0, 1e-8);
    EXPECT_NEAR(pressure_at(curtain, 7.0), 2.0 / 3.0 * p0, 1e-9);
    EXPECT_NEAR(resultant(profile_of(exact::reference_scene(ReferenceUplift::points, 1.0))).force, 15.439 * p0, 1e-8);
    EXPECT_EQ(resultant(profile_of(exact::reference_scene(ReferenceUplift::none, 1.0))).force, 0.0);
    Scene ruptured = exact::reference_scene(ReferenceUplift::printed_curtain, 1.0);
    ruptured.curtain->intact = false;
    EXPECT_NEAR(resultant(profile_of(ruptured)).force, 22.5 * p0, 1e-8);
    UpliftState damaged = scene_uplift_state(ruptured);
    damaged.curtain = CurtainState::damaged;
    const Scene points = exact::reference_scene(ReferenceUplift::points, 1.0);
    EXPECT_NEAR(resultant(uplift_profile(points, damaged)).force, 22.5 * p0, 1e-8);
}

// A curtain at the very heel is the limit of one just behind it, not a curtain that a crack has passed.
TEST(Uplift, CurtainAtTheHeelHoldsWaterBack)
{
    Scene scene = exact::reference_scene(ReferenceUplift::printed_curtain, 1.0);
    const auto force = [&](double distance) {
        scene.curtain->distance = distance;
        return resultant(profile_of(scene)).force;
    };
    const double p0 = 9810.0 * 62.5;
    EXPECT_NEAR(force(0.0), 15.0 * p0, 1e-8); // 2/3 p0 falling to zero over 45 m
    EXPECT_NEAR(force(1e-9), 15.0 * p0, 1e-9 * p0);
}

// H1 = 45, H2 = 5, X = 8, L = 40, E = 0.5:  H3 = 5 + 0.5 x 40 x 32/40 = 21 m.
TEST(Uplift, DrainsByHand)
{
    const double gamma = 9810.0;
    EXPECT_NEAR(pressure_at(profile_of(drained(45.0, 0.5, 5.0)), 8.0), 21.0 * gamma, 1e-9);
    // Gallery at 12 m above the tailwater: H3 = 12 + 0.5 x 33 x 0.8 = 25.2 m; below it, it does not count.
    EXPECT_NEAR(pressure_at(profile_of(drained(45.0, 0.5, 5.0, 12.0)), 8.0), 25.2 * gamma, 1e-9);
    EXPECT_NEAR(pressure_at(profile_of(drained(45.0, 0.5, 5.0, 3.0)), 8.0), 21.0 * gamma, 1e-9);
    // E = 0 and ineffective drains: linear, 45 - 40 x 8/40 = 37 m. E = 1 without tailwater: nothing left.
    EXPECT_NEAR(pressure_at(profile_of(drained(45.0, 0.0, 5.0)), 8.0), 37.0 * gamma, 1e-9);
    EXPECT_EQ(pressure_at(profile_of(drained(45.0, 1.0)), 8.0), 0.0);
    // Never more than without drains: a gallery at 44 m does not lift the head at the drains.
    EXPECT_NEAR(pressure_at(profile_of(drained(45.0, 0.2, 5.0, 44.0)), 8.0), 37.0 * gamma, 1e-9);
    // Crack of 4 m: H3 = 5 + 0.5 x 40 x 32/36; at the drains E = 0: straight from the tip.
    EXPECT_NEAR(pressure_at(profile_of(drained(45.0, 0.5, 5.0), {Side::heel, 4.0}), 8.0),
                (5.0 + 20.0 * 32.0 / 36.0) * gamma, 1e-9);
    const auto past = profile_of(drained(45.0, 0.5, 5.0), {Side::heel, 8.0});
    EXPECT_NEAR(pressure_at(past, 8.0), 45.0 * gamma, 1e-9);
    EXPECT_NEAR(pressure_at(past, 24.0), 25.0 * gamma, 1e-9);
}

// Base dipping 2 m over 40: heads are measured above the heel, so a static water table gives hydrostatic pressure
// everywhere.
TEST(Uplift, InclinedBaseFollowsTheElevation)
{
    Scene scene = exact::bare_scene({{0, 0}, {40, -2}, {40, 5}, {10, 50}, {0, 50}});
    scene.reservoir = Reservoir{};
    scene.reservoir->level = 4.0;
    scene.tailwater = Tailwater{4.0};
    scene.drains = Drains{};
    scene.drains->distance = 10.0;
    for (UpliftModel model : {UpliftModel::linear, UpliftModel::drains}) {
        scene.uplift.emplace().model = model;
        const auto p = profile_of(scene);
        const double length = std::hypot(40.0, 2.0);
        for (double s : {0.0, 5.0, 10.0, 30.0, length})
            EXPECT_NEAR(pressure_at(p, s), 9810.0 * (4.0 + 2.0 * s / length), 1e-9) << s;
    }
    scene.tailwater.reset(); // dry toe
    scene.uplift->model = UpliftModel::linear;
    EXPECT_EQ(profile_of(scene).points.back().pressure, 0.0);
    scene.reservoir.reset(); // dry everywhere
    EXPECT_EQ(resultant(profile_of(scene)).force, 0.0);
    scene.uplift->model = UpliftModel::drains;
    EXPECT_EQ(resultant(profile_of(scene)).force, 0.0);
}

// Tailwater above the reservoir: the mirrored dam has the mirrored profile.
TEST(Uplift, MirroredWaterGivesTheMirroredProfile)
{
    for (double crack : {0.0, 5.0, 20.0, 34.0}) {
        const Scene a = drained(45.0, 0.6, 12.0, 15.0);
        Scene b = a;
        b.section.polygon = exact::mirrored(a.section.polygon);
        b.reservoir->level = 12.0;
        b.tailwater->level = 45.0;
        b.drains->distance = 32.0;
        const auto pa = profile_of(a, {Side::heel, crack}), pb = profile_of(b, {Side::toe, crack});
        ASSERT_EQ(pa.points.size(), pb.points.size());
        for (std::size_t i = 0; i < pa.points.size(); ++i) {
            const auto &left = pa.points[i], &right = pb.points[pb.points.size() - 1 - i];
            EXPECT_NEAR(left.distance, 40.0 - right.distance, 1e-12);
            EXPECT_NEAR(left.pressure, right.pressure, 1e-9);
        }
    }
}

TEST(Uplift, PointsBeyondACrackKeepTheirPressure)
{
    const Scene scene = exact::reference_scene(ReferenceUplift::points, 1.0);
    const double p0 = 613125.0;
    const auto p = profile_of(scene, {Side::heel, 8.0});
    EXPECT_NEAR(pressure_at(p, 8.0), p0, 1e-9);
    EXPECT_NEAR(pressure_at(p, 10.0), 0.314 * p0, 1e-9);
    EXPECT_NEAR(resultant(p).force,
                (8.0 + 2.0 * 0.5 * (0.314 + 0.314 + 0.001 * 2.0 / 3.0) + 3.015 + 2.61 + 1.85 + 0.3425) * p0, 1e-6);
}

TEST(Uplift, WhatAModelLacksIsRefused)
{
    Scene scene = exact::reference_scene(ReferenceUplift::points, 1.0);
    scene.uplift->points.back().x = 44.0;
    EXPECT_THROW(profile_of(scene), InputError);
    scene.uplift->model = UpliftModel::seepage;
    EXPECT_THROW(profile_of(scene), InputError);
    scene.uplift->model = UpliftModel::drains;
    EXPECT_THROW(profile_of(scene), InputError);
    scene.uplift->model = UpliftModel::seepage;
    const SeepageProfile solver = [](const UpliftState& s) {
        return PressureProfile{{{0, 1e3 * *s.reservoir_level}, {45, 0}}};
    };
    EXPECT_DOUBLE_EQ(resultant(uplift_profile(scene, scene_uplift_state(scene), {}, solver)).force, 22.5 * 62.5e3);
}

const CrackUplift dry = [](const Crack&) { return PressureProfile{{{0, 0}, {10, 0}}}; };

TEST(UpliftCrack, DryJointOpensToThreeTimesTheLever)
{
    // N = 100 at 2 m from the toe of a 10 m base: compressed length 6 m. Moment about the heel: -100 x 8.
    const CrackedBase b = cracked_base({100.0, -800.0}, 10.0, dry);
    EXPECT_EQ(b.status, CrackStatus::partial);
    EXPECT_EQ(b.crack.side, Side::heel);
    EXPECT_NEAR(b.crack.length, exact::dry_crack(100.0, 200.0, 10.0), 1e-13);
    // The same from the other end.
    const CrackedBase m = cracked_base({100.0, -200.0}, 10.0, dry);
    EXPECT_EQ(m.crack.side, Side::toe);
    EXPECT_NEAR(m.crack.length, 4.0, 1e-13);
    EXPECT_EQ(m.compressed_side, Side::heel);
    EXPECT_EQ(cracked_base({100.0, -500.0}, 10.0, dry).status, CrackStatus::closed);
    EXPECT_EQ(cracked_base({100.0, -1001.0}, 10.0, dry).status, CrackStatus::open); // resultant beyond the toe
    EXPECT_EQ(cracked_base({-1.0, 0.0}, 10.0, dry).status, CrackStatus::open);      // floats
}

// Found without the profile of each crack, the answer has the bits of the general search.
TEST(UpliftCrack, AnUnchangedUpliftCracksToTheBitsOfTheGeneralSearch)
{
    const PressureProfile profile{{{0.0, 6.0}, {4.0, 2.0}, {10.0, 1.0}}};
    for (const double normal : {-5.0, 10.0, 60.0, 100.0})
        for (double arm = -1.0; arm < 11.0; arm += 0.37) {
            const BaseLoad load{normal, -normal * arm};
            const CrackedBase a = cracked_base(load, 10.0, [&](const Crack&) { return profile; });
            const CrackedBase b = cracked_base_unchanged(load, 10.0, profile);
            EXPECT_EQ(a.status, b.status);
            EXPECT_EQ(a.crack.side, b.crack.side);
            EXPECT_EQ(a.crack.length, b.crack.length);
            EXPECT_EQ(a.compressed_length, b.compressed_length);
            EXPECT_EQ(a.compressed_side, b.compressed_side);
            EXPECT_EQ(a.effective_normal, b.effective_normal);
            EXPECT_EQ(a.resultant_distance, b.resultant_distance);
            EXPECT_EQ(a.uplift.force, b.uplift.force);
        }
}

TEST(UpliftCrack, OpenedJointKeepsItsWater)
{
    const CrackUplift wet = [](const Crack& c) { return PressureProfile{{{0, 5}, {c.length, 5}, {10, 0}}}; };
    const CrackedBase healed = cracked_base({100.0, -500.0}, 10.0, wet, {Side::heel, 3.0});
    EXPECT_EQ(healed.crack.length, 3.0);
    EXPECT_DOUBLE_EQ(healed.uplift.force, 15.0 + 17.5);
    EXPECT_EQ(healed.compressed_length, 10.0);
}

// The crack jumps past the drains: with working drains it would stop short of them, without them it must grow. The
// search takes the first equilibrium, and finds one beyond the drains when there is none before them.
TEST(UpliftCrack, CrackPastTheDrainsLosesThem)
{
    const Scene scene = drained(49.0, 0.9);
    const auto uplift = [&](const Crack& c) { return profile_of(scene, c); };
    for (double lever : {10.0, 9.0, 8.0, 7.0}) { // distance of N - U(0) from the toe when nothing is cracked
        const double normal = 30e6;
        const BaseLoad load{normal, -normal * (40.0 - lever)};
        const CrackedBase b = cracked_base(load, 40.0, uplift, {}, crack_events(scene));
        if (b.status == CrackStatus::open) continue;
        EXPECT_NEAR(b.compressed_length, 3.0 * (40.0 - b.resultant_distance), 1e-9);
        const double at_drains = pressure_at(b.profile, 8.0);
        if (b.crack.length >= 8.0)
            EXPECT_NEAR(at_drains, 49.0 * 9810.0, 1e-6);
        else
            EXPECT_NEAR(at_drains, 0.1 * 49.0 * 32.0 / (40.0 - b.crack.length) * 9810.0, 1e-6);
    }
}

} // namespace
} // namespace damslip::sliding
