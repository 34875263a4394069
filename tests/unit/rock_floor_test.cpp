// A water's floor that is the radiating rock (reservoir.floor = "rock").
#include "fe2d/harmonic/transfer.hpp"
#include "fe2d/rock/reduced_rock.hpp"
#include "fe2d/rock/radiating_rock.hpp"
#include "fe2d/time/integrate.hpp"
#include "rock_scenes.hpp"
#include "scene/rock_mass.hpp"
#include "scene/section.hpp"
#include "verification/cases/fe_run_scenes.hpp"

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace damslip::rock_tests {

using namespace fe2d;
using fe2d::test::options_of;
using fe2d::test::sines;
using std::numbers::pi;

namespace {

/// The reference dam on coarse elements, its floor the rock.
Scene dam_with_floor(double friction, double stiffness = 1.0)
{
    Scene scene = fe2d::test::sliding_dam(friction, 1.0, 5.0);
    scene.foundation->material = {2650.0, 30e9 * stiffness, 0.2};
    scene.foundation->mass = RockMass::with_mass;
    scene.foundation->boundary = RockBoundary::absorbing;
    scene.curtain.reset();
    scene.reservoir->model = ReservoirModel::acoustic;
    scene.reservoir->length = 62.5;
    scene.reservoir->mesh_size = 6.25;
    scene.reservoir->floor = ReservoirFloor::rock;
    return scene;
}

Scene with_reflection(Scene scene, double reflection)
{
    scene.reservoir->floor = ReservoirFloor::absorbing;
    scene.reservoir->bottom_reflection = reflection;
    return scene;
}

RunResult slide(const Scene& scene, const GroundMotion& motion)
{
    return EarthquakeRun(scene, options_of(scene)).run(motion);
}

double largest(const std::vector<double>& values)
{
    double result = 0.0;
    for (const double value : values) result = std::max(result, std::abs(value));
    return result;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b)
{
    EXPECT_EQ(a.size(), b.size());
    double result = 0.0;
    for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k) result = std::max(result, std::abs(a[k] - b[k]));
    return result;
}

Eigen::MatrixXd floor_block(const ReducedRock& rock, const Eigen::MatrixXd& whole)
{
    return whole.bottomRightCorner(rock.floor, rock.floor);
}

/// Below the base a spring and below each point of the floor a half space of waves that go straight down: v̇ = ∫NN p/Z. Its
/// modes are dampers: q̇ = Φᵀp/C at frequencies far below C.
ReducedRock bed_of_dashpots(const Model& model, const ReservoirMesh& water, double impedance)
{
    constexpr double damper = 1e8;
    const auto base = static_cast<Eigen::Index>(unknowns_of_base(model).size()),
               floor = static_cast<Eigen::Index>(water.bottom.size());
    Eigen::MatrixXd admittance = Eigen::MatrixXd::Zero(floor, floor);
    for (Eigen::Index k = 0; k + 1 < floor; ++k) {
        const double length = water.mesh.nodes[water.bottom[k + 1]].x - water.mesh.nodes[water.bottom[k]].x;
        for (const Eigen::Index i : {k, k + 1})
            for (const Eigen::Index j : {k, k + 1})
                admittance(i, j) += length / impedance * (i == j ? 1.0 / 3.0 : 1.0 / 6.0);
    }
    ReducedRock rock;
    rock.floor = floor;
    rock.stiffness = Eigen::VectorXd::Constant(floor, 1e-6);
    rock.damping = damper * Eigen::MatrixXd::Identity(floor, floor);
    rock.modes = Eigen::MatrixXd::Zero(base + floor, floor);
    rock.modes.bottomRows(floor) = std::sqrt(damper) * Eigen::MatrixXd(admittance.llt().matrixL());
    rock.residual = Eigen::MatrixXd::Zero(base + floor, base + floor);
    rock.residual.topLeftCorner(base, base).diagonal().setConstant(1e-9);
    return rock;
}

} // namespace

