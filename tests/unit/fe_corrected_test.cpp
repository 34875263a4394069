// The full run on large steps, corrected by runs on few modes.
#include "fe2d/reduction/corrected_run.hpp"
#include "verification/cases/fe_run_scenes.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace damslip;
using namespace damslip::fe2d;
using fe2d::test::options_of;
using fe2d::test::sines;
using fe2d::test::sliding_dam;

Scene small_dam(double friction)
{
    Scene scene = sliding_dam(friction, 1.0, 5.0);
    scene.mesh.size = 8.0;
    return scene;
}

/// Against steps much shorter than those that correct: the error is that of the slip, and no estimate of itself.
TEST(CorrectedRun, IsWithinItsErrorOfMuchSmallerSteps)
{
    int corrected = 0;
    for (const double friction : {0.65, 0.8})
        for (const double pga : {1.5, 2.5}) {
            const Scene scene = small_dam(friction);
            const RunOptions options = options_of(scene);
            const EarthquakeRun full(scene, options);
            const GroundMotion motion = sines(pga, 8.0);
            const RunResult run = CorrectedRun(full, scene, options).run(motion);
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
    const EarthquakeRun full(scene, options);
    const GroundMotion motion = sines(1.5, 4.0);
    const RunResult run = CorrectedRun(full, scene, options).run(motion), halved = full.run(motion);
    EXPECT_FALSE(run.correction);
    EXPECT_EQ(run.slip, halved.slip);
    EXPECT_EQ(run.slip_error, halved.slip_error);
    EXPECT_EQ(run.status, halved.status);
}

} // namespace
