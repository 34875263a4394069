// Acoustic water: coupling of non-matching faces, inertia of the step matrix, the absorbing end's unknowns.
#include "fe2d/fluid/coupled_system.hpp"
#include "fe2d/fluid/fluid_model.hpp"
#include "fe2d/solver/linear_solver.hpp"
#include "fe2d/time/energy.hpp"
#include "fe2d/time/integrate.hpp"
#include "fe2d/time/structure_system.hpp"
#include "fe_scenes.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace damslip;
using namespace damslip::fe2d;

Scene wet_dam(double lean, double level)
{
    Scene scene = fe2d::test::reference_dam();
    scene.section.polygon = {{0, 0}, {45, 0}, {12 + lean, 51.5}, {12 + lean, 62.5}, {lean, 62.5}, {0.4 * lean, 20.0}};
    if (lean == 0.0) scene.section.polygon.pop_back();
    scene.mesh.size = 4.3; // no row of the dam meets one of the water
    scene.mesh.contact_size = 4.0;
    scene.reservoir = Reservoir{};
    scene.reservoir->level = level;
    scene.reservoir->length = 60.0;
    scene.reservoir->model = ReservoirModel::acoustic;
    return scene;
}

// A pressure linear in height is in the water's space, a rigid translation in the dam's: resultants and moments pass exactly whatever the
// nodes of either side. Force of p = y - level on the face: -∫ (level - y) n dS = -(level²/2, -∫(level - y) dx).
TEST(FeFluid, coupling_passes_resultants_between_faces_that_do_not_match)
{
    for (const double lean : {0.0, 6.0}) {
        const Scene scene = wet_dam(lean, 57.0);
        const Model model = build_model(scene);
        FluidOptions options = fluid_options(scene);
        options.surface = WaterSurface::sloshing; // every node has a pressure
        options.far_end = FarEnd::closed;
        const FluidModel water = build_fluid(build_reservoir_mesh(scene), options);
        const DofMap all = all_dofs(model.mesh, 2);
        const SparseMatrix h = face_coupling(model.mesh, all, water.reservoir, water.dofs, water.unknowns());
        Eigen::VectorXd p(water.unknowns()), x = Eigen::VectorXd::Zero(all.count), rotation = x;
        for (std::size_t n = 0; n < water.reservoir.mesh.nodes.size(); ++n)
            p[water.dofs(static_cast<int>(n))] = 57.0 - water.reservoir.mesh.nodes[n].y;
        for (int n = 0; n < model.mesh.node_count(); ++n) {
            x[all(n, 0)] = 1.0;
            rotation[all(n, 0)] = -model.mesh.nodes[n].y;
            rotation[all(n, 1)] = model.mesh.nodes[n].x;
        }
        EXPECT_NEAR(x.dot(h * p), 0.5 * 57.0 * 57.0, 1e-9);
        EXPECT_NEAR((h.transpose() * x - water.force_x).norm(), 0.0, 1e-10);
        double moment =
            0.0; // ∫ (57 - y)(x n_y - y n_x) dS along the straight pieces, by Gauss' rule with two points: cubic
        const Polyline face = lean == 0.0 ? Polyline{{0, 0}, {0, 57}}
                                          : Polyline{{0, 0}, {0.4 * lean, 20}, {lean * (0.4 + 0.6 * 37.0 / 42.5), 57}};
        for (std::size_t k = 0; k + 1 < face.size(); ++k)
            for (const double s : {-1.0, 1.0}) {
                const double t = 0.5 + s * 0.5 / std::sqrt(3.0), dx = face[k + 1].x - face[k].x,
                             dy = face[k + 1].y - face[k].y;
                const Point q{face[k].x + t * dx, face[k].y + t * dy};
                moment += 0.5 * (57.0 - q.y) * (q.x * -dx - q.y * dy);
            }
        EXPECT_NEAR(rotation.dot(h * p), moment, 1e-8);
    }
}