// The whole floor under one pressure sinks as a strip of the half plane: gates of the base (WaveBox.AnswersAsTheHalfPlaneDoes).
TEST(RockFloor, SinksAsAStripOfTheHalfPlane)
{
    constexpr double length = 60.0;
    RadiatingRockInput input = rock_input(reference_rock, base, 20, 25.0);
    std::vector<Point> floor;
    for (int k = 0; k < 20; ++k) floor.push_back({input.heel.x - length + 3.0 * k, 0.0});
    input.surface.insert(input.surface.begin(), floor.begin(), floor.end());
    input.floor = 20;
    const RadiatingRock rock = radiating_rock(input, no_store);
    EXPECT_TRUE(rock.rock.report.passed()) << rock.rock.report.error;
    ASSERT_EQ(rock.rock.floor, 21);
    ASSERT_EQ(rock.rock.base(), 42);
    const exact::HalfPlane plane = half_plane(reference_rock, length);
    Eigen::VectorXd load = Eigen::VectorXd::Zero(rock.rock.interface());
    load.tail(21).setOnes();
    for (const auto& [hertz, gate] : {std::pair{1.0, 0.1}, {3.0, 0.03}, {8.0, 0.01}, {16.0, 0.01}, {25.0, 0.02}}) {
        const double w = 2.0 * pi * hertz;
        const Eigen::MatrixXcd u = rock.rock.response(w, 0.0, load);
        const std::complex<double> sunk = (load.transpose() * u).value() / (length * length);
        EXPECT_LT(std::abs(sunk / plane.vertical(w) - 1.0), gate) << hertz << " Hz";
    }
    // passive on all its rows, and the base is that of the rock without a floor
    EXPECT_GT(smallest_share(rock.rock.damping), -1e-14);
    EXPECT_GT(smallest_share(rock.rock.residual), -1e-14);
    RadiatingRockInput alone = rock_input(reference_rock, base, 20, 25.0);
    const RadiatingRock without = radiating_rock(alone, no_store);
    const Eigen::MatrixXd loads = strip_loads(alone.surface);
    Eigen::MatrixXd longer = Eigen::MatrixXd::Zero(rock.rock.interface(), loads.cols());
    longer.topRows(42) = loads;
    for (const double hertz : {3.0, 10.0, 25.0}) {
        const double w = 2.0 * pi * hertz;
        const Eigen::MatrixXcd a = loads.transpose() * without.rock.response(w, 0.0, loads),
                               b = longer.transpose() * rock.rock.response(w, 0.0, longer);
        for (const int i : {0, 1, 2}) EXPECT_LT(std::abs(b(i, i) / a(i, i) - 1.0), 0.02) << i << ", " << hertz << " Hz";
    }
}

// Sizes and materials scale with the rows of the floor, too: twice the length, modulus and density of one shape.
TEST(RockFloor, ScalesWithTheRock)
{
    const auto rock_of = [](double length, const ElasticMaterial& material) {
        RadiatingRockInput input = rock_input(material, length, 10,
                                              12.0 * 45.0 / length *
                                                  std::sqrt(material.young_modulus / reference_rock.young_modulus *
                                                            reference_rock.density / material.density));
        std::vector<Point> floor;
        for (int k = 0; k < 6; ++k) floor.push_back({input.heel.x - (1.2 - 0.2 * k) * length, 0.0});
        input.surface.insert(input.surface.begin(), floor.begin(), floor.end());
        input.floor = 6;
        return radiating_rock(input, no_store).rock;
    };
    ElasticMaterial other = reference_rock;
    other.young_modulus *= 2.0;
    other.density *= 1.5;
    const ReducedRock a = rock_of(45.0, reference_rock), b = rock_of(90.0, other);
    const Eigen::MatrixXd fa = floor_block(a, a.static_flexibility()), fb = floor_block(b, b.static_flexibility());
    EXPECT_LT((fb - 4.0 / 2.0 * fa).norm(), 1e-9 * fb.norm()); // L²/E
}

