// What an earthquake leaves of the joints, in a file and in memory, and sequences whose records are a static state apart.
#include "analysis/fe/state_file.hpp"
#include "analysis/prepare/ready.hpp"
#include "core/file.hpp"
#include "core/input_error.hpp"
#include "fe2d/reduction/reduced_run.hpp"
#include "fe2d/run/earthquake_pass.hpp"
#include "pages/fe/fe_pages.hpp"
#include "records/transform/transform.hpp"
#include "verification/cases/fe_run_scenes.hpp"
#include "verification/hard/hard_scenes.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <unistd.h>

namespace {

using namespace damslip;

enum class Law { bond, anchors, mouth, reynolds, bond_anchors_and_zero };

/// The reference dam, coarse, with water that follows its opening in one way or another.
Scene dam_with(Law law)
{
    Scene scene = hard::soft_dam(0.8);
    scene.reservoir->level = 45.0;
    scene.uplift->model = UpliftModel::linear;
    scene.uplift->points.clear();
    scene.time.substeps = law == Law::reynolds ? 2 : 0;
    const bool all = law == Law::bond_anchors_and_zero;
    if (law == Law::bond || all) {
        scene.contact.friction = 0.6;
        scene.contact.cohesion = 300e3;
        scene.contact.bond.shear_energy = 1500.0;
    }
    if (law == Law::anchors || all) {
        Anchor bar;
        bar.name = "bars";
        bar.distance = 6.0;
        bar.inclination = 0.5;
        bar.free_length = 1.0;
        bar.area = 0.002;
        bar.yield_strength = 500e6;
        bar.rupture_strain = 0.02;
        scene.anchors.push_back(bar);
    }
    JointWaterLaw& water = scene.uplift->water;
    if (law == Law::mouth) {
        water.opening = OpeningWater::mouth;
        water.mouth_speed = 20.0;
    }
    if (law == Law::reynolds) {
        water.opening = OpeningWater::reynolds;
        water.clearance = 5e-3;
    }
    if (all) water.opening = OpeningWater::zero;
    return scene;
}

/// Steps of 2^-7 s: sums of them are exact, whenever a record begins.
GroundMotion record_of(double pga, unsigned seed)
{
    GroundMotion motion = fe2d::test::sines(pga, 4.0, seed, 0.0078125);
    motion.name = "record " + std::to_string(seed);
    return motion;
}

fe2d::RunResult run_of(const Scene& scene, const GroundMotion& motion, const fe2d::RunState* from = nullptr)
{
    const Watch nobody;
    const Ready ready = prepare(scene, Method::finite_elements, nullptr);
    fe2d::RunOptions options = ready.run_options(nobody);
    if (from) options.start = *from;
    return fe2d::EarthquakeRun(ready.scene, options).run(motion);
}

std::filesystem::path scratch_file(const char* name)
{
    return std::filesystem::temp_directory_path() / fmt::format("damslip_joint_state_{}_{}.json", getpid(), name);
}

fe2d::RunState through_a_file(const Scene& scene, const fe2d::RunState& state)
{
    const std::filesystem::path file = scratch_file("through");
    write_state(file, scene, state, "a test");
    fe2d::RunState read = read_state(file, scene);
    std::filesystem::remove(file);
    return read;
}

void expect_same_bits(const fe2d::RunState& a, const fe2d::RunState& b)
{
    EXPECT_EQ(a.force, b.force);
    EXPECT_EQ(a.opening, b.opening);
    EXPECT_EQ(a.slip, b.slip);
    EXPECT_EQ(a.path, b.path);
    EXPECT_EQ(a.cohesion, b.cohesion);
    EXPECT_EQ(a.states, b.states);
    EXPECT_EQ(a.laws, b.laws);
}

class JointState : public testing::TestWithParam<Law> {};

// With all modes nothing is left out, and the laws of the joint are those of the full run: the same up to round-off.
TEST_P(JointState, AllModesAreTheFullRun)
{
    const Scene scene = dam_with(GetParam());
    const Watch nobody;
    const Ready ready = prepare(scene, Method::finite_elements, nullptr);
    const fe2d::RunOptions options = ready.run_options(nobody);
    const fe2d::EarthquakeRun full(ready.scene, options);
    const fe2d::ReducedRun reduced(full, ready.scene, options, 100000);
    const GroundMotion one = record_of(2.5, 5), two = records::one_after_the_other({record_of(2.5, 5), record_of(2.0, 6)}, 0.5);
    for (const GroundMotion* motion : {&one, &two}) {
        const fe2d::RunResult expected = full.run(*motion), result = reduced.run(*motion);
        ASSERT_GT(std::abs(expected.slip), 1e-4);
        EXPECT_EQ(result.status, expected.status);
        EXPECT_EQ(result.counts.unresolved, expected.counts.unresolved);
        EXPECT_LT(fe2d::largest_difference(result.history.slip, expected.history.slip), 1e-6 * std::abs(expected.slip));
        const double force = expected.history.normal_force[0];
        EXPECT_LT(fe2d::largest_difference(result.history.normal_force, expected.history.normal_force), 1e-5 * force);
        EXPECT_NEAR(result.after.open_length, expected.after.open_length, 1e-6);
        ASSERT_EQ(result.anchors.size(), expected.anchors.size());
        for (std::size_t i = 0; i < result.anchors.size(); ++i)
            EXPECT_NEAR(result.anchors[i].history.largest_force, expected.anchors[i].history.largest_force,
                        1e-6 * expected.anchors[i].history.largest_force);
        ASSERT_EQ(result.base_water.has_value(), expected.base_water.has_value());
        ASSERT_EQ(result.events.size(), expected.events.size());
        for (std::size_t i = 0; i < result.events.size(); ++i) {
            EXPECT_EQ(result.events[i].start, expected.events[i].start);
            EXPECT_NEAR(result.events[i].change, expected.events[i].change, 1e-6 * std::abs(expected.slip));
        }
    }
}

TEST_P(JointState, FileKeepsEveryBit)
{
    const Scene scene = dam_with(GetParam());
    const fe2d::RunResult run = run_of(scene, record_of(2.5, 5));
    ASSERT_EQ(run.status, Status::at_rest) << text_of(run.notes);
    const fe2d::RunState read = through_a_file(scene, run.state);
    expect_same_bits(read, run.state);
    EXPECT_EQ(run_of(scene, record_of(2.0, 6), &read).slip, run_of(scene, record_of(2.0, 6), &run.state).slip);
}

// With uplift.after = "full" a static state with its water lies between two records. One run of both is then a run, its
// state in a file, and another run from there: slips, forces and what the laws keep are the same bits.
TEST_P(JointState, SequenceWithRestsIsSaveLoadGoOn)
{
    Scene scene = dam_with(GetParam());
    scene.uplift->water.after = WaterAfter::full;
    const GroundMotion first = record_of(2.5, 5), second = record_of(2.0, 6);
    const fe2d::RunResult both = run_of(scene, records::one_after_the_other({first, second}, 1.0));
    ASSERT_EQ(both.status, Status::at_rest) << text_of(both.notes);
    ASSERT_EQ(both.events.size(), 2u);
    ASSERT_EQ(both.between.size(), 1u);

    const fe2d::RunResult one = run_of(scene, first);
    const fe2d::RunState state = through_a_file(scene, one.state);
    const fe2d::RunResult other = run_of(scene, second, &state);
    EXPECT_EQ(both.events.front().slip, one.slip);
    expect_same_bits(both.state, other.state);
    EXPECT_EQ(both.after.slip, other.after.slip);

    EXPECT_GT(one.state.laws.at("water_largest_crack_m")[0], 2.0); // else the water between them is that before
    EXPECT_GT(both.events.front().change, 1e-4);
    EXPECT_NE(both.events.back().change, 0.0);

    // One history: slips counted from the first static state, energies summed up, time going on.
    EXPECT_EQ(both.history.time.size(), one.history.time.size() + other.history.time.size());
    EXPECT_NEAR(both.slip, both.events.front().change + both.events.back().change, 1e-15);
    EXPECT_NEAR(both.history.energy.back().friction,
                one.history.energy.back().friction + other.history.energy.back().friction,
                1e-12 * both.history.energy.back().friction);
    EXPECT_GE(both.max_slip, std::abs(both.slip));
    EXPECT_EQ(both.counts.steps, one.counts.steps + other.counts.steps);
    EXPECT_LT(both.energy_error, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Laws, JointState,
                         testing::Values(Law::bond, Law::anchors, Law::mouth, Law::reynolds,
                                         Law::bond_anchors_and_zero));

// A bar that has snapped pulls no more in the next run, and a bond that is gone does not hold it.
TEST(JointStates, WhatIsBrokenStaysSo)
{
    const Scene anchored = dam_with(Law::anchors);
    const fe2d::RunResult first = run_of(anchored, record_of(4.0, 5));
    ASSERT_EQ(first.status, Status::at_rest) << text_of(first.notes);
    ASSERT_TRUE(first.anchors.front().history.snapped_at);
    const fe2d::RunResult next = run_of(anchored, record_of(2.0, 6), &first.state);
    EXPECT_EQ(next.anchors.front().history.snapped_at, first.anchors.front().history.snapped_at);
    EXPECT_GT(next.slip, run_of(anchored, record_of(2.0, 6)).slip);

    const Scene bonded = dam_with(Law::bond);
    const fe2d::RunResult broken = run_of(bonded, record_of(4.0, 5));
    ASSERT_EQ(broken.status, Status::at_rest) << text_of(broken.notes);
    EXPECT_GT(run_of(bonded, record_of(2.0, 6), &broken.state).slip, run_of(bonded, record_of(2.0, 6)).slip);
}

// Full head in what the first record has cracked, and the dam stands no more.
TEST(JointStates, WaterBetweenRecordsMayTakeTheDam)
{
    Scene scene = dam_with(Law::mouth);
    scene.reservoir->level = 62.5;
    scene.contact.friction = 1.1;
    scene.uplift->water.after = WaterAfter::full;
    const fe2d::RunResult run =
        run_of(scene, records::one_after_the_other({record_of(2.5, 5), record_of(2.0, 6)}, 0.0));
    EXPECT_EQ(run.status, Status::static_failure);
    EXPECT_EQ(run.events_left, 1u);
    ASSERT_EQ(run.events.size(), 1u); // the record before it has its slip
    EXPECT_EQ(run.events.front().status, Status::at_rest);
    EXPECT_EQ(text_of(run.notes).rfind("before \"record 6\", full head on ", 0), 0u) << text_of(run.notes);
    EXPECT_NE(text_of(run.notes).find("the dam slides without any earthquake"), std::string::npos) << text_of(run.notes);
    EXPECT_NE(text_of(run.notes).find("1 record of the sequence was not run."), std::string::npos) << text_of(run.notes);
}

TEST(JointStates, NumbersOfLawsAreChecked)
{
    const Scene scene = dam_with(Law::bond_anchors_and_zero);
    const fe2d::RunResult run = run_of(scene, record_of(2.5, 5));
    const auto message = [&](auto&& spoil) {
        fe2d::RunState state = run.state;
        spoil(state.laws);
        const std::filesystem::path file = scratch_file("spoilt");
        write_state(file, scene, state, "a test");
        std::string found = "(accepted)";
        try {
            read_state(file, scene);
        } catch (const InputError& error) {
            found = error.what();
        }
        std::filesystem::remove(file);
        return found;
    };
    EXPECT_EQ(message([](auto&) {}), "(accepted)");
    EXPECT_NE(message([](auto& laws) {
                  laws.erase("anchor_force_N_m");
              }).find("\"anchor_force_N_m\" is missing in \"laws\"."),
              std::string::npos);
    EXPECT_NE(message([](auto& laws) { laws["bond_damage"].pop_back(); }).find("values where"), std::string::npos);
    EXPECT_NE(message([](auto& laws) { laws["bond_damage"][0] = 1.5; }).find("is not between 0 and 1"),
              std::string::npos);
    EXPECT_NE(message([](auto& laws) { laws["anchor_state"][0] = 7.0; }).find("is no state of an anchor"),
              std::string::npos);
}

/// Friction alone does not hold this dam; passive bars across the joint pull only once it has slid.
Scene dam_that_jumps()
{
    Scene scene = hard::soft_dam(0.5);
    scene.contact.cohesion = 300e3;
    scene.contact.bond.shear_energy = 30.0;
    Anchor bar;
    bar.name = "bars";
    bar.distance = 22.0;
    bar.inclination = 0.0;
    bar.free_length = 0.5;
    bar.area = 0.008;
    bar.yield_strength = 1640e6;
    bar.rupture_strain = 0.2;
    scene.anchors.push_back(bar);
    scene.time.substeps = 0;
    return scene;
}

// The bond unzips under the uplift, no state in equilibrium follows, and the dam, let go, comes to rest on its bars: where
// |T - N sin| <= mu (N' + N cos) with the N of their length by hand. What damping took is less than what the loads did
// beyond friction.
TEST(StaticJump, ADamWhoseBondBreaksComesToRestOnItsBars)
{
    const Scene scene = dam_that_jumps();
    const fe2d::RunResult run = run_of(scene, hard::silence(0.1));
    ASSERT_FALSE(run.stages.empty());
    const auto jumped = std::find_if(run.stages.begin(), run.stages.end(),
                                     [](const fe2d::StageResult& s) { return s.bond && s.bond->jumps > 0; });
    ASSERT_NE(jumped, run.stages.end()) << text_of(run.stages.back().notes());
    EXPECT_EQ(jumped->status, fe2d::StageStatus::ok);
    EXPECT_EQ(jumped->bond->largest, 1.0); // the whole load has been found in equilibrium, after the jump
    EXPECT_GT(jumped->bond->events, 0);
    EXPECT_LE(jumped->bond->largest, jumped->bond->limit);
    EXPECT_EQ(jumped->bond->carried, 1.0);
    EXPECT_NE(text_of(jumped->notes()).find("It jumped there"), std::string::npos) << text_of(jumped->notes());

    const Anchor& bar = scene.anchors.front();
    const double length = std::hypot(bar.free_length, jumped->slip);
    const double force = std::min(bar.young_modulus * (length / bar.free_length - 1.0), bar.yield_strength) * bar.area;
    const double across = force * bar.free_length / length, along = force * jumped->slip / length;
    // The resultants count bars with the force of the stage before: none.
    const double normal = jumped->resultant.normal_force, shear = jumped->resultant.shear_force;
    EXPECT_GT(shear, scene.contact.friction * normal) << "friction alone would hold it";
    EXPECT_LE(std::abs(shear - along), scene.contact.friction * (normal + across) * (1.0 + 1e-3));
    EXPECT_GT(jumped->bond->lost, 0.0);
    EXPECT_LT(jumped->bond->lost, (shear - scene.contact.friction * normal) * jumped->slip);

    // The ledger names it beside its own terms.
    ContactRun shown;
    shown.fe = run;
    const Table ledger = pages::contact_energy_table({shown});
    const auto column = std::find_if(ledger.columns.begin(), ledger.columns.end(),
                                     [](const Column& c) { return c.key == "jump_loss_J_m"; });
    ASSERT_NE(column, ledger.columns.end());
    double lost = 0.0;
    for (const fe2d::StageResult& stage : run.stages)
        if (stage.bond) lost += stage.bond->lost;
    EXPECT_EQ(std::get<double>(ledger.rows.front()[static_cast<std::size_t>(column - ledger.columns.begin())]), lost);
}

} // namespace
