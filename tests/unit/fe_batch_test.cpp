// Several runs in step, shared operators, and steps made in halves.
#include "verification/cases/fe_run_scenes.hpp"

#include <gtest/gtest.h>

namespace {

using namespace damslip;
using namespace damslip::fe2d;
using fe2d::test::options_of;
using fe2d::test::sines;
using fe2d::test::sliding_dam;

std::vector<Contact> frictions(std::initializer_list<double> values)
{
    std::vector<Contact> contacts(values.size());
    std::size_t i = 0;
    for (const double value : values) contacts[i++].friction = value;
    return contacts;
}

void expect_same(const RunResult& a, const RunResult& b)
{
    EXPECT_EQ(a.status, b.status);
    EXPECT_EQ(a.notes, b.notes);
    EXPECT_EQ(a.history.time, b.history.time);
    EXPECT_EQ(a.history.slip, b.history.slip);
    EXPECT_EQ(a.history.crest_x, b.history.crest_x);
    EXPECT_EQ(a.history.imbalance, b.history.imbalance);
    EXPECT_EQ(a.counts.contact_iterations, b.counts.contact_iterations);
    EXPECT_EQ(a.halvings, b.halvings);
    EXPECT_EQ(a.displacement, b.displacement);
}

// Seven frictions are groups of four, two and one in the factor; one fails statically and leaves the others in step.
TEST(FeBatch, RunsInStepHaveTheBitsOfSingleRuns)
{
    Scene scene = sliding_dam(0.77, 1.0, 5.0);
    RunOptions options = options_of(scene);
    scene.time.substeps = 0;
    const EarthquakeRun run(scene, options);
    const GroundMotion motion = sines(1.0, 6.0);
    const std::vector<Contact> contacts = frictions({0.9, 0.84, 0.77, 0.40, 0.74, 0.70, 0.68, 0.66});
    const std::vector<RunResult> together = run.run_all(motion, contacts);
    EXPECT_EQ(run.factorisations(), 1);
    ASSERT_EQ(together.size(), contacts.size());
    for (std::size_t i = 0; i < contacts.size(); ++i) expect_same(together[i], run.run(motion, contacts[i]));
    EXPECT_EQ(together[3].status, Status::static_failure);
    EXPECT_GT(together[7].slip, together[4].slip);
    EXPECT_EQ(run.factorisations(), 1); // the single runs took what was there
}

// Motions of other lengths, polarities and strengths in step: each ends when its own dam is at rest. One with samples twice as
// far apart has steps of another size and goes by itself.
TEST(FeBatch, MotionsInStepHaveTheBitsOfSingleRuns)
{
    Scene scene = sliding_dam(0.77, 1.0, 5.0);
    const EarthquakeRun run(scene, options_of(scene));
    const GroundMotion longer = sines(1.0, 6.0), shorter = sines(1.5, 3.0);
    GroundMotion flipped = longer, coarse = shorter;
    for (double& a : flipped.accel_h) a = -a;
    coarse.dt *= 2.0;
    const Contact firm = frictions({0.84}).front(), slippery = frictions({0.68}).front();
    const std::vector<Shaking> shakings{
        {&longer, slippery}, {&coarse, firm}, {&shorter, firm}, {&flipped, slippery}, {&longer, firm}};
    const std::vector<RunResult> together = run.run_all(shakings);
    ASSERT_EQ(together.size(), shakings.size());
    for (std::size_t i = 0; i < shakings.size(); ++i) {
        SCOPED_TRACE(i);
        expect_same(together[i], run.run(*shakings[i].motion, shakings[i].contact));
    }
    EXPECT_NE(together[0].slip, together[3].slip);
    EXPECT_LT(together[2].end_time, together[0].end_time);
    EXPECT_EQ(together[1].history.time[1], 2.0 * together[2].history.time[1]);
}

// Two sequences come to rest at times of their own, and so play their second records at times of their own.
TEST(FeBatch, SequencesInStepHaveTheBitsOfSingleRuns)
{
    Scene scene = sliding_dam(0.77, 1.0, 5.0);
    RunOptions options = options_of(scene);
    scene.time.substeps = 0;
    const EarthquakeRun run(scene, options);
    GroundMotion sequence = sines(1.0, 4.0);
    const std::size_t half = sequence.accel_h.size() / 2;
    sequence.events = {{"first", 0}, {"second", half}};
    const std::vector<Contact> contacts = frictions({0.84, 0.66});
    const std::vector<RunResult> together = run.run_all(sequence, contacts);
    for (std::size_t i = 0; i < contacts.size(); ++i) {
        const RunResult alone = run.run(sequence, contacts[i]);
        expect_same(together[i], alone);
        ASSERT_EQ(together[i].events.size(), 2U);
        EXPECT_EQ(together[i].events[1].start, alone.events[1].start);
    }
    EXPECT_NE(together[0].events[1].start, together[1].events[1].start);
}

// Runs that need more sub-steps go on without the others; every step size is factorised once for all.
TEST(FeBatch, StepSizesAreSharedByAllFrictions)
{
    const Scene scene = sliding_dam(0.77, 1.0, 5.0);
    const EarthquakeRun run(scene, options_of(scene));
    const GroundMotion motion = sines(1.0, 5.0);
    const std::vector<Contact> contacts = frictions({0.84, 0.70, 0.66});
    const std::vector<RunResult> together = run.run_all(motion, contacts);
    int largest = 0;
    for (std::size_t i = 0; i < contacts.size(); ++i) {
        expect_same(together[i], run.run(motion, contacts[i]));
        largest = std::max(largest, together[i].halvings);
    }
    EXPECT_GT(largest, 0);
    EXPECT_LE(run.factorisations(), largest + 1); // some sizes may have been left out
}

TEST(FeBatch, FarSlidingLanesKeepTheirOwnPlaces)
{
    Scene scene = sliding_dam(0.77, 1.0, 5.0);
    RunOptions options = options_of(scene);
    scene.time.substeps = 0;
    scene.contact.sliding = JointPath::finite;
    const EarthquakeRun run(scene, options);
    const GroundMotion motion = sines(2.0, 4.0);
    const std::vector<Contact> contacts = frictions({0.77, 0.66});
    const std::vector<RunResult> together = run.run_all(motion, contacts);
    for (std::size_t i = 0; i < contacts.size(); ++i) expect_same(together[i], run.run(motion, contacts[i]));
    EXPECT_GT(together[1].slip, 0.05); // beyond the share of an element after which the pairing is made anew
}

/// A run of the first seconds with contact options of its own, from a static state that has the usual ones.
DynamicContact shaken(const EarthquakeRun& run, const Scene& scene, const RunOptions& options,
                      const GroundMotion& motion, const ContactOptions& contact)
{
    const ContactStructure& structure = run.structure();
    StaticContact statics(structure);
    Contact shut = scene.contact;
    shut.separation = JointOpening::none; // Lemke's method, which always ends, is for joints that open
    Strength strength(shut, structure.plane());
    ContactMemory memory(structure.pairs());
    run.statics(statics, strength, memory);
    const SplitLoad load = structure.split(load_stages(scene, run.model(), options.uplift).last());
    DynamicContact dynamics(structure, {run.damping(), scene.damping.mass}, scheme_of(scene.time), load,
                            statics.displacements(load, memory), memory, {}, contact);
    for (std::size_t k = 1; k < motion.accel_h.size(); ++k)
        dynamics.advance(motion.dt, {motion.accel_h[k], motion.accel_v[k]}, strength.law());
    return dynamics;
}

// An iteration that is cut off after three solutions does not resolve every step; halves of it, in which fewer pairs
// change, it does. What is made in halves is an ordinary run of unequal steps: its energy closes as any other's.
TEST(FeBatch, StepsThatAreNotResolvedAreMadeInHalves)
{
    const Scene scene = sliding_dam(0.70, 1.0, 5.0);
    const RunOptions options = options_of(scene);
    const EarthquakeRun run(scene, options);
    const GroundMotion motion = sines(1.0, 6.0);
    ContactOptions hasty;
    hasty.landing = Landing::ringing; // more changes of state
    hasty.newton_iterations = 3;
    hasty.switches_per_pair = 0;
    hasty.gauss_seidel_sweeps = 0;
    ContactOptions patient;
    patient.landing = Landing::ringing;
    const DynamicContact whole = shaken(run, scene, options, motion, patient),
                         cut = shaken(run, scene, options, motion, hasty);
    EXPECT_EQ(whole.counts().halved, 0);
    EXPECT_EQ(whole.counts().unresolved, 0);
    EXPECT_GT(cut.counts().halved, 0);
    EXPECT_EQ(cut.counts().steps, whole.counts().steps + cut.counts().halved);
    EXPECT_EQ(cut.counts().unresolved, 0); // not in vain
    EXPECT_NEAR(cut.state().time, whole.state().time, 1e-9);
    EXPECT_LT(std::abs(cut.energy_imbalance()), 1e-10 * cut.energy_scale());
    const Eigen::MatrixXd& weights = run.structure().planes().weights();
    const double expected = weights.col(0).dot(whole.state().contact.slip);
    EXPECT_NEAR(weights.col(0).dot(cut.state().contact.slip), expected, 0.05 * expected); // error of steps of 0.01 s
}

} // namespace