// Water on half spaces below each of its points, through which waves go straight down, is water on a bottom that sends back
// α = (ρ_r c_r - ρc)/(ρ_r c_r + ρc) of them (3-55): the floor's rows and the coefficient are the same boundary. What differs is the
// frequency over the dampers' 1e8.
TEST(RockFloor, BedOfDashpotsIsTheReflectionCoefficient)
{
    Scene scene = dam_with_floor(0.77);
    scene.reservoir->floor = ReservoirFloor::absorbing;
    scene.mesh.size = 8.0;
    const Model model = build_model(scene);
    constexpr double impedance = 2650.0 * 3547.0;
    FluidOptions options = fluid_options(scene);
    options.bottom_reflection =
        (impedance - options.density * options.sound_speed()) / (impedance + options.density * options.sound_speed());
    const FluidModel absorbing = build_fluid(build_reservoir_mesh(scene), options);
    options.floor_on_rock = true;
    const FluidModel coupled = build_fluid(build_reservoir_mesh(scene), options);
    const ReducedRock bed = bed_of_dashpots(model, coupled.reservoir, impedance);
    ReducedRock spring = bed;
    spring.floor = 0;
    spring.modes = bed.modes.topRows(bed.base());
    spring.residual = bed.residual.topLeftCorner(bed.base(), bed.base());
    const RayleighConstants damping{1.5, 1e-3};

    const LinearSystem dam = dam_on_free_base(model, damping);
    const std::vector<double> frequencies{0.5, 2.0, 4.5, 9.0, 17.0};
    const RockBelow below_absorbing{spring, damping.stiffness}, below_coupled{bed, damping.stiffness};
    const auto wanted = transfer_functions(model, dam, &absorbing, frequencies, &below_absorbing),
               found = transfer_functions(model, dam, &coupled, frequencies, &below_coupled);
    for (std::size_t k = 0; k < frequencies.size(); ++k) {
        EXPECT_LT(std::abs(found[k].crest - wanted[k].crest), 1e-5 * std::abs(wanted[k].crest)) << frequencies[k];
        EXPECT_LT(std::abs(found[k].water_force - wanted[k].water_force), 1e-5 * std::abs(wanted[k].water_force));
    }

    const GroundMotion motion = sines(1.0, 4.0);
    for (const Scheme& scheme : {average_acceleration(), hht(-0.05)}) {
        TiedRunOptions run;
        run.scheme = scheme;
        run.damping.constants = damping;
        const auto on = [&](const FluidModel& water, const ReducedRock& rock) {
            run.water = &water;
            run.moving_base = [&](const StepConstants& constants, double stiffness_damping) {
                return rock_base(rock, constants, stiffness_damping);
            };
            return integrate(model, motion, run);
        };
        const History a = on(absorbing, spring), b = on(coupled, bed);
        ASSERT_EQ(a.rows.size(), b.rows.size()) << text_of(b.ending);
        double crest = 0.0;
        for (std::size_t k = 0; k < a.rows.size(); ++k)
            crest = std::max(crest, std::abs(a.rows[k].crest_x - b.rows[k].crest_x));
        EXPECT_LT(crest, 1e-5 * a.peak_crest_x);
        EXPECT_GT(a.peak_crest_x, 1e-4);
        EXPECT_LT(b.largest_imbalance, 1e-9);
        // what the coefficient takes is radiated water; what the floor takes is the rock's, which radiates it
        const Energy &of_a = a.rows.back().energy, &of_b = b.rows.back().energy;
        EXPECT_LT(std::abs(of_a.radiated - of_b.radiated), 1e-4 * of_a.radiated);
        EXPECT_EQ(of_a.floor, 0.0);
        EXPECT_GT(of_b.floor, 0.1 * of_b.radiated);
    }
}