// Symmetric quasi-definite: as many positive pivots as displacements and momenta, as many negative ones as pressures, in any ordering.
TEST(FeFluid, step_matrix_has_the_inertia_of_its_parts)
{
    const Scene scene = wet_dam(6.0, 60.0);
    const Model model = build_model(scene);
    const FluidModel water = build_fluid(scene);
    const StructureSystem structure = structure_system(model, {1.0, 0.001});
    const CoupledSystem coupled =
        couple(structure.system.mass, structure.system.damping, structure.system.stiffness,
               face_coupling(model.mesh, model.dofs, water.reservoir, water.dofs, water.unknowns()), water);
    EXPECT_EQ((SparseMatrix(coupled.damping.transpose()) - coupled.damping).norm(), 0.0);
    for (const double dt : {0.02, 0.0005}) {
        const StepConstants c = step_constants(hht(-0.05), dt);
        LinearSolver solver({.definiteness = Definiteness::quasi_definite});
        const SparseMatrix step = c.a0 * coupled.mass + 0.95 * (c.a1 * coupled.damping + coupled.stiffness);
        ASSERT_TRUE(solver.factorise(step).ok()) << text_of(solver.report().note());
        EXPECT_EQ(solver.report().negative_pivots, water.mesh_unknowns + water.layer_pressures);
        EXPECT_LT(solver.report().residual, 1e-12);
    }
    std::vector<int> seen(static_cast<std::size_t>(coupled.size()), 0);
    for (const auto& pair : coupled.water_pairs)
        for (const Eigen::Index k : pair)
            if (k >= 0) ++seen[static_cast<std::size_t>(k)];
    for (Eigen::Index k = 0; k < coupled.size(); ++k)
        EXPECT_EQ(seen[static_cast<std::size_t>(k)], k < coupled.structure_unknowns ? 0 : 1);
}

// Effective masses of all modes sum to the dam's and the water's, in both directions; the dam's shares to the dam's mass.
TEST(FeFluid, effective_masses_of_all_coupled_modes_sum_up)
{
    Scene scene = wet_dam(6.0, 60.0);
    scene.mesh.size = scene.mesh.contact_size = 15.0;
    scene.reservoir->mesh_size = 12.0;
    const Model model = build_model(scene);
    const CoupledPencil pencil = coupled_pencil(model, build_fluid(scene));
    const CoupledModes modes = coupled_modes(pencil, 10000);
    ASSERT_EQ(modes.status, CoupledModesStatus::ok);
    EXPECT_EQ(modes.frequency.size(), pencil.mass.rows() + pencil.water_mass.rows());
    // The part of the mass at fixed nodes is in no mode.
    LinearSolver mass;
    ASSERT_TRUE(mass.factorise(pencil.mass).ok());
    const double dam = pencil.inertia_x.dot(mass.solve(pencil.inertia_x));
    EXPECT_NEAR(modes.dam_share.sum() * modes.total_mass.x(), dam, 1e-8 * dam);
    EXPECT_LT(modes.effective_mass.row(0).sum(), modes.total_mass.x());
    EXPECT_GT(modes.effective_mass.row(0).sum(), 0.9 * modes.total_mass.x());
}

// Velocity and displacement between samples and past the end are exact integrals of the broken line.
TEST(FeFluid, ground_displacement_is_the_integral_of_the_broken_line)
{
    GroundMotion motion;
    motion.dt = 0.5;
    motion.accel_h = {0.0, 3.0, -1.0};
    motion.accel_v = {0.0, 0.0, 6.0};
    const GroundHistory ground(motion);
    EXPECT_NEAR(ground.at(0.5).displacement_h, 6.0 / 6.0 * 0.125, 1e-15);  // a = 6t
    EXPECT_NEAR(ground.at(1.0).displacement_v, 12.0 / 6.0 * 0.125, 1e-15); // a = 12 (t - 0.5)
    EXPECT_NEAR(ground.at(0.75).displacement_v, 12.0 / 6.0 * std::pow(0.25, 3), 1e-15);
    const GroundState end = ground.at(1.0), later = ground.at(3.0);
    EXPECT_NEAR(later.displacement_h, end.displacement_h + 2.0 * end.velocity_h, 1e-14);
}

// Nothing moves without ground motion, and the shaking of a stiff dam in slow motion is that of added mass.
TEST(FeFluid, water_at_rest_stays_at_rest)
{
    const Scene scene = wet_dam(0.0, 60.0);
    const Model model = build_model(scene);
    const FluidModel water = build_fluid(scene);
    GroundMotion still;
    still.dt = 0.01;
    still.accel_h.assign(50, 0.0);
    TiedRunOptions options;
    options.water = &water;
    const History history = integrate(model, still, options);
    ASSERT_EQ(history.status, TiedRunStatus::complete) << text_of(history.ending);
    EXPECT_EQ(history.peak_crest_x, 0.0);
    EXPECT_EQ(history.peak_water_force, 0.0);
    EXPECT_EQ(history.unknowns, model.dofs.count + water.unknowns());
}

} // namespace
