// The reduced run against the full one.
#include "core/file.hpp"
#include "fe2d/reduction/reduced_run.hpp"
#include "fe2d/run/earthquake_pass.hpp"
#include "scene/rock_mass.hpp"
#include "verification/cases/fe_run_scenes.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <cmath>
#include <complex>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <unistd.h>

namespace {

using namespace damslip;
using namespace damslip::fe2d;
using Eigen::VectorXd;
using fe2d::test::options_of;
using fe2d::test::sines;
using fe2d::test::sliding_dam;

Scene small_dam(double friction)
{
    Scene scene = sliding_dam(friction, 1.0, 5.0);
    scene.mesh.size = 8.0;
    return scene;
}

// With all modes nothing is left out: the same equations in other coordinates. Contact is non-smooth, but as long as
// no pair switches in another step, differences stay at the round-off of dense eigenvectors, 1e-12 of the motion a step
// at worst; 1e-9 of the slip after 850 steps is asked for.
void expect_full_run(const Scene& scene, const RunOptions& options, double pga = 1.5)
{
    const GroundMotion motion = sines(pga, 8.0);
    const EarthquakeRun full(scene, options);
    const RunResult expected = full.run(motion);
    const ReducedRun reduced(full, scene, options, 100000);
    const RunResult result = reduced.run(motion);
    ASSERT_EQ(result.modes + 3, full.structure().dam_unknowns());
    ASSERT_GT(std::abs(expected.slip), 1e-3);
    EXPECT_EQ(result.truncation_error, 0.0);
    EXPECT_EQ(result.status, expected.status);
    EXPECT_EQ(result.counts.steps, expected.counts.steps);
    EXPECT_EQ(result.counts.unresolved, 0);
    const double slip = std::abs(expected.slip), force = expected.history.normal_force[0];
    ASSERT_EQ(result.history.time.size(), expected.history.time.size());
    EXPECT_LT(fe2d::largest_difference(result.history.slip, expected.history.slip), 1e-9 * slip);
    EXPECT_LT(fe2d::largest_difference(result.history.crest_x, expected.history.crest_x), 1e-9 * slip);
    EXPECT_LT(fe2d::largest_difference(result.history.normal_force, expected.history.normal_force), 1e-8 * force);
    EXPECT_LT(fe2d::largest_difference(result.history.shear_force, expected.history.shear_force), 1e-8 * force);
    EXPECT_NEAR(result.after.open_length, expected.after.open_length, 1e-9);
}

TEST(FeReduction, all_modes_are_the_full_run)
{
    Scene scene = small_dam(0.75);
    RunOptions options = options_of(scene);
    scene.time.substeps = 0;
    expect_full_run(scene, options);
    scene.damping.mass = MassDamping::relative;
    expect_full_run(scene, options);
}

TEST(FeReduction, all_modes_are_the_full_run_with_penalty_and_substeps)
{
    Scene scene = small_dam(0.75);
    RunOptions options = options_of(scene);
    scene.time.substeps = 1;
    scene.contact.enforcement = ContactEnforcement::penalty;
    scene.contact.tangential_stiffness = 1e10;
    expect_full_run(scene, options);
}

// Friction that falls with the rate and lags behind it, by a time or by a slip.
TEST(FeReduction, all_modes_are_the_full_run_with_friction_over_the_rate)
{
    Scene scene = small_dam(0.75);
    RunOptions options = options_of(scene);
    scene.time.substeps = 1;
    for (const RateFriction& rate : {RateFriction{0.9, 0.05, 0.1, {}}, RateFriction{0.9, 0.05, {}, 0.005}}) {
        scene.contact.rate = rate;
        expect_full_run(scene, options);
    }
}

// Without rock nothing is soft beside the modes: F_s = 0, and is never inverted. Weaker motion, because an undamped
// rigid base makes the dam bounce above 1 m/s²: then a change of 1e-13 of the motion changes the full run's slip by 1 %.
TEST(FeReduction, all_modes_are_the_full_run_on_a_rigid_base)
{
    Scene scene = small_dam(0.75);
    scene.foundation.reset();
    scene.curtain.reset();
    RunOptions options = options_of(scene);
    scene.time.substeps = 0;
    expect_full_run(scene, options, 0.8);
}

// A run stopped while its error is being estimated is not finished: its error would be that of a slip that was not
// reached. Stopped at every hundredth question, the last one included.
TEST(FeReduction, stopped_at_any_moment_it_is_interrupted)
{
    Scene scene = small_dam(0.75);
    RunOptions options = options_of(scene);
    scene.time.substeps = 0;
    const EarthquakeRun full(scene, options);
    const GroundMotion motion = sines(1.5, 2.0);
    long asked = 0, stop_at = 0;
    options.progress = [&](const RunProgress&) { return ++asked == stop_at ? RunAnswer::stop : RunAnswer::go_on; };
    const ReducedRun reduced(full, scene, options, 6);
    EXPECT_NE(reduced.run(motion).status, Status::interrupted);
    const long all = asked;
    ASSERT_GT(all, 4 * 200); // one run and three for its error
    for (stop_at = all; stop_at > 0; stop_at -= 100) {
        asked = 0;
        EXPECT_EQ(reduced.run(motion).status, Status::interrupted) << stop_at << " of " << all;
    }
}

// φᵀMφ = 1 and the flexibility of all modes together: what is kept and what is left out add up to the same whole.
TEST(FeReduction, kept_and_residual_flexibility_add_up)
{
    const Scene scene = small_dam(0.75);
    const EarthquakeRun full(scene, options_of(scene));
    const DamModes all = dam_modes(full.structure(), 100000), some = dam_modes(full.structure(), 12);
    ASSERT_TRUE(all.regular && some.regular);
    const DamModes cut = all.first(15);
    EXPECT_LT((some.omega2 - cut.omega2).cwiseAbs().maxCoeff(), 1e-7 * cut.omega2[14]);
    // The shift of 1e-3 of the first ω² leaves a share of 1e-3 ω_1²/ω_13² of the residual, about 1e-4.
    EXPECT_LT((some.residual - cut.residual).norm(), 3e-4 * cut.residual.norm());
    EXPECT_LT((some.residual_crest - cut.residual_crest).norm(), 3e-4 * cut.residual_crest.norm());
}

/// A small dam beside acoustic water, on massless rock where nothing else is said.
Scene wet_dam(double friction)
{
    Scene scene = small_dam(friction);
    scene.reservoir->model = ReservoirModel::acoustic;
    scene.reservoir->length = 62.5;
    scene.time.substeps = 0;
    return scene;
}

Scene on_radiating_rock(Scene scene, ReservoirFloor floor)
{
    scene = with_radiating_rock(std::move(scene));
    scene.reservoir->floor = floor;
    return scene;
}

/// Reduced against full runs at every friction and both polarities, twelve modes: at any time within the estimate of what the
/// modes leave out and 1 % of the slip for the water, whose reduction has a gate of 2 % of the pressures. Measured: up to
/// 0.9 % (friction 0.85 on massless rock, 0.3 mm, as far apart as two finer bases are), most below 0.1 %.
void expect_slips_of_full_runs(const Scene& scene)
{
    const RunOptions options = options_of(scene);
    const EarthquakeRun full(scene, options);
    const ReducedRun reduced(full, scene, options);
    const GroundMotion motion = sines(1.5, 8.0);
    for (const double friction : {0.70, 0.75, 0.85, 1.0})
        for (const GroundMotion& ground : {motion, test::flipped(motion)}) {
            Contact contact = scene.contact;
            contact.friction = friction;
            const RunResult expected = full.run(ground, contact);
            const RunResult result = reduced.run(ground, contact);
            ASSERT_EQ(result.status, expected.status) << text_of(result.notes) << text_of(expected.notes);
            ASSERT_EQ(result.modes, default_modes);
            EXPECT_GT(expected.max_slip, 1e-4) << friction;
            EXPECT_LT(fe2d::largest_difference(result.history.slip, expected.history.slip),
                      result.truncation_error + 0.01 * expected.max_slip)
                << friction << ", slip " << expected.slip;
            EXPECT_LT(result.truncation_error, 0.02 * expected.max_slip);
        }
}

TEST(FeReduction, acoustic_water_slides_as_the_full_run)
{
    expect_slips_of_full_runs(wet_dam(0.75));
}

TEST(FeReduction, acoustic_water_of_every_end_and_surface)
{
    for (const FarEnd end : {FarEnd::damper, FarEnd::closed}) {
        Scene scene = wet_dam(0.75);
        scene.reservoir->far_end = end;
        if (end == FarEnd::damper) scene.reservoir->surface = WaterSurface::sloshing;
        expect_slips_of_full_runs(scene);
    }
}

TEST(FeReduction, acoustic_water_on_radiating_rock)
{
    expect_slips_of_full_runs(on_radiating_rock(wet_dam(0.75), ReservoirFloor::absorbing));
}

// The floor's pressures move the rock, and with it the base.
TEST(FeReduction, acoustic_water_whose_floor_is_the_rock)
{
    const Scene scene = on_radiating_rock(wet_dam(0.75), ReservoirFloor::rock);
    ASSERT_GT(EarthquakeRun(scene, options_of(scene)).structure().floor_nodes(), 0);
    expect_slips_of_full_runs(scene);
}

// Energy may leave the reduced water and never comes: what a moving face finds, force over rate, has a Hermitian part without negative
// values at every frequency. Pressures and momenta of the layers reduced each by itself had -2e-3 to -1e-2 of the largest, and dams
// flew away. (Above a bottom that reflects everything the layers of the mesh give some 1e-5 to fields that decay, near the cut-offs.)
TEST(FeReduction, reduced_water_is_passive)
{
    for (const double reflection : {0.75, 0.2}) {
        Scene scene = wet_dam(0.75);
        scene.reservoir->bottom_reflection = reflection;
        const EarthquakeRun full(scene, options_of(scene));
        const DamModes modes = dam_modes(full.structure(), 12);
        const ReducedWater water = reduce_water(*full.water(), modes.face, 160.0);
        EXPECT_TRUE(water.report.passed()) << text_of(water.missed_gate());
        EXPECT_LT(water.count(), water.report.unknowns / 2);
        EXPECT_GT(water.layers, 0);
        EXPECT_EQ(water.face.rightCols(water.layers).norm(), 0.0);
        const Eigen::MatrixXcd shapes = modes.face * water.face;
        double largest = 0.0, least = 0.0;
        for (double omega = 2.0; omega < 3000.0; omega *= 1.03) {
            const std::complex<double> s(0.0, omega);
            const Eigen::MatrixXcd matrix = water.stiffness + s * water.damping + (s * s) * water.mass,
                                   impedance = -s * shapes * matrix.partialPivLu().solve(shapes.transpose()),
                                   loss = 0.5 * (impedance + impedance.adjoint());
            largest = std::max(largest, impedance.norm());
            least = std::min(least, Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd>(loss).eigenvalues()[0]);
        }
        EXPECT_GT(least, -1e-8 * largest) << reflection;
    }
}

// A gate that no basis meets: the report says so, with what to do.
TEST(FeReduction, water_that_misses_its_gate_says_so)
{
    const Scene scene = wet_dam(0.75);
    const EarthquakeRun full(scene, options_of(scene));
    WaterReductionOptions strict;
    strict.wanted = 1e-9;
    strict.largest_rounds = 2;
    const ReducedWater water = reduce_water(*full.water(), dam_modes(full.structure(), 12).face, 160.0, strict);
    EXPECT_FALSE(water.report.passed());
    EXPECT_EQ(water.report.rounds, 2);
    EXPECT_NE(text_of(water.missed_gate()).find("are allowed: run without --reduced."), std::string::npos);
}

/// Between the mark and the numbers of a file of RockStore: its length in 8 bytes, then the key, which begins "2 nu".
std::string key_of_file(const std::string& bytes)
{
    const std::size_t at = bytes.find(" nu ") - 1;
    std::uint64_t size = 0;
    std::memcpy(&size, bytes.data() + at - sizeof size, sizeof size);
    return bytes.substr(at, size);
}

// A reduction that missed its gate, as a store may hold one: full and reduced runs give no slip and say the same of it.
TEST(FeReduction, rock_that_missed_its_gate_gives_no_slip)
{
    namespace fs = std::filesystem;
    const fs::path folder = fs::temp_directory_path() / ("damslip-gate-" + std::to_string(::getpid()));
    fs::remove_all(folder);
    Scene scene = with_radiating_rock(small_dam(0.75));
    scene.time.substeps = 0;
    RunOptions options = options_of(scene);
    options.rock_cache = folder;
    const GroundMotion motion = sines(1.5, 2.0);
    {
        const EarthquakeRun full(scene, options);
        EXPECT_EQ(text_of(full.why_not()), "");
        EXPECT_EQ(ReducedRun(full, scene, options).run(motion).status, Status::at_rest);
    }
    const fs::path file = fs::directory_iterator(folder)->path();
    const std::string bytes = read_file(file), key = key_of_file(bytes);
    std::optional<ReducedRock> rock = from_bytes(bytes, key);
    ASSERT_TRUE(rock);
    rock->report.error = 0.05;
    write_file(file, to_bytes(*rock, key));

    const EarthquakeRun full(scene, options);
    ASSERT_EQ(full.radiating()->origin, RockOrigin::kept);
    const RunResult run = full.run(motion);
    const RunResult reduced = ReducedRun(full, scene, options).run(motion);
    EXPECT_EQ(run.status, Status::not_resolved);
    EXPECT_EQ(text_of(run.notes), "The radiating rock's reduction errs by 5 %, 2 % are allowed: give a smaller "
                           "foundation.wave_frequency_Hz.");
    EXPECT_EQ(reduced.status, run.status);
    EXPECT_EQ(text_of(reduced.notes), text_of(run.notes));
    EXPECT_FALSE(reported(reduced.status, reduced.slip).has_value());
    fs::remove_all(folder);
}

/// Whoever asks on which side of a limit the slip lies gets it from longer steps, except near the limit, and with an error that is true.
TEST(SlipLimits, AreAnsweredByAsManyHalvingsAsTheSideTakes)
{
    const Scene scene = small_dam(0.65);
    const GroundMotion motion = sines(2.5, 8.0);
    RunOptions options = options_of(scene);
    const EarthquakeRun usual(scene, options);
    const RunResult full = usual.run(motion), few = ReducedRun(usual, scene, options).run(motion);
    ASSERT_EQ(full.status, Status::at_rest);
    ASSERT_GT(full.halvings, 1);
    EXPECT_DOUBLE_EQ(allowed_error(scene, options, full.slip, full.max_slip), scene.time.slip_tolerance * full.max_slip);
    for (const double limit : {0.1, 1.0 + 1e-4, 2.0}) { // of the slip
        options.slip_limits = {limit * full.max_slip};
        const EarthquakeRun asked(scene, options);
        for (const bool reduced : {false, true}) {
            const RunResult run = reduced ? ReducedRun(asked, scene, options).run(motion) : asked.run(motion);
            const RunResult& fine = reduced ? few : full;
            ASSERT_EQ(run.status, Status::at_rest);
            EXPECT_EQ(run.max_slip > options.slip_limits[0], fine.max_slip > options.slip_limits[0]) << limit << reduced;
            EXPECT_LE(std::abs(run.slip - fine.slip), run.slip_error);
            EXPECT_LE(run.slip_error, allowed_error(scene, options, run.slip, run.max_slip));
            if (std::abs(limit - 1.0) < 0.01)
                EXPECT_EQ(run.slip, fine.slip);
            else
                EXPECT_LT(run.halvings, fine.halvings);
        }
    }
}

/// Against steps much shorter than those that correct: the error is that of the slip, and no estimate of itself.
TEST(CorrectedRun, IsWithinItsErrorOfMuchSmallerSteps)
{
    int corrected = 0;
    for (const double friction : {0.65, 0.8})
        for (const double pga : {1.5, 2.5}) {
            const Scene scene = small_dam(friction);
            RunOptions options = options_of(scene);
            options.corrector = corrected_run;
            const EarthquakeRun full(scene, options);
            const GroundMotion motion = sines(pga, 8.0);
            const RunResult run = full.run(motion);
            if (!run.correction) continue;
            ++corrected;
            const RunResult fine = full.run_at(motion, {5, {}});
            EXPECT_LE(std::abs(run.slip - fine.slip), run.slip_error) << friction << " " << pga;
            EXPECT_LE(run.slip_error, scene.time.slip_tolerance * run.max_slip);
            // The same slip everywhere.
            EXPECT_EQ(run.history.slip.back(), run.slip);
            EXPECT_NEAR(full.structure().plane().weights().dot(run.pair_slip), run.slip, 1e-12);
            EXPECT_NEAR(run.run_out.slip_shaking + run.run_out.slip_at_rest, run.slip, 1e-12);
            EXPECT_GE(run.max_slip, std::abs(run.slip));
            EXPECT_NEAR(run.after.slip - full.run_at(motion, {run.halvings, {}}).after.slip, run.correction->slip, 1e-12);
        }
    EXPECT_GE(corrected, 2);
}

/// Where runs on few modes do not settle within the tolerance, the run is that of halved steps, bit for bit.
TEST(CorrectedRun, HalvesWhatItCannotCorrect)
{
    Scene scene = small_dam(0.75);
    scene.time.slip_tolerance = 1e-5;
    RunOptions options = options_of(scene);
    options.largest_halvings = 3;
    options.corrector = corrected_run;
    const EarthquakeRun full(scene, options);
    const GroundMotion motion = sines(1.5, 4.0);
    const Shaking shaking{&motion, scene.contact};
    const RunResult run = full.run(motion), halved = full.run_halved({&shaking, 1}).front();
    EXPECT_FALSE(run.correction);
    EXPECT_EQ(run.slip, halved.slip);
    EXPECT_EQ(run.slip_error, halved.slip_error);
    EXPECT_EQ(run.status, halved.status);
}

/// Runs that go in step: some corrected, one that cannot be.
TEST(CorrectedRun, HasTheSameBitsAloneAndBesideOthers)
{
    const Scene scene = small_dam(0.65);
    RunOptions options = options_of(scene);
    options.corrector = corrected_run;
    const EarthquakeRun full(scene, options);
    const GroundMotion weak = sines(1.5, 6.0), strong = sines(2.5, 6.0);
    Contact firm = scene.contact, loose = scene.contact;
    firm.friction = 0.9;
    loose.friction = 0.05; // does not stand
    const std::vector<Shaking> shakings{{&weak, scene.contact}, {&strong, firm}, {&weak, loose}, {&strong, scene.contact}};
    const std::vector<RunResult> together = full.run_all(shakings);
    ASSERT_EQ(together.size(), shakings.size());
    int corrected = 0;
    for (std::size_t i = 0; i < shakings.size(); ++i) {
        const RunResult alone = full.run(*shakings[i].motion, shakings[i].contact);
        EXPECT_EQ(together[i].status, alone.status) << i;
        EXPECT_EQ(together[i].slip, alone.slip) << i;
        EXPECT_EQ(together[i].correction.has_value(), alone.correction.has_value()) << i;
        EXPECT_TRUE(together[i].slip_error == alone.slip_error || std::isnan(alone.slip_error)) << i;
        corrected += alone.correction.has_value();
    }
    EXPECT_GE(corrected, 2);
    EXPECT_TRUE(fails_statically(together[2].status));
}

} // namespace
