// The rigid block of a scene and the load combinations.
#include "sliding/equilibrium/limit_equilibrium.hpp"

#include "core/input_error.hpp"
#include "pages/scene/scene_pages.hpp"
#include "verification/exact/cracked_base.hpp"
#include "verification/exact/reference_scene.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace damslip::sliding {
namespace {

using exact::ReferenceUplift;

double static_critical_friction(const RigidBlock& block) // horizontal base, no cohesion
{
    return block.horizontal_force / (block.mass * block.gravity + block.vertical_force - block.uplift);
}

// By hand: G = 39233868.75, W_s = 19160156.25 N/m, U = p0 (7 (1 + 2/3)/2 + 38/3) = 18.5 p0 and 22.5 p0, p0 = 613125 Pa.
TEST(Equilibrium, RigidBlockOfTheReferenceScene)
{
    const RigidBlock block = make_rigid_block(exact::reference_scene(ReferenceUplift::printed_curtain, 0.77));
    EXPECT_DOUBLE_EQ(block.mass, 3999375.0);
    EXPECT_DOUBLE_EQ(block.horizontal_force, 19160156.25);
    EXPECT_EQ(block.vertical_force, 0.0);
    EXPECT_NEAR(block.uplift, 18.5 * 613125.0, 1e-8);
    EXPECT_NEAR(block.added_mass.xx, 7.0 / 12.0 * 1000.0 * 62.5 * 62.5, 1e-6);
    EXPECT_NEAR(static_critical_friction(block), 19160156.25 / (39233868.75 - 11342812.5), 1e-15);
    EXPECT_NEAR(static_critical_friction(block), 0.687, 5e-5);
    const RigidBlock linear = make_rigid_block(exact::reference_scene(ReferenceUplift::linear, 0.77));
    EXPECT_NEAR(static_critical_friction(linear), 0.753, 5e-4);
}

TEST(Equilibrium, OverridesReachTheBlock)
{
    Scene scene = exact::reference_scene(ReferenceUplift::linear, 0.77);
    scene.contact.cohesion = 1e5;
    BlockOptions options;
    EXPECT_DOUBLE_EQ(make_rigid_block(scene, options).cohesion_force, 45e5);
    options.friction = 0.9;
    options.cohesion = 2e5;
    EXPECT_DOUBLE_EQ(make_rigid_block(scene, options).friction, 0.9);
    EXPECT_DOUBLE_EQ(make_rigid_block(scene, options).cohesion_force, 90e5);
    scene.reservoir->model = ReservoirModel::hydrostatic;
    EXPECT_EQ(make_rigid_block(scene).added_mass.xx, 0.0);

    // A seepage solution passed in, its rupture, and drains that are lost.
    scene.uplift->model = UpliftModel::seepage;
    options.seepage = fixed_profile({{{0.0, 6e5}, {7.0, 6e5}, {7.0, 2e5}, {45.0, 0.0}}});
    EXPECT_DOUBLE_EQ(make_rigid_block(scene, options).uplift, 42e5 + 38e5);
    options.curtain = CurtainState::damaged;
    EXPECT_NEAR(make_rigid_block(scene, options).uplift, 22.5 * 613125.0, 1e-8);
    scene.uplift->model = UpliftModel::drains;
    scene.drains = Drains{};
    scene.drains->distance = 9.0;
    const double drained = make_rigid_block(scene, options).uplift;
    options.drains = DrainState::ineffective;
    EXPECT_NEAR(make_rigid_block(scene, options).uplift, 22.5 * 613125.0, 1e-8);
    EXPECT_LT(drained, 22.5 * 613125.0);
}

Combination combination(CombinationKind kind = CombinationKind::usual)
{
    Combination c;
    c.name = word(kind);
    c.kind = kind;
    return c;
}

// Triangle 45 x 62.5 m, 2500 kg/m^3, water to the crest, no uplift:
// a_y = (0.77 x 34.48828125e6 - 19.16015625e6) / (3.515625e6 + 7/12 1000 62.5^2) = 1.27640 m/s^2.
Scene triangular_dam(double friction = 0.77)
{
    Scene scene = exact::bare_scene(exact::triangle(45.0, 62.5), 2500.0);
    scene.contact.friction = friction;
    scene.reservoir = Reservoir{};
    scene.reservoir->level = 62.5;
    scene.added_mass.formula = AddedMassFormula::westergaard_simplified;
    return scene;
}

// A dam with both faces sloping, an inclined base, all kinds of loads.
Scene sloping_dam()
{
    Scene scene = exact::bare_scene({{0, 0}, {50, -3}, {50, 4}, {14, 60}, {6, 60}, {6, 25}}, 2400.0);
    scene.contact.friction = 0.8;
    scene.contact.cohesion = 2e5;
    scene.reservoir = Reservoir{};
    scene.reservoir->level = 55.0;
    scene.tailwater = Tailwater{6.0};
    scene.silt = Silt{10.0, 8000.0, 0.4};
    scene.forces = {{"anchor", {10.0, 60.0}, -1e5, -6e5}};
    scene.uplift.emplace().model = UpliftModel::linear;
    return scene;
}

TEST(Equilibrium, TriangularDamByHand)
{
    const Equilibrium e = evaluate(triangular_dam(), combination(), {});
    const double weight = 0.5 * 45.0 * 62.5 * 2500.0 * 9.81, thrust = 0.5 * 9810.0 * 62.5 * 62.5;
    EXPECT_NEAR(e.yield_acceleration, (0.77 * weight - thrust) / (3515625.0 + 7.0 / 12.0 * 1000.0 * 3906.25), 1e-12);
    EXPECT_NEAR(e.yield_acceleration, 1.27640, 5e-6);
    EXPECT_NEAR(e.base.effective_normal, weight, 1e-7);
    EXPECT_NEAR(e.shear, thrust, 1e-7);
    EXPECT_NEAR(e.sliding_factor, 0.77 * weight / thrust, 1e-14);
    EXPECT_NEAR(e.critical_friction, thrust / weight, 1e-14);
    // Moments about the toe: weight x 30 m against thrust x 62.5/3.
    const double from_toe = 30.0 - thrust / weight * 62.5 / 3.0;
    EXPECT_NEAR(e.resultant_from_toe, from_toe, 1e-12);
    EXPECT_NEAR(e.eccentricity, 22.5 - from_toe, 1e-12);
    EXPECT_EQ(e.zone, ResultantZone::kern);
    EXPECT_NEAR(e.overturning_factor, weight * 30.0 / (thrust * 62.5 / 3.0), 1e-13);
    EXPECT_NEAR(e.heel_stress + e.toe_stress, 2.0 * weight / 45.0, 1e-7);
    EXPECT_NEAR(e.toe_stress, weight / 45.0 * (1.0 + 6.0 * e.eccentricity / 45.0), 1e-7);
    EXPECT_EQ(e.flotation_factor, std::numeric_limits<double>::infinity());
}

TEST(Equilibrium, SeismicCombinationByHand)
{
    Combination c = combination(CombinationKind::extreme);
    c.k_h = 0.1;
    c.k_v = -0.05;
    const Equilibrium e = evaluate(triangular_dam(), c, {});
    const double m = 3515625.0, m_w = 7.0 / 12.0 * 1000.0 * 3906.25, a_h = 0.980665, a_v = -0.4903325;
    const double thrust = 0.5 * 9810.0 * 62.5 * 62.5;
    EXPECT_NEAR(e.base.effective_normal, m * (9.81 + a_v), 1e-7); // downward acceleration lightens the dam
    EXPECT_NEAR(e.shear, thrust + (m + m_w) * a_h, 1e-7);
    EXPECT_NEAR(e.base.resultant_distance,
                (m * (9.81 + a_v) * 15.0 + thrust * 62.5 / 3.0 + m * a_h * 62.5 / 3.0 + m_w * a_h * 25.0) /
                    (m * (9.81 + a_v)),
                1e-11);
    EXPECT_NEAR(e.yield_acceleration, (0.77 * m * (9.81 + a_v) - thrust) / (m + m_w), 1e-12);
    EXPECT_GT(evaluate(triangular_dam(), combination(), {}).yield_acceleration, e.yield_acceleration);
}

// The yield acceleration is the ground acceleration at which the sliding factor is 1: two codes, one answer; inclined
// base and face, cohesion and vertical motion included. With an inclined face the sliding block's acceleration and the
// ground's are the same at yield.
TEST(Equilibrium, SlidingFactorIsOneAtTheYieldAcceleration)
{
    for (const Scene& scene : {triangular_dam(), sloping_dam()})
        for (double k_v : {0.0, 0.1, -0.1}) {
            Combination c = combination(CombinationKind::extreme);
            c.crack = CrackRule::none;
            c.k_v = k_v;
            const Equilibrium still = evaluate(scene, c, {});
            c.k_h = still.yield_acceleration / 9.80665;
            EXPECT_NEAR(evaluate(scene, c, {}).sliding_factor, 1.0, 1e-12);
            c.k_h = -still.yield_acceleration_upstream / 9.80665;
            const Equilibrium up = evaluate(scene, c, {});
            EXPECT_NEAR(up.sliding_factor, 1.0, 1e-12);
            EXPECT_LT(up.shear, 0.0);
        }
}

TEST(Equilibrium, ResultantIsAtTheToeAtTheTippingAcceleration)
{
    for (const Scene& scene : {triangular_dam(), sloping_dam()}) {
        Combination c = combination(CombinationKind::extreme);
        c.crack = CrackRule::none;
        c.k_v = 0.07;
        c.k_h = evaluate(scene, c, {}).tipping_acceleration / 9.80665;
        const Equilibrium e = evaluate(scene, c, {});
        EXPECT_NEAR(e.resultant_from_toe, 0.0, 1e-11);
        EXPECT_NEAR(e.overturning_factor, 1.0, 1e-12);
        EXPECT_NEAR(e.eccentricity, 0.5 * e.frame.length, 1e-11);
    }
}

// Triangle under 58 m of water, linear uplift: crack and uplift in equilibrium, against the closed form.
TEST(Equilibrium, CrackedTriangle)
{
    Scene scene = triangular_dam();
    scene.dam.density = 2400.0;
    scene.reservoir->level = 58.0;
    scene.uplift.emplace().model = UpliftModel::linear;
    Combination c = combination();
    c.crack = CrackRule::fixed_static;
    const Equilibrium e = evaluate(scene, c, {});
    const double weight = 0.5 * 45.0 * 62.5 * 2400.0 * 9.81, thrust = 0.5 * 9810.0 * 3364.0;
    const double crack = exact::linear_uplift_crack(weight, weight * 30.0 - thrust * 58.0 / 3.0, 9810.0 * 58.0, 45.0);
    ASSERT_GT(crack, 5.0);
    ASSERT_EQ(e.base.status, CrackStatus::partial);
    EXPECT_NEAR(e.base.crack.length, crack, 1e-10);
    EXPECT_EQ(e.heel_stress, 0.0);
    EXPECT_NEAR(e.toe_stress, 2.0 * e.base.effective_normal / (45.0 - crack), 1e-6);
    EXPECT_NEAR(e.cohesive_length, 45.0 - crack, 1e-10);
    c.crack = CrackRule::none;
    const Equilibrium none = evaluate(scene, c, {});
    EXPECT_LT(none.heel_stress, 0.0);
    EXPECT_GT(none.yield_acceleration, e.yield_acceleration); // the crack lets more water in
    EXPECT_FALSE(none.notes.empty());
}

// Pressures under an earthquake, from least to most uplift: zero <= unchanged <= full; the static crack is not reopened
// by `static`.
TEST(Equilibrium, SeismicCrackRules)
{
    Scene scene = exact::reference_scene(ReferenceUplift::printed_curtain, 0.9);
    Combination c = combination(CombinationKind::extreme);
    c.k_h = 0.03;
    const auto with = [&](CrackRule rule) {
        c.crack = rule;
        return evaluate(scene, c, {});
    };
    const Equilibrium none = with(CrackRule::none), fixed = with(CrackRule::fixed_static),
                      zero = with(CrackRule::seismic_zero), unchanged = with(CrackRule::seismic_unchanged),
                      full = with(CrackRule::seismic_full);
    EXPECT_EQ(none.base.crack.length, 0.0);
    EXPECT_EQ(fixed.base.crack.length, 0.0); // the static resultant lies in the kern
    EXPECT_DOUBLE_EQ(fixed.base.uplift.force, none.base.uplift.force);
    EXPECT_DOUBLE_EQ(unchanged.base.uplift.force, none.base.uplift.force);
    EXPECT_GT(unchanged.base.crack.length, 0.0);
    EXPECT_NEAR(unchanged.base.compressed_length, 3.0 * unchanged.resultant_from_toe, 1e-10);
    EXPECT_LT(zero.base.uplift.force, unchanged.base.uplift.force);
    EXPECT_GT(full.base.uplift.force, unchanged.base.uplift.force);
    EXPECT_GT(full.base.crack.length, unchanged.base.crack.length);
    EXPECT_LT(zero.base.crack.length, unchanged.base.crack.length);
    EXPECT_EQ(pressure_at(zero.base.profile, 0.5 * zero.base.crack.length), 0.0);
    EXPECT_NEAR(pressure_at(full.base.profile, 0.5 * full.base.crack.length), 613125.0, 1e-6);
    EXPECT_NEAR(unchanged.yield_acceleration, none.yield_acceleration, 1e-13);
}

// Tailwater on the upstream side of the mirrored dam: everything mirrors, with the crack at the other end.
TEST(Equilibrium, MirroredScene)
{
    Scene a = exact::bare_scene({{0, 0}, {40, 0}, {40, 3}, {9, 50}, {3, 50}, {3, 20}}, 2200.0);
    a.contact.friction = 0.75;
    a.contact.cohesion = 5e4;
    a.reservoir = Reservoir{};
    a.reservoir->level = 48.0;
    a.reservoir->model = ReservoirModel::hydrostatic; // the tailwater has no added mass
    a.tailwater = Tailwater{9.0};
    a.uplift.emplace().model = UpliftModel::linear;
    Scene b = a;
    b.section.polygon = exact::mirrored(a.section.polygon);
    b.reservoir->level = 9.0;
    b.tailwater->level = 48.0;
    for (CrackRule rule : {CrackRule::none, CrackRule::fixed_static}) {
        Combination c = combination();
        c.crack = rule;
        const Equilibrium ea = evaluate(a, c, {}), eb = evaluate(b, c, {});
        EXPECT_NEAR(ea.shear, -eb.shear, 1e-7);
        EXPECT_NEAR(ea.base.effective_normal, eb.base.effective_normal, 1e-6);
        EXPECT_NEAR(ea.resultant_from_toe, 40.0 - eb.resultant_from_toe, 1e-10);
        EXPECT_NEAR(ea.heel_stress, eb.toe_stress, 1e-6);
        EXPECT_NEAR(ea.toe_stress, eb.heel_stress, 1e-6);
        EXPECT_NEAR(ea.base.crack.length, eb.base.crack.length, 1e-10);
        EXPECT_NEAR(ea.sliding_factor, eb.sliding_factor, 1e-12);
        EXPECT_NEAR(ea.overturning_factor, eb.overturning_factor, 1e-12);
        EXPECT_NEAR(ea.flotation_factor, eb.flotation_factor, 1e-12);
        EXPECT_NEAR(ea.yield_acceleration, eb.yield_acceleration_upstream, 1e-12);
        EXPECT_NEAR(ea.yield_acceleration_upstream, eb.yield_acceleration, 1e-12);
        if (rule != CrackRule::none) {
            ASSERT_GT(ea.base.crack.length, 0.0);
            EXPECT_EQ(eb.base.crack.side, Side::toe);
        }
    }
}

// All lengths times 2: forces times 4, moments times 8 exactly, so the yield acceleration keeps its bits.
TEST(Equilibrium, DoubledSizeKeepsTheYieldAcceleration)
{
    for (auto uplift : {ReferenceUplift::linear, ReferenceUplift::printed_curtain, ReferenceUplift::points}) {
        const Equilibrium one = evaluate(exact::reference_scene(uplift, 0.77), combination(), {});
        const Equilibrium two = evaluate(exact::reference_scene(uplift, 0.77, 2.0), combination(), {});
        EXPECT_DOUBLE_EQ(one.yield_acceleration, two.yield_acceleration);
        EXPECT_DOUBLE_EQ(one.sliding_factor, two.sliding_factor);
        EXPECT_DOUBLE_EQ(2.0 * one.heel_stress, two.heel_stress);
    }
}

TEST(Equilibrium, DryEmptyAndFloatingScenes)
{
    Scene scene = exact::bare_scene(exact::triangle(45.0, 62.5), 2400.0);
    const Equilibrium empty = evaluate(scene, combination(), {});
    EXPECT_EQ(empty.shear, 0.0);
    EXPECT_EQ(empty.sliding_factor, std::numeric_limits<double>::infinity());
    EXPECT_NEAR(empty.toe_stress, 0.0, 1e-6); // weight at the edge of the kern
    EXPECT_EQ(empty.zone, ResultantZone::kern);
    // Light block under deep still water on both sides: floats, and says so.
    scene = exact::bare_scene({{0, 0}, {10, 0}, {10, 10}, {0, 10}}, 900.0);
    scene.reservoir = Reservoir{};
    scene.reservoir->level = 10.0;
    scene.tailwater = Tailwater{10.0};
    scene.uplift.emplace().model = UpliftModel::linear;
    scene.uplift->crack = CrackRule::fixed_static;
    const Equilibrium floats = evaluate(scene, combination(), {});
    EXPECT_EQ(floats.base.status, CrackStatus::open);
    EXPECT_EQ(floats.zone, ResultantZone::outside);
    EXPECT_NEAR(floats.flotation_factor, 0.9, 1e-14);
    EXPECT_EQ(floats.sliding_factor, std::numeric_limits<double>::infinity()); // no shear either
    EXPECT_EQ(floats.notes.size(), 1u);
}

TEST(Equilibrium, LoadFactorsAndStrengths)
{
    Scene scene = exact::reference_scene(ReferenceUplift::linear, 0.9);
    scene.contact.cohesion = 1e5;
    scene.contact.residual_friction = 0.7;
    Combination c = combination();
    c.weight_factor = 0.9;
    c.water_factor = 1.2;
    c.uplift_factor = 1.1;
    c.friction = 0.8;
    const Equilibrium e = evaluate(scene, c, {});
    const double normal = 0.9 * 39233868.75 - 1.1 * 22.5 * 613125.0, shear = 1.2 * 19160156.25;
    EXPECT_NEAR(e.base.effective_normal, normal, 1e-6);
    EXPECT_NEAR(e.sliding_factor, (0.8 * normal + 45e5) / shear, 1e-13);
    EXPECT_NEAR(e.friction_factor, 0.8 * normal / shear, 1e-13);
    EXPECT_NEAR(e.sliding_factor_residual, 0.7 * normal / shear, 1e-13); // cohesion is lost at slip
    c.residual_strength = true;
    c.friction.reset();
    EXPECT_NEAR(evaluate(scene, c, {}).sliding_factor, 0.7 * normal / shear, 1e-13);
}

TEST(Equilibrium, DefaultCombinationsAndVerdicts)
{
    Scene scene = exact::reference_scene(ReferenceUplift::printed_curtain, 0.84);
    scene.criteria.document = "cadam3d";
    const auto all = evaluate_combinations(scene, {1.0, 0.0});
    ASSERT_GE(all.size(), 4u); // usual, seismic without and with crack, post-seismic twice
    EXPECT_EQ(all.front().kind, CombinationKind::usual);
    EXPECT_EQ(all.back().kind, CombinationKind::post_seismic);
    EXPECT_EQ(all.front().checks.front().verdict, Verdict::fail); // 1.22 < 3
    EXPECT_FALSE(all.front().checks.front().source.empty());
    EXPECT_EQ(all.front().checks[2].verdict, Verdict::no_criterion);
    // Damaged curtain: linear uplift after the earthquake.
    const auto& after =
        *std::find_if(all.begin(), all.end(), [](auto& e) { return e.kind == CombinationKind::post_seismic; });
    EXPECT_NEAR(after.base.uplift.force, 22.5 * 613125.0, 1e-6);
    EXPECT_GT(all.back().base.uplift.force, after.base.uplift.force); // the opened joint is full of water
    EXPECT_EQ(combinations(scene).size(), 2u);                        // no record, no seismic one

    Combination own = combination();
    own.required_sliding_factor = 1.1;
    own.required_resultant = "base";
    own.source = "owner's rules";
    scene.combinations = {own};
    const auto given = evaluate_combinations(scene);
    ASSERT_EQ(given.size(), 1u);
    EXPECT_EQ(given[0].checks[0].verdict, Verdict::pass);
    EXPECT_EQ(given[0].checks[0].source, "owner's rules");
    EXPECT_EQ(given[0].checks.back().verdict, Verdict::pass);
    scene.criteria.document = "nobody";
    EXPECT_THROW(evaluate_combinations(scene), InputError);
}

TEST(Equilibrium, TablesHaveACellPerColumn)
{
    const Scene scene = exact::reference_scene(ReferenceUplift::points, 0.84);
    const auto all = evaluate_combinations(scene, {1.0, 0.3});
    const auto models = compare_uplift(scene);
    ASSERT_EQ(models.size(), 4u);
    EXPECT_NEAR(models[1].critical_friction, 19160156.25 / (39233868.75 - 22.5 * 613125.0), 1e-14);
    for (const Table& table : {pages::load_table(all.back()), pages::equilibrium_table(all), pages::verdict_table(all),
                               pages::uplift_comparison_table(models)}) {
        EXPECT_FALSE(table.rows.empty());
        for (const auto& row : table.rows) EXPECT_EQ(row.size(), table.columns.size()) << table.title;
    }
}

// Whatever the water, the search for the crack ends and its answer balances.
TEST(Equilibrium, CrackSearchAlwaysEnds)
{
    for (double level = 2.0; level <= 75.0; level += 3.1)
        for (double k_h : {-0.4, 0.0, 0.05, 0.6})
            for (CrackRule rule : {CrackRule::fixed_static, CrackRule::seismic_zero, CrackRule::seismic_unchanged,
                                   CrackRule::seismic_full}) {
                Scene scene = exact::reference_scene(ReferenceUplift::points, 0.8);
                scene.reservoir->level = level;
                Combination c = combination(CombinationKind::extreme);
                c.k_h = k_h;
                c.crack = rule;
                const Equilibrium e = evaluate(scene, c, {});
                EXPECT_TRUE(std::isfinite(e.shear));
                EXPECT_GE(e.base.crack.length, 0.0);
                EXPECT_LE(e.base.crack.length, 45.0);
                if (e.base.status == CrackStatus::partial && rule != CrackRule::fixed_static) {
                    const double d =
                        e.base.compressed_side == Side::toe ? e.resultant_from_toe : 45.0 - e.resultant_from_toe;
                    EXPECT_NEAR(e.base.compressed_length, 3.0 * d, 1e-8) << level << " " << k_h;
                }
            }
}

} // namespace
} // namespace damslip::sliding
