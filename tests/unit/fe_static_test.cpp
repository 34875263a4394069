// Static loads and stages: resultants, equilibrium, stresses, the zero-displacement start, what is not in the scene is
// not in the model.
#include "core/input_error.hpp"
#include "fe2d/model/model.hpp"
#include "fe_scenes.hpp"
#include "scene/section.hpp"

#include <gtest/gtest.h>

namespace {

using namespace damslip;
using namespace damslip::fe2d;

constexpr double gamma_w = 1000.0 * 9.81;

const StaticLoad& named(const std::vector<StaticLoad>& loads, const std::string& name)
{
    for (const StaticLoad& load : loads)
        if (load.name == name) return load;
    throw std::runtime_error("no load " + name);
}

Scene full_reservoir()
{
    Scene scene = test::reference_dam_on_rock();
    scene.reservoir = Reservoir{.level = 62.5};
    return scene;
}

// Weight 2500 * 9.81 * 1599.75, thrust 1/2 gamma h^2, whatever the mesh: the shape functions sum to one and the
// pressure is linear.
TEST(FeStatic, resultants_are_exact)
{
    Scene scene = full_reservoir();
    scene.tailwater = Tailwater{.level = 10.0};
    scene.silt = Silt{.level = 12.3, .submerged_unit_weight = 8000.0, .pressure_coefficient = 0.4};
    scene.ice = Ice{.force = 150e3, .level = 61.0};
    scene.forces = {{"gate", {6.0, 62.5}, 10e3, -20e3}};
    scene.reservoir->level = 60.3; // between two nodes
    const Model model = build_model(scene);
    const StaticLoads loads = static_loads(scene, model);
    EXPECT_NEAR(named(loads.gravity, "weight of the dam").resultant[1], -2500.0 * 9.81 * 1599.75, 1e-5);
    const auto water = named(loads.impounding, "water on the upstream face").resultant;
    EXPECT_NEAR(water[0], 0.5 * gamma_w * 60.3 * 60.3, 1e-6);
    EXPECT_NEAR(water[1], 0.0, 1e-6);
    const auto tail = named(loads.impounding, "tailwater on the downstream face").resultant;
    EXPECT_NEAR(tail[0], -0.5 * gamma_w * 100.0, 1e-6);
    EXPECT_NEAR(tail[1], -0.5 * gamma_w * 100.0 * 33.0 / 51.5, 1e-6); // water wedge on the face 33 : 51.5
    EXPECT_NEAR(named(loads.impounding, "silt").resultant[0], 0.5 * 0.4 * 8000.0 * 12.3 * 12.3, 1e-6);
    EXPECT_NEAR(named(loads.impounding, "ice").resultant[0], 150e3, 1e-8);
    EXPECT_NEAR(named(loads.impounding, "gate").resultant[1], -20e3, 1e-8);
}

// 2.5 m of water on 12 m of crest, beside the trapezoid of pressure on the face.
TEST(FeStatic, overtopped_crest_carries_its_water)
{
    Scene scene = full_reservoir();
    scene.reservoir->level = 65.0;
    const StaticLoads loads = static_loads(scene, build_model(scene));
    const StaticLoad crest = named(loads.impounding, "water on the crest");
    EXPECT_NEAR(crest.resultant.x(), 0.0, 1e-6);
    EXPECT_NEAR(crest.resultant.y(), -gamma_w * 2.5 * 12.0, 1e-9 * gamma_w * 30.0);
    const double thrust = gamma_w * 0.5 * (65.0 * 65.0 - 2.5 * 2.5);
    EXPECT_NEAR(named(loads.impounding, "water on the upstream face").resultant.x(), thrust, 1e-9 * thrust);
}

TEST(FeStatic, floor_pressure_only_where_asked_for)
{
    Scene scene = full_reservoir();
    scene.reservoir->floor_pressure = true;
    const Model model = build_model(scene);
    const auto floor = named(static_loads(scene, model).impounding, "water on the reservoir floor").resultant;
    EXPECT_NEAR(floor[1], -gamma_w * 62.5 * (150.0 - 22.5), 1e-3);
    EXPECT_NEAR(floor[0], 0.0, 1e-6);
    scene.reservoir->floor_pressure = false;
    EXPECT_EQ(static_loads(scene, model).impounding.size(), 1u);
}

// A jump inside an element and kinks off the nodes: the integral is that of the profile, 1/2 and whole trapezoids by
// hand.
TEST(FeStatic, uplift_profile_is_integrated_exactly_and_acts_on_both_sides)
{
    const Scene scene = test::reference_dam_on_rock();
    const Mesh mesh = build_mesh(scene);
    const DofMap all = all_dofs(mesh, 2);
    const PressureProfile profile{{{0, 600e3}, {7.3, 560e3}, {7.3, 190e3}, {45, 0}}};
    const double expected = 7.3 * 580e3 + 0.5 * 37.7 * 190e3;
    const auto vertical = [&](ContactSide side) {
        const Eigen::VectorXd f = uplift_load(mesh, all, profile, side);
        double sum = 0.0;
        for (Eigen::Index i = 1; i < f.size(); i += 2) sum += f[i];
        return sum;
    };
    EXPECT_NEAR(vertical(ContactSide::dam), expected, 1e-6);
    EXPECT_NEAR(vertical(ContactSide::rock), -expected, 1e-6);
    const DofMap tied = displacement_dofs(mesh, Base::tied);
    const Eigen::VectorXd both =
        uplift_load(mesh, tied, profile, ContactSide::dam) + uplift_load(mesh, tied, profile, ContactSide::rock);
    EXPECT_LT(both.lpNorm<Eigen::Infinity>(), 1e-8); // a tied joint does not feel its pore pressure
}

// An inclined base: the uplift acts along the base's normal (sin theta, cos theta), theta positive where the base dips
// downstream.
TEST(FeStatic, uplift_on_an_inclined_base_is_normal_to_it)
{
    Scene scene = test::reference_dam();
    scene.section.polygon[1].y = -5.0;
    const Mesh mesh = build_mesh(scene);
    const Eigen::VectorXd f = uplift_load(mesh, all_dofs(mesh, 2), {{{0, 1.0}, {100, 1.0}}}, ContactSide::dam);
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (Eigen::Index i = 0; i < f.size(); ++i) sum[i % 2] += f[i];
    EXPECT_NEAR(sum[0], 5.0, 1e-12);
    EXPECT_NEAR(sum[1], 45.0, 1e-12);
}

// Newton's third law across the base: the rock's forces on the dam balance all loads on the dam, in both forces and
// about the heel.
TEST(FeStatic, base_forces_balance_the_loads)
{
    for (const bool rigid : {true, false}) {
        Scene scene = full_reservoir();
        if (rigid) scene.foundation.reset(), scene.curtain.reset();
        const Model model = build_model(scene);
        const StaticSolution solution = solve_static(scene, model, static_loads(scene, model));
        ASSERT_TRUE(solution.solver.ok()) << text_of(solution.solver.note());
        const DofMap all = all_dofs(model.mesh, 2);
        const Region dam[] = {Region::dam};
        const Eigen::VectorXd load =
            gravity_load(model.mesh, all, model.materials, scene.gravity, dam) +
            pressure_load(
                model.mesh, all, model.mesh.upstream_face, [](Point p) { return gamma_w * (62.5 - p.y); }, 62.5);
        const Eigen::Matrix2Xd forces = base_forces(model, solution.stages.back().elastic, load);
        const double weight = 2500.0 * 9.81 * 1599.75, thrust = 0.5 * gamma_w * 62.5 * 62.5;
        EXPECT_NEAR(forces.row(0).sum(), -thrust, 1e-8 * thrust);
        EXPECT_NEAR(forces.row(1).sum(), weight, 1e-8 * weight);
        double moment = 0.0; // about the heel, x F_y; the base is horizontal
        for (Eigen::Index i = 0; i < forces.cols(); ++i)
            moment += model.mesh.contact.distance[static_cast<std::size_t>(i)] * forces(1, i);
        EXPECT_NEAR(moment, weight * centroid(scene.section).x + thrust * 62.5 / 3.0, 1e-8 * moment);
    }
}

// Stage by stage: with the geostatic start displacements count from the end of gravity, stresses do not.
TEST(FeStatic, geostatic_start_resets_displacements_and_keeps_stresses)
{
    Scene scene = full_reservoir();
    const Model model = build_model(scene);
    const StaticLoads loads = static_loads(scene, model);
    const StaticSolution plain = solve_static(scene, model, loads);
    scene.stages.geostatic = true;
    const StaticSolution geostatic = solve_static(scene, model, loads);
    ASSERT_EQ(plain.stages.size(), 2u);
    EXPECT_EQ(plain.stages[1].name, "impounding");
    EXPECT_EQ(geostatic.stages[0].displacement.norm(), 0.0);
    EXPECT_EQ((geostatic.stages[1].elastic - plain.stages[1].elastic).norm(), 0.0);
    const Eigen::VectorXd difference = plain.stages[1].displacement - geostatic.stages[1].displacement;
    EXPECT_LT((difference - plain.stages[0].displacement).norm(), 1e-14 * difference.norm() * 100);
    EXPECT_EQ(plain.solver.factorisations, 1); // one factor for all stages
}

TEST(FeStatic, rock_weight_only_where_asked_for)
{
    Scene scene = test::reference_dam_on_rock();
    scene.foundation->material.density = 2700.0;
    const Model model = build_model(scene);
    EXPECT_EQ(static_loads(scene, model).gravity.size(), 1u);
    scene.stages.gravity = GravityStage::dam_and_rock;
    EXPECT_NEAR(named(static_loads(scene, model).gravity, "weight of the rock").resultant[1], -2700.0 * 9.81 * 30000.0,
                1e-2);
}

TEST(FeStatic, principal_stresses)
{
    const PrincipalStress shear = principal_stress({0.0, 0.0, 2.0});
    EXPECT_NEAR(shear.major, 2.0, 1e-15);
    EXPECT_NEAR(shear.minor, -2.0, 1e-15);
    EXPECT_NEAR(shear.angle, M_PI / 4, 1e-15);
    const PrincipalStress vertical = principal_stress({-1.0, 3.0, 0.0});
    EXPECT_NEAR(std::abs(vertical.angle), M_PI / 2, 1e-15);
}

// The effects of a scene sum to what the matrices hold; an effect that is not in the scene is not in the list and adds
// nothing.
TEST(FeStatic, counts_are_those_of_the_matrices)
{
    const AddedMassLaw law = [](Point, double) { return 1000.0; };
    Scene scene = full_reservoir();
    const Model full = build_model(scene, {.added_mass = law});
    EXPECT_EQ(full.counts.effects.size(), 4u);
    EXPECT_EQ(full.counts.unknowns, full.dofs.count);
    EXPECT_EQ(full.counts.nonzeros, full.stiffness.nonZeros() + full.mass.nonZeros() + full.added_mass.nonZeros());
    LinearSolver solver;
    EXPECT_EQ(solver.factorise(full.stiffness).unknowns, full.counts.unknowns);

    scene.reservoir.reset();
    const Model dry = build_model(scene, {.added_mass = law}); // no reservoir: the law is not even called
    EXPECT_EQ(dry.added_mass.nonZeros(), 0);
    EXPECT_EQ(dry.counts.effects.size(), 3u);
    scene.curtain.reset();
    scene.foundation.reset();
    const Model alone = build_model(scene);
    ASSERT_EQ(alone.counts.effects.size(), 1u);
    EXPECT_EQ(alone.mesh.dam_element_count, alone.mesh.element_count());
}

TEST(FeStatic, a_force_outside_the_dam_is_refused)
{
    Scene scene = full_reservoir();
    scene.forces = {{"crane", {30.0, 60.0}, 0.0, -1e5}};
    const Model model = build_model(scene);
    EXPECT_THROW(static_loads(scene, model), InputError);
}

} // namespace