// A dam that sticks everywhere is the dam tied to its base, by another integrator: energies and the work across the floor agree.
TEST(RockFloor, DamThatSticksIsTheTiedDam)
{
    Scene scene = dam_with_floor(50.0);
    scene.uplift.reset();
    RunOptions options = options_of(scene);
    scene.time.substeps = 0;
    options.uplift = {};
    const EarthquakeRun run(scene, options);
    const GroundMotion motion = sines(0.05, 4.0);
    const RunResult contact = run.run(motion);
    ASSERT_EQ(contact.status, Status::at_rest) << text_of(contact.notes);
    ASSERT_EQ(contact.max_slip, 0.0);

    const Model tied = build_model(scene);
    const FluidModel water = build_fluid(scene);
    const RadiatingRock rock =
        radiating_rock_of(scene, tied.mesh, tied.mesh.contact.rock_nodes, options.wave_frequency, {});
    EXPECT_EQ(rock.rock.floor, static_cast<Eigen::Index>(water.floor.size()));
    TiedRunOptions tied_options;
    tied_options.scheme = scheme_of(scene.time);
    tied_options.damping.constants = run.damping();
    tied_options.water = &water;
    tied_options.moving_base = [&](const StepConstants& constants, double stiffness_damping) {
        return rock_base(rock.rock, constants, stiffness_damping);
    };
    const History whole = integrate(tied, motion, tied_options);
    ASSERT_EQ(whole.status, TiedRunStatus::complete);
    double damping = 0.0, radiated = 0.0, floor = 0.0;
    for (std::size_t k = 0; k < whole.rows.size(); ++k) {
        const Energy &a = contact.history.energy[k], &b = whole.rows[k].energy;
        damping = std::max(damping, std::abs(a.damping - b.damping));
        radiated = std::max(radiated, std::abs(a.radiated - b.radiated));
        floor = std::max(floor, std::abs(a.floor - b.floor));
    }
    const Energy& end = whole.rows.back().energy;
    EXPECT_GT(end.floor, 0.01 * end.radiated);
    EXPECT_LT(damping, 1e-7 * end.radiated);
    EXPECT_LT(radiated, 1e-7 * end.radiated);
    EXPECT_LT(floor, 1e-7 * end.radiated);
    EXPECT_LT(contact.energy_error, 1e-10);
    EXPECT_LT(whole.largest_imbalance, 1e-10);
}

// While it slides the energy closes with what passes through the floor, in every scheme.
TEST(RockFloor, EnergyOfASlidingDamCloses)
{
    for (const FarEnd end : {FarEnd::absorbing, FarEnd::closed}) {
        Scene scene = dam_with_floor(0.70);
        scene.reservoir->far_end = end;
        scene.time.substeps = 0;
        const RunResult result = slide(scene, sines(1.0, 8.0));
        ASSERT_EQ(result.status, Status::at_rest) << text_of(result.notes);
        EXPECT_GT(result.slip, 0.01);
        EXPECT_LT(result.energy_error, 1e-10);
        EXPECT_EQ(result.counts.unresolved, 0);
        EXPECT_GT(result.history.energy.back().floor, 0.0);
        EXPECT_GT(result.counts.landings, 50); // impulses go through the floor too
    }
}

// Nothing shakes: nothing moves.
TEST(RockFloor, RestsWithoutAnEarthquake)
{
    GroundMotion still;
    still.dt = 0.01;
    still.accel_h.assign(201, 0.0);
    still.accel_v.assign(201, 0.0);
    const RunResult result = slide(dam_with_floor(0.77), still);
    EXPECT_LT(std::abs(result.slip), 1e-12);
    EXPECT_LT(std::abs(result.history.energy.back().floor), 1e-15); // J/m
}

// On rock of 1e6 GPa nothing gives way: the floor is rigid, α = 1, and the slip that of water on such a floor. The coefficient of that
// rock is 0.998.
TEST(RockFloor, OfRigidRockIsARigidFloor)
{
    const Scene coupled = dam_with_floor(0.70, 1e6 / 30.0);
    EXPECT_NEAR(rock_reflection(coupled), 0.998, 5e-4);
    const GroundMotion motion = sines(1.0, 6.0);
    const RunResult a = slide(coupled, motion), b = slide(with_reflection(coupled, 1.0), motion);
    ASSERT_EQ(a.status, b.status);
    EXPECT_GT(b.max_slip, 1e-3);
    const double difference = largest_difference(a.history.slip, b.history.slip);
    EXPECT_LT(difference, 0.01 * largest(b.history.slip));
}

// Boxes of other sizes.
TEST(RockFloor, DoesNotSeeTheBox)
{
    Scene scene = dam_with_floor(0.70);
    const GroundMotion motion = sines(1.0, 8.0);
    const double slip = slide(scene, motion).slip;
    for (const double size : {0.7, 1.4}) {
        scene.foundation->wave_box = size;
        EXPECT_NEAR(slide(scene, motion).slip, slip, 0.02 * slip) << size;
    }
}

} // namespace damslip::rock_tests
