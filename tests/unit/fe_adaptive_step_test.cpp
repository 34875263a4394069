// Sub-steps where the local error asks for them, against sub-steps all alike.
#include "verification/cases/fe_run_scenes.hpp"

#include <gtest/gtest.h>

namespace damslip::fe2d {
namespace {

using test::options_of;
using test::sines;
using test::sliding_dam;

/// Strong shaking for a third of the time, a twentieth of it after that.
GroundMotion with_coda()
{
    GroundMotion motion = sines(1.2, 12.0);
    for (std::vector<double>* a : {&motion.accel_h, &motion.accel_v})
        for (std::size_t i = a->size() / 3; i < a->size(); ++i) (*a)[i] *= 0.05;
    return motion;
}

Scene adaptive(Scene scene)
{
    scene.time.stepping = Stepping::adaptive;
    return scene;
}

// The estimate holds: the slip is within the wanted 1 % of that of steps of dt/64, which err by a tenth of it at most.
// Level k halves no step more often than k times, so it makes no more steps than steps of dt/2^k. A third of this
// record wants dt/4; with whole steps after it that is 1/3 + 2/3 / 4 = 0.5 of all steps dt/4, and the dam rings on for a while.
TEST(FeAdaptiveStep, CostsFewerStepsAndKeepsTheAccuracy)
{
    const Scene scene = sliding_dam(0.75);
    const GroundMotion motion = with_coda();
    Scene fine = scene;
    fine.time.substeps = 6;
    const RunOptions options = options_of(scene);
    const double exact = EarthquakeRun(fine, options).run(motion).slip;
    const RunResult r = EarthquakeRun(adaptive(scene), options).run(motion);
    ASSERT_EQ(r.status, Status::at_rest) << text_of(r.notes);
    EXPECT_GT(exact, 0.01);
    EXPECT_GT(r.halvings, 1);
    EXPECT_NEAR(r.slip, exact, 0.011 * exact);
    EXPECT_LT(r.slip_error, 0.01 * exact);
    EXPECT_LT(r.energy_error, 1e-10);
    EXPECT_GT(r.counts.refined, 0);
    const double alike = r.end_time / motion.dt * (1 << r.halvings);
    EXPECT_LT(r.counts.steps, 0.7 * alike);
    EXPECT_NEAR(r.dt, r.end_time / r.counts.steps, 1e-12);
}

// In lockstep each strength refines its own steps: the bits of single runs.
TEST(FeAdaptiveStep, LockstepGivesTheBitsOfSingleRuns)
{
    const Scene scene = sliding_dam(0.75, 1.0, 5.0);
    const GroundMotion motion = sines(1.2, 4.0);
    const EarthquakeRun run(adaptive(scene), options_of(scene));
    std::vector<Contact> contacts(2, scene.contact);
    contacts[1].friction = 0.9;
    const std::vector<RunResult> together = run.run_all(motion, contacts);
    for (std::size_t i = 0; i < contacts.size(); ++i) {
        const RunResult alone = run.run(motion, contacts[i]);
        EXPECT_EQ(together[i].slip, alone.slip);
        EXPECT_EQ(together[i].counts.steps, alone.counts.steps);
        EXPECT_EQ(together[i].history.slip, alone.history.slip);
    }
}

} // namespace
} // namespace damslip::fe2d
