// Sliding runs with acoustic water.
#include "fe2d/time/structure_system.hpp"
#include "fe2d/time/integrate.hpp"
#include "verification/cases/fe_run_scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {

using namespace damslip;
using namespace damslip::fe2d;
using fe2d::test::options_of;
using fe2d::test::sines;
using fe2d::test::sliding_dam;

Scene acoustic_dam(double friction, FarEnd end = FarEnd::absorbing)
{
    Scene scene = sliding_dam(friction, 1.0, 5.0);
    scene.reservoir->model = ReservoirModel::acoustic;
    scene.reservoir->length = 62.5;
    scene.reservoir->far_end = end;
    return scene;
}

// A dam that sticks everywhere is a dam tied to its base: the run of the whole coupled matrix by another integrator, with
// its own factorisation and order, loses the same energy to damping and radiation, step by step: both are quadratic in the
// velocities of dam and water, to which round-off of the static displacements comes, some 1e2 times the dynamic ones.
TEST(FeWaterRun, DamThatSticksIsTheTiedDam)
{
    for (const FarEnd end : {FarEnd::absorbing, FarEnd::damper, FarEnd::closed}) {
        Scene scene = acoustic_dam(50.0, end);
        scene.uplift.reset(); // nothing opens under a small shaking
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
        TiedRunOptions tied_options;
        tied_options.scheme = scheme_of(scene.time);
        tied_options.damping = damping_of(scene, tied, water, motion);
        tied_options.water = &water;
        const History whole = integrate(tied, motion, tied_options);
        ASSERT_EQ(whole.status, TiedRunStatus::complete);
        const double mass = tied_options.damping.constants.mass; // the run's by modes on condensed rock: the same sums in another order
        EXPECT_NEAR(run.damping().mass, mass, 1e-12 * mass);
        double damping = 0.0, radiated = 0.0;
        for (std::size_t k = 0; k < whole.rows.size(); ++k) {
            const Energy &a = contact.history.energy[k], &b = whole.rows[k].energy;
            damping = std::max(damping, std::abs(a.damping - b.damping));
            radiated = std::max(radiated, std::abs(a.radiated - b.radiated));
        }
        const Energy& end = whole.rows.back().energy;
        EXPECT_GT(end.damping, 1.0);
        EXPECT_LT(damping, 1e-9 * end.damping);
        EXPECT_LT(radiated, 1e-9 * end.damping);
        EXPECT_LT(contact.energy_error, 1e-10);
    }
}

// While it slides the energy closes too, radiation included.
TEST(FeWaterRun, EnergyOfASlidingDamCloses)
{
    for (const FarEnd end : {FarEnd::absorbing, FarEnd::damper, FarEnd::closed}) {
        Scene scene = acoustic_dam(0.70, end);
        if (end == FarEnd::closed) scene.reservoir->bottom_reflection = 1.0; // nothing leaves
        RunOptions options = options_of(scene);
        scene.time.substeps = 0;
        const RunResult result = EarthquakeRun(scene, options).run(sines(1.0, 8.0));
        ASSERT_EQ(result.status, Status::at_rest) << text_of(result.notes);
        EXPECT_GT(result.slip, 0.01);
        EXPECT_LT(result.energy_error, 1e-10);
        EXPECT_EQ(result.counts.unresolved, 0);
        const double radiated = result.history.energy.back().radiated;
        if (end == FarEnd::closed)
            EXPECT_EQ(radiated, 0.0);
        else
            EXPECT_GT(radiated, 0.0);
    }
}

// On a rigid base, which nodes with mass hit, contact impulses go into the water too: the ledger knows them.
TEST(FeWaterRun, EnergyClosesWithLandingsOnARigidBase)
{
    Scene scene = acoustic_dam(0.70);
    scene.foundation.reset();
    scene.curtain.reset();
    scene.damping.ratio = 0.05;
    RunOptions options = options_of(scene);
    for (const int halvings : {0, 2}) {
        scene.time.substeps = halvings;
        const RunResult result = EarthquakeRun(scene, options).run(sines(1.0, 6.0));
        EXPECT_GT(result.counts.landings, 50);
        EXPECT_LT(result.energy_error, 1e-10);
        EXPECT_GT(std::abs(result.slip), 1e-3);
        EXPECT_LT(result.history.energy.back().contact_normal, 0.01 * result.history.energy.back().friction);
    }
}

// Without a reservoir nothing of it is there.
TEST(FeWaterRun, DryDamHasNoWaterUnknowns)
{
    Scene scene = acoustic_dam(0.77);
    scene.reservoir.reset();
    const EarthquakeRun run(scene, options_of(scene));
    EXPECT_EQ(run.water(), nullptr);
    EXPECT_EQ(run.structure().dam_unknowns(), 2 * run.model().mesh.dam_node_count);
}

} // namespace
