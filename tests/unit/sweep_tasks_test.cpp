// Order, parts and FE groups of a sweep's rows; sizes; quoting of commands.
#include "analysis/prepare/rigid_model.hpp"
#include "analysis/sweep/sweep_axes.hpp"
#include "analysis/sweep/sweep_grid.hpp"
#include "cli/sweep_command.hpp"
#include "scene/read.hpp"
#include "source_dir.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <map>
#include <set>

namespace damslip::cli {

namespace {

Axes axes_of(std::size_t frictions)
{
    Axes axes;
    for (std::size_t i = 0; i < frictions; ++i) axes.friction.push_back(0.6 + 0.1 * static_cast<double>(i));
    axes.level = {40, 62.5};
    axes.uplift = {"none", "linear", "curtain"};
    axes.reservoir = {"hydrostatic"};
    axes.size = {1, 2};
    axes.scale = {1, 1.5, 2};
    axes.polarity = {1, -1};
    axes.method = {sweep_method("rigid"), sweep_method("fe"), sweep_method("fe-reduced")};
    return axes;
}

TEST(SweepTasks, IdsCountTheProductWithTheLastAxisFastest)
{
    const TaskList tasks = make_tasks(axes_of(4), 5);
    ASSERT_EQ(tasks.rows(), 4u * 2 * 3 * 1 * 2 * 3 * 2 * 5 * 3);
    std::size_t id = 0;
    for (std::size_t friction = 0; friction < 4; ++friction)
        for (std::size_t level = 0; level < 2; ++level)
            for (std::size_t uplift = 0; uplift < 3; ++uplift)
                for (std::size_t size = 0; size < 2; ++size)
                    for (std::size_t scale = 0; scale < 3; ++scale)
                        for (std::size_t polarity = 0; polarity < 2; ++polarity)
                            for (std::size_t record = 0; record < 5; ++record)
                                for (std::size_t method = 0; method < 3; ++method, ++id) {
                                    const GridIndex at = tasks.index(id);
                                    ASSERT_EQ(std::make_tuple(at.friction, at.level, at.uplift, at.reservoir, at.size),
                                              std::make_tuple(friction, level, uplift, std::size_t{0}, size));
                                    ASSERT_EQ(std::make_tuple(at.scale, at.polarity, at.record, at.method),
                                              std::make_tuple(scale, polarity, record, method));
                                    ASSERT_EQ(tasks.id(at), id);
                                }
}

TEST(SweepTasks, PartsHoldEachRowOnceAndTheirShareOfEachMethod)
{
    const Axes axes = axes_of(4);
    const TaskList tasks = make_tasks(axes, 5);
    for (const std::size_t count : {1u, 2u, 3u, 7u, 60u, 1439u, 1440u, 5000u}) {
        std::vector<int> times(tasks.rows());
        for (std::size_t i = 0; i < count; ++i) {
            const std::vector<std::size_t> rows = shard_rows(tasks, {i, count});
            ASSERT_TRUE(std::is_sorted(rows.begin(), rows.end()));
            std::array<std::size_t, 3> of_method{};
            for (const std::size_t id : rows) {
                ++times[id];
                ++of_method[tasks.index(id).method];
            }
            for (const std::size_t n : of_method) { // equal but for one row
                ASSERT_GE(n, 1440 / count);
                ASSERT_LE(n, (1440 + count - 1) / count);
            }
        }
        ASSERT_TRUE(std::all_of(times.begin(), times.end(), [](int n) { return n == 1; })) << count;
    }
}

// As many parts as variants x motions: each is one variant under one motion, with all its frictions and methods.
TEST(SweepTasks, APartPerVariantAndMotionSharesOneSetUp)
{
    const TaskList tasks = make_tasks(axes_of(4), 5);
    const std::size_t count = tasks.variants() * tasks.motions();
    for (std::size_t i = 0; i < count; ++i) {
        const std::vector<std::size_t> rows = shard_rows(tasks, {i, count});
        ASSERT_EQ(rows.size(), 4u * 3);
        for (const std::size_t id : rows) {
            ASSERT_EQ(tasks.variant(tasks.index(id)), tasks.variant(tasks.index(rows.front())));
            ASSERT_EQ(tasks.motion(tasks.index(id)), tasks.motion(tasks.index(rows.front())));
        }
    }
}

TEST(SweepTasks, FeGroupsHoldTheFrictionsOfOneVariantMotionAndMethod)
{
    const Axes axes = axes_of(6);
    const TaskList tasks = make_tasks(axes, 5);
    const std::vector<std::size_t> all = shard_rows(tasks, {});
    const std::vector<FeGroup> groups = fe_groups(tasks, axes, all, 4);
    EXPECT_EQ(groups.size(), tasks.variants() * tasks.motions() * 2); // more than enough for 4 threads: not dealt out
    std::set<std::size_t> seen;
    for (const FeGroup& g : groups) {
        EXPECT_EQ(g.rows.size(), 6u);
        for (const std::size_t id : g.rows) {
            const GridIndex at = tasks.index(id);
            ASSERT_TRUE(tasks.variant(at) == g.variant && tasks.motion(at) == g.motion && at.method == g.method);
            ASSERT_EQ(axes.method[at.method].kind, SweepKind::finite_elements);
            ASSERT_TRUE(seen.insert(id).second);
        }
    }
    EXPECT_EQ(seen.size(), tasks.rows() / 3 * 2);

    // One motion left for 4 threads: 4 groups, their frictions dealt out in turn.
    const std::vector<std::size_t> one_group = groups.front().rows;
    const std::vector<FeGroup> dealt = fe_groups(tasks, axes, one_group, 4);
    ASSERT_EQ(dealt.size(), 4u);
    EXPECT_EQ(dealt[0].rows, (std::vector<std::size_t>{one_group[0], one_group[4]}));
    EXPECT_EQ(dealt[3].rows, (std::vector<std::size_t>{one_group[3]}));
    EXPECT_TRUE(fe_groups(tasks, axes, {}, 4).empty());
}

Scene dam_with_water()
{
    return read_scene(std::string(source_dir()) + "/examples/reference_dam_profile.toml");
}

// The source's rock has no mass, whatever the scene says; the other laws leave the rock alone.
TEST(SweepTasks, TheSourcesSettingsAreOfMasslessRock)
{
    Scene scene = dam_with_water();
    scene.foundation->material.density = 2650.0;
    scene.foundation->mass = RockMass::with_mass;
    scene.foundation->boundary = RockBoundary::viscous;
    const Scene source = with_law(scene, FeLaw::goldgruber_2015, {}), exact = with_law(scene, FeLaw::exact, {});
    EXPECT_EQ(source.foundation->mass, RockMass::massless);
    EXPECT_EQ(source.foundation->boundary, RockBoundary::fixed);
    EXPECT_EQ(exact.foundation->mass, RockMass::with_mass);
    EXPECT_EQ(exact.foundation->boundary, RockBoundary::viscous);
}

// Stopped once: halves; twice: quarters; often enough: one by one. Other groups stay whole; each row is there once, in its order.
TEST(SweepTasks, StoppedGroupsGoOnInPieces)
{
    std::vector<FeGroup> groups(2);
    groups[0].rows = {0, 2, 4, 6, 8, 10};
    groups[1].rows = {1, 3, 5};
    const auto sizes = [&](const std::map<std::size_t, int>& stopped) {
        std::vector<std::size_t> list;
        for (const FeGroup& piece : with_stopped_in_pieces(groups, stopped)) list.push_back(piece.rows.size());
        return list;
    };
    EXPECT_EQ(sizes({}), (std::vector<std::size_t>{6, 3}));
    EXPECT_EQ(sizes({{4, 1}}), (std::vector<std::size_t>{3, 3, 3}));
    EXPECT_EQ(sizes({{4, 1}, {3, 1}}), (std::vector<std::size_t>{3, 3, 1, 1, 1}));
    EXPECT_EQ(sizes({{4, 2}, {6, 1}}), (std::vector<std::size_t>{1, 1, 1, 1, 1, 1, 3}));
    EXPECT_EQ(sizes({{4, 1000}}).size(), 7u);
    std::vector<std::size_t> rows;
    for (const FeGroup& piece : with_stopped_in_pieces(groups, {{4, 1}}))
        rows.insert(rows.end(), piece.rows.begin(), piece.rows.end());
    EXPECT_EQ(rows, (std::vector<std::size_t>{0, 2, 4, 6, 8, 10, 1, 3, 5}));
}

// Weight, thrust, uplift and added mass all grow with the square of the size, so a_y and the critical friction stay; only
// the rounding of these sums differs. A force that stays as it is loses its part: it must show.
TEST(SweepSize, WaterAndWeightGiveTheSameYieldAtEverySize)
{
    const Scene scene = dam_with_water();
    const RigidModel one = make_rigid_model(scene, {}), two = make_rigid_model(sized(scene, 2), {}),
                     third = make_rigid_model(sized(scene, 0.3), {});
    const double a_y = one.downstream.law.constant;
    EXPECT_NEAR(two.downstream.law.constant, a_y, 1e-12 * a_y);
    EXPECT_NEAR(third.downstream.law.constant, a_y, 1e-12 * a_y);
    EXPECT_NEAR(two.critical_friction, one.critical_friction, 1e-12);
    EXPECT_NEAR(two.block.mass, 4 * one.block.mass, 1e-12 * two.block.mass);

    Scene pulled = scene;
    pulled.forces.push_back({"cable", {0, 10}, -1e6, 0});
    const double held = make_rigid_model(pulled, {}).downstream.law.constant,
                 held_twice = make_rigid_model(sized(pulled, 2), {}).downstream.law.constant;
    EXPECT_NEAR((held_twice - a_y) * 4, held - a_y, 1e-9 * a_y); // 1e6 N/m on four times the mass
    EXPECT_GT(held, 1.01 * a_y);
}

/// The words a POSIX shell makes of a command line.
std::vector<std::string> shell_words(const std::string& line)
{
    std::string quoted; // the script is the only argument of sh -c
    for (const char c : "printf '%s\\n' " + line) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    std::FILE* pipe = ::popen(("sh -c '" + quoted + "'").c_str(), "r");
    std::string text;
    for (int c; (c = std::fgetc(pipe)) != EOF;) text += static_cast<char>(c);
    ::pclose(pipe);
    std::vector<std::string> words;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = text.find('\n', at);
        words.push_back(text.substr(at, end - at));
        at = end + 1;
    }
    return words;
}

TEST(SweepPlan, AShellReadsQuotedWordsBack)
{
    const std::vector<std::string> words{"dam.toml", "my dam's.toml", "$HOME", "a;rm -rf b", "`x`",     "\"q\"",
                                         "*",        "back\\slash",   "~/dam", "!1#{}",      "Größe μ", "-x=1,2"};
    std::string line;
    for (const std::string& word : words) line += shell_quoted(word) + " ";
    EXPECT_EQ(shell_words(line), words);
    EXPECT_EQ(shell_quoted("0.65:1.0:0.05"), "0.65:1.0:0.05"); // readable where it can be
    EXPECT_EQ(shell_quoted(""), "''");
}

TEST(SweepPlan, TheCommandLineCarriesEveryOption)
{
    SweepArguments a;
    a.inputs.scene = "my dam.toml";
    a.inputs.records = {"a b.csv", "c.csv"};
    a.inputs.verticals = {"v.csv", "w.csv"};
    a.inputs.unit = "g";
    a.inputs.dt = 0.005;
    a.inputs.scheme = "slammer";
    a.friction = "0.7,0.8";
    a.level = "40";
    a.uplift = "linear";
    a.reservoir = "zangar";
    a.size = "1,2";
    a.scale = "1:2:0.5";
    a.polarity = "1,-1";
    a.method = "fe-penalty,fe-reduced";
    a.modes = 8;
    a.penalty_stiffness = 1e11;
    a.out = "out/results.csv";
    EXPECT_EQ(
        sweep_command_line(a),
        "damslip sweep 'my dam.toml' --record 'a b.csv' --record c.csv --vertical v.csv --vertical w.csv --units g "
        "--dt 0.005 --friction 0.7,0.8 --level 40 --uplift linear --reservoir zangar --size 1,2 --scale 1:2:0.5 "
        "--polarity 1,-1 --method fe-penalty,fe-reduced --modes 8 --penalty-stiffness 1e+11 --scheme slammer --out "
        "out/results.csv");
    EXPECT_EQ(merge_command_line(a, 2),
              "damslip sweep --merge out/results.0-of-2.sqlite out/results.1-of-2.sqlite --out out/results.csv");
    EXPECT_EQ(merge_command_line(a, 21), "damslip sweep --merge out --out out/results.csv");
}

} // namespace

} // namespace damslip::cli
