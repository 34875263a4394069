// The staged run as a whole.
#include "core/input_error.hpp"
#include "verification/cases/fe_run_scenes.hpp"

#include "scene/scene_text.hpp"
#include "sliding/block/rigid_block.hpp"
#include "sliding/block/slide.hpp"
#include "sliding/equilibrium/base_state.hpp"

#include <gtest/gtest.h>

namespace {

using namespace damslip;
using namespace damslip::fe2d;
using Eigen::VectorXd;
using fe2d::test::flipped;
using fe2d::test::options_of;
using fe2d::test::sines;
using fe2d::test::sliding_dam;

Contact with_friction(double friction)
{
    Contact contact;
    contact.friction = friction;
    return contact;
}

GroundMotion silence(double duration, double dt)
{
    GroundMotion motion;
    motion.dt = dt;
    motion.accel_h.assign(static_cast<std::size_t>(std::lround(duration / dt)) + 1, 0.0);
    return motion;
}

GroundMotion scaled(GroundMotion motion, double factor)
{
    for (auto* a : {&motion.accel_h, &motion.accel_v})
        for (double& value : *a) value *= factor;
    return motion;
}

// Every stage carries exactly the loads: Σλ = resultants (round-off), and friction that holds = |T|/N' from the
// resultants, which is also the mu at which the rigid block's yield acceleration is zero.
TEST(FeRun, stages_are_in_equilibrium_and_know_the_friction_that_holds)
{
    const Scene scene = sliding_dam(0.77);
    const EarthquakeRun run(scene, options_of(scene));
    const RunResult result = run.run(silence(0.5, 0.01));
    ASSERT_EQ(result.stages.size(), 3u);
    for (const StageResult& stage : result.stages) {
        EXPECT_EQ(stage.status, StageStatus::ok) << text_of(stage.notes());
        EXPECT_LT(stage.contact.residual, 1e-12);
    }
    const BaseResultant& base = result.stages.back().resultant;
    EXPECT_NEAR(result.history.normal_force[0], base.normal_force, 1e-9 * base.normal_force);
    EXPECT_NEAR(result.history.shear_force[0], base.shear_force, 1e-9 * base.normal_force);
    const sliding::RigidBlock block = sliding::make_rigid_block(scene);
    EXPECT_NEAR(base.shear_force, block.horizontal_force, 1e-10 * base.shear_force);
    const double expected = block.horizontal_force / (block.mass * block.gravity + block.vertical_force - block.uplift);
    EXPECT_NEAR(result.stages.back().critical_friction, expected, 1e-9);

    const RunResult fails = run.run(silence(0.5, 0.01), with_friction(expected - 1e-5));
    EXPECT_EQ(fails.status, Status::static_failure);
    EXPECT_NE(text_of(fails.notes).find("slides without any earthquake"), std::string::npos) << text_of(fails.notes);
    EXPECT_TRUE(fails.history.time.empty());
    EXPECT_NE(run.run(silence(0.5, 0.01), with_friction(expected + 1e-4)).status, Status::static_failure);
}

// Displacements counted from the end of the gravity stage: the rest of the run does not know. What gravity alone makes
// is the displacement of a scene without water and uplift.
TEST(FeRun, geostatic_start_counts_displacements_from_gravity_on)
{
    Scene scene = sliding_dam(0.77);
    const RunResult plain = EarthquakeRun(scene, options_of(scene)).run(silence(0.2, 0.01));
    Scene dry = scene;
    dry.reservoir.reset();
    dry.uplift.reset();
    RunOptions options = options_of(scene);
    options.uplift = {};
    const RunResult gravity = EarthquakeRun(dry, options).run(silence(0.2, 0.01));
    scene.stages.geostatic = true;
    const RunResult zero = EarthquakeRun(scene, options_of(scene)).run(silence(0.2, 0.01));
    EXPECT_EQ(zero.slip, plain.slip);
    ASSERT_EQ(zero.displacement.size(), gravity.displacement.size());
    const VectorXd expected = plain.displacement - gravity.displacement;
    EXPECT_LT((zero.displacement - expected).norm(), 1e-9 * plain.displacement.norm());
    EXPECT_GT(gravity.displacement.norm(), 0.1 * plain.displacement.norm());
}

// Nothing moves without shaking: 1000 s at 95 % of the static limit. A sticking pair keeps its slip to the last bit.
TEST(FeRun, no_creep)
{
    Scene scene = sliding_dam(0.77, 1.0, 7.5);
    scene.mesh.size = 10.0;
    scene.sliding.run_out_max = 3.0;
    RunOptions options = options_of(scene);
    scene.time.substeps = 0;
    const EarthquakeRun run(scene, options);
    const double needed = run.run(silence(0.2, 0.1)).stages.back().critical_friction;
    const RunResult result = run.run(silence(1000.0, 0.1), with_friction(needed / 0.95));
    const double rest = run.rest_time(); // five periods of the dam
    EXPECT_GT(rest, 1.3);
    EXPECT_LE(rest, 1.4);
    EXPECT_EQ(result.counts.steps, 10000 + 14); // and that in steps of 0.1 s
    EXPECT_LT(result.max_slip, 1e-12);
    EXPECT_EQ(result.counts.unresolved, 0);
}

// Rigid limit, a short cut of the verification case: E x 1e4, half a minute of the rigid block's slip.
TEST(FeRun, stiff_dam_slides_as_the_rigid_block)
{
    Scene scene = sliding_dam(0.70, 1e4, 5.0);
    RunOptions options = options_of(scene);
    scene.time.substeps = 2;
    const EarthquakeRun run(scene, options);
    for (const GroundMotion& motion : {sines(1.0, 10.0), flipped(sines(1.0, 10.0))}) {
        const RunResult result = run.run(motion);
        ASSERT_EQ(result.status, Status::at_rest) << text_of(result.notes);
        const double rigid = sliding::slide(motion, sliding::make_rigid_block(scene)).slip;
        EXPECT_GT(rigid, 0.02);
        EXPECT_NEAR(result.slip, rigid, 0.01 * rigid);
        EXPECT_EQ(result.counts.unresolved, 0);
        EXPECT_LT(result.counts.largest_residual, 1e-8);
    }
}

// The same pulse upstream and downstream: only the one that drives the dam downstream makes it slide.
TEST(FeRun, positive_acceleration_drives_downstream)
{
    Scene scene = sliding_dam(0.77);
    RunOptions options = options_of(scene);
    scene.time.substeps = 0;
    const EarthquakeRun run(scene, options);
    GroundMotion pulse = silence(2.0, 0.01);
    for (int k = 0; k < 60; ++k)
        pulse.accel_h[static_cast<std::size_t>(20 + k)] = 3.0 * std::sin(std::numbers::pi * k / 60.0);
    const double downstream = run.run(pulse).slip, upstream = run.run(flipped(pulse)).slip;
    EXPECT_GT(downstream, 0.05);
    EXPECT_LT(std::abs(upstream), 0.3 * downstream);
}

// Openings d/100 at the heel falling to zero at the toe are a rotation of -1/100 about the toe, whatever the areas;
// the position of N' and the moment about the middle belong together, and pair values are those of the sums.
TEST(FeRun, history_of_rocking_and_pairs)
{
    Plane plane;
    plane.distance = VectorXd::LinSpaced(5, 0.0, 8.0);
    plane.area = VectorXd::Constant(5, 2.0);
    plane.area[0] = plane.area[4] = 1.0;
    EXPECT_NEAR(base_rotation(plane, (8.0 - plane.distance.array()) / 100.0), 0.01, 1e-15);
    EXPECT_NEAR(base_rotation(plane, VectorXd::Constant(5, 0.3)), 0.0, 1e-15);

    Scene scene = sliding_dam(0.70, 1.0, 5.0);
    RunOptions options = options_of(scene);
    scene.time.substeps = 0;
    options.pair_series = PairSeries::every_step;
    const RunResult result = EarthquakeRun(scene, options).run(sines(2.0, 5.0));
    const RunHistory& h = result.history;
    const auto pairs = static_cast<std::size_t>(h.by_pair.pairs);
    ASSERT_EQ(h.by_pair.pressure.size(), h.time.size() * pairs);
    ASSERT_EQ(h.by_pair.state.size(), h.time.size() * pairs);
    const double length = result.pair_distance[h.by_pair.pairs - 1];
    const double weight = h.normal_force[0];
    for (std::size_t row = 0; row < h.time.size(); row += 50) {
        double normal = 0.0, slip = 0.0, open = 0.0;
        for (Eigen::Index i = 0; i < h.by_pair.pairs; ++i) {
            const double area = result.pair_area[i];
            const std::size_t k = h.by_pair.at(row, i);
            normal += area * h.by_pair.pressure[k];
            slip += area / length * h.by_pair.slip[k];
            if (h.by_pair.state[k] == ContactState::open) open += area;
        }
        EXPECT_NEAR(normal, h.normal_force[row], 1e-12 * weight);
        EXPECT_NEAR(slip, h.slip[row], 1e-12 * result.max_slip);
        EXPECT_NEAR(open, h.open_length[row], 1e-9 * length);
        EXPECT_NEAR(h.moment[row], h.normal_force[row] * (h.normal_position[row] - length / 2), 1e-9 * weight * length);
        EXPECT_EQ(h.rocking[row] == 0.0, h.largest_opening[row] == 0.0);
    }
    EXPECT_GT(*std::max_element(h.rocking.begin(), h.rocking.end()), 0.0);
    EXPECT_NEAR(h.slip_middle.back(), result.slip, 0.1 * std::abs(result.slip)); // the base is stiff against the slip
}

// Stopped from outside: the history so far is kept; stopped between passes, the whole pass before counts.
TEST(FeRun, can_be_interrupted)
{
    const Scene scene = sliding_dam(0.70, 1.0, 7.5);
    RunOptions options = options_of(scene);
    std::int64_t last = 0;
    double stop_after = 1.0; // of the first pass, then of all
    options.progress = [&](const RunProgress& p) {
        EXPECT_GE(p.step, last);
        EXPECT_LE(p.step, p.steps);
        last = p.step;
        return static_cast<double>(p.step) >= 500 * stop_after ? RunAnswer::stop : RunAnswer::go_on;
    };
    const EarthquakeRun run(scene, options);
    stop_after = 0.5;
    const RunResult half = run.run(sines(1.0, 5.0));
    EXPECT_EQ(half.status, Status::interrupted);
    EXPECT_EQ(half.history.time.size(), 251u); // 250 of 500 steps, and the start
    EXPECT_NEAR(half.end_time, 2.5, 1e-9);
    EXPECT_NE(text_of(half.notes).find("Interrupted at 2.50 s"), std::string::npos) << text_of(half.notes);

    last = 0;
    stop_after = 1.5; // in the second pass
    const RunResult one = run.run(sines(1.0, 5.0));
    EXPECT_EQ(one.status, Status::interrupted);
    EXPECT_EQ(one.halvings, 0);
    EXPECT_GT(one.end_time, 5.0);
    EXPECT_TRUE(std::isnan(one.slip_error));
}

// Energy closes to round-off of its largest term: all terms from states, in sliding with opening and damping.
TEST(FeRun, energy_closes)
{
    Scene scene = sliding_dam(0.70);
    RunOptions options = options_of(scene);
    scene.time.substeps = 0;
    for (const MassDamping mass : {MassDamping::deformation_only, MassDamping::relative, MassDamping::total}) {
        scene.damping.mass = mass;
        for (const double alpha : {0.0, -0.05, -1.0 / 3.0}) {
            scene.time.alpha = alpha;
            const RunResult result = EarthquakeRun(scene, options).run(sines(1.5, 6.0));
            EXPECT_GT(result.slip, 1e-3);
            EXPECT_LT(result.energy_error, 1e-10);
            EXPECT_GT(result.history.energy.back().friction, 1e3);
        }
    }
}

// Small shaking: partly slipping pairs at heel and toe, slip in proportion to the record and of micrometres.
TEST(FeRun, small_shaking_gives_small_slip)
{
    Scene scene = sliding_dam(0.77, 1.0, 1.5);
    RunOptions options = options_of(scene);
    scene.time.substeps = 0;
    const EarthquakeRun run(scene, options);
    const GroundMotion motion = sines(1.0, 10.0);
    const double thousandth = run.run(scaled(motion, 1e-3)).slip, tenth_of_it = run.run(scaled(motion, 1e-4)).slip;
    EXPECT_LT(std::abs(thousandth), 5e-6);
    EXPECT_GT(thousandth / tenth_of_it, 8.0);
    EXPECT_LT(thousandth / tenth_of_it, 12.0);
}

// Sub-steps: the estimate of the error covers the distance to a much finer run.
TEST(FeRun, sub_steps_reach_the_wanted_accuracy)
{
    const Scene scene = sliding_dam(0.70, 1.0, 5.0);
    const RunOptions options = options_of(scene);
    const EarthquakeRun chosen(scene, options);
    Scene in_fine_steps = scene;
    in_fine_steps.time.substeps = 6;
    const GroundMotion motion = sines(1.0, 8.0);
    const RunResult result = chosen.run(motion), fine = EarthquakeRun(in_fine_steps, options).run(motion);
    EXPECT_LE(result.slip_error, 0.01 * result.slip);
    EXPECT_NEAR(result.slip, fine.slip, 0.01 * fine.slip);
}

// A tangential penalty puts a spring under the dam: soft ones change the slip much, stiff ones come back to the exact
// law. Contact without separation lets compressed pairs carry more than the resultant: less slip. Energy closes in all,
// the springs' energy being part of the contact work, which is recovered when they relax.
TEST(FeRun, penalty_tends_to_exact_and_no_separation_slides_less)
{
    Scene scene = sliding_dam(0.70);
    const GroundMotion motion = sines(1.0, 8.0);
    RunOptions options = options_of(scene);
    scene.time.substeps = 1;
    options.contact.landing = Landing::ringing; // a penalty has no landings: the same step otherwise
    const double exact = EarthquakeRun(scene, options).run(motion).slip;
    const auto with_stiffness = [&](double k) {
        Scene penalty = scene;
        penalty.contact.enforcement = ContactEnforcement::penalty;
        penalty.contact.tangential_stiffness = k;
        const RunResult result = EarthquakeRun(penalty, options).run(motion);
        EXPECT_LT(result.energy_error, 1e-10);
        EXPECT_EQ(result.counts.unresolved, 0);
        return result.slip;
    };
    EXPECT_GT(std::abs(with_stiffness(2e8) / exact - 1.0), 0.05);
    EXPECT_NEAR(with_stiffness(1e11), exact, 0.01 * exact);
    EXPECT_NEAR(with_stiffness(1e14), exact, 1e-4 * exact);

    scene.contact.separation = JointOpening::none;
    const RunResult shut = EarthquakeRun(scene, options).run(motion);
    EXPECT_EQ(shut.counts.unresolved, 0);
    EXPECT_LT(shut.slip, 0.9 * exact);
    EXPECT_EQ(*std::max_element(shut.history.largest_opening.begin(), shut.history.largest_opening.end()), 0.0);
}

// Linear acceleration is stable below 0.55 periods: massless rock has none.
TEST(FeRun, conditionally_stable_scheme_on_massless_rock_is_refused)
{
    Scene scene = sliding_dam(0.77);
    scene.time.scheme = TimeScheme::newmark;
    scene.time.gamma = 0.5;
    scene.time.beta = 1.0 / 6.0;
    try {
        const EarthquakeRun run(scene, options_of(scene));
        FAIL() << "accepted";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("time.beta"), std::string::npos) << error.what();
        EXPECT_NE(std::string(error.what()).find("0.25"), std::string::npos) << error.what();
    }
    scene.time.beta = 0.25;
    EXPECT_NO_THROW(EarthquakeRun(scene, options_of(scene)));
}

} // namespace
