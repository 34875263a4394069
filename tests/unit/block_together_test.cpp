// Blocks of a batched run slide to the bits of each one alone.
#include "block_motions.hpp"
#include "sliding/block/slip_motion.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <random>

using namespace damslip;
using namespace damslip::sliding;
using namespace damslip::test;

namespace {

bool same(double a, double b)
{
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

void expect_same(const SlideResult& a, const SlideResult& b, const std::string& where)
{
    EXPECT_EQ(a.status, b.status) << where;
    EXPECT_EQ(a.phases, b.phases) << where;
    EXPECT_TRUE(same(a.slip, b.slip)) << where << ": " << a.slip << " " << b.slip;
    EXPECT_TRUE(same(a.max_slip, b.max_slip)) << where;
    EXPECT_TRUE(same(a.downstream_slip, b.downstream_slip)) << where;
    EXPECT_TRUE(same(a.upstream_slip, b.upstream_slip)) << where;
    EXPECT_TRUE(same(a.peak_slip_rate, b.peak_slip_rate)) << where;
    EXPECT_TRUE(same(a.end_time, b.end_time)) << where;
    EXPECT_TRUE(same(a.first_slip_time, b.first_slip_time)) << where;
    EXPECT_TRUE(same(a.last_slip_time, b.last_slip_time)) << where;
    EXPECT_EQ(a.notes, b.notes) << where;
}

/// @returns movements of all blocks
int expect_together_as_alone(const SkippingMotion& motion, const std::vector<RigidBlock>& blocks,
                             const SlideOptions& options, const std::string& where)
{
    std::vector<SlipStages> stages;
    std::vector<const SlipStages*> pointers;
    for (const RigidBlock& block : blocks) stages.push_back({{0.0, block, 0.0}});
    for (const SlipStages& s : stages) pointers.push_back(&s);
    const std::vector<SlideResult> together = slide_together(motion, pointers, options);
    EXPECT_EQ(together.size(), blocks.size());
    int phases = 0;
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        expect_same(together[i], slide(motion, stages[i], options), where + ", block " + std::to_string(i));
        phases += together[i].phases;
    }
    return phases;
}

SlideOptions ways(bool two_way, int polarity)
{
    SlideOptions options;
    options.sliding.two_way = two_way;
    options.polarity = polarity;
    return options;
}

/// Noise of several kinds, with quiet stretches, and ending on the way.
GroundMotion noise(std::mt19937_64& random, double dt, int n)
{
    std::uniform_real_distribution<double> level(-1.0, 1.0);
    std::vector<double> a{0.0};
    double slow = 0.0, size = 1.0;
    const bool steps = random() % 4 == 0; // of a quarter: many samples on the yields, and equal ones in a row
    for (int k = 1; k <= n; ++k) {
        if (random() % 97 == 0) size = random() % 3 == 0 ? 0.02 : 1.0 + level(random);
        slow = 0.9 * slow + 0.4 * level(random);
        const double now = 3.0 * size * (slow + 0.3 * level(random));
        a.push_back(steps ? std::round(4.0 * now) / 4.0 : now);
    }
    return {"noise", dt, std::move(a), {}, {}};
}

} // namespace

TEST(BlockTogether, random_motions_and_blocks)
{
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> part(0.0, 1.0);
    int phases = 0;
    for (int run = 0; run < 400; ++run) {
        const double dt = run % 3 == 0 ? 0.05 : 0.01;
        const SkippingMotion motion(noise(random, dt, 20 + static_cast<int>(random() % 3000)));
        const double first = 0.25 * std::ceil(12.0 * part(random)), step = run % 2 ? 1e-3 : run % 5 ? 0.0 : 0.5;
        const double up = run % 7 == 0 ? 1.0 : 50.0; // the first: driven upstream, too
        std::vector<RigidBlock> blocks;
        for (std::size_t i = 0, n = 1 + random() % 9; i < n; ++i) {
            RigidBlock block = block_with_yields(first + step * static_cast<double>(i), up);
            if (run % 4 == 0) {
                block.base_inclination = 0.03;
                block.added_mass.xx = 0.4;
                block.cohesion_force = 0.1;
            }
            blocks.push_back(block);
        }
        for (const int polarity : {1, -1})
            phases +=
                expect_together_as_alone(motion, blocks, ways(run % 3 != 1, polarity), "run " + std::to_string(run));
        if (run % 5 != 0) continue;
        GroundMotion with_vertical = motion.motion();
        for (const double a : motion.motion().accel_h) with_vertical.accel_v.push_back(0.3 * a + 0.1 * part(random));
        phases += expect_together_as_alone(SkippingMotion(with_vertical), blocks, ways(run % 2 == 0, 1),
                                           "vertical, run " + std::to_string(run));
    }
    EXPECT_GT(phases, 10000);
}

// A start, a stop or both in the last interval, on a sample, at once, and again after a stop in one interval.
TEST(BlockTogether, events_on_samples_and_at_the_end)
{
    const std::vector<std::vector<double>> motions{{0.0, 1.0, 2.0},
                                                   {0.0, 2.0, -3.0},
                                                   {2.0, 0.0, -3.0, -3.0},
                                                   {2.0, 2.0},
                                                   {0.0, 1.0, 1.0, 1.0, 2.0, 1.0, 0.0},
                                                   {0.0, 1.0, 3.0, 1.0, -1.0, 1.0, 3.0, 1.0},
                                                   {0.0, 1.5, -40.0, 60.0, -80.0, 60.0, -60.0, 0.0},
                                                   {0.0, 0.0, 0.0},
                                                   {0.0, std::nextafter(1.0, 2.0), 0.0}};
    for (const std::vector<double>& samples : motions)
        for (const auto& [dt, yield] : {std::pair{0.005, 1.0}, {0.1, 1.0}, {0.013, -0.7}}) // -0.7: no run-out
            for (const double step : {0.0, 0.25, 1e-9})
                for (const int polarity : {1, -1}) {
                    std::vector<RigidBlock> blocks;
                    for (int i = 0; i < 5; ++i) blocks.push_back(block_with_yields(yield + step * i, 200.0));
                    expect_together_as_alone(SkippingMotion({"samples", dt, samples, {}, {}}), blocks,
                                             ways(true, polarity), std::to_string(samples.size()));
                }
}

// Each in its own way: slides without an earthquake, floats, is lifted by the motion, changes with slip; and the motion has a
// second component.
TEST(BlockTogether, other_cases)
{
    GroundMotion ground = wild_motion(6.0, 0.01, 2000);
    std::vector<RigidBlock> blocks(4, block_with_yields(1.0, 30.0));
    blocks[1] = block_with_yields(-0.5, 30.0);
    expect_together_as_alone(SkippingMotion(ground), blocks, ways(true, 1), "static failure");
    blocks[1] = block_with_yields(1.0, 30.0);
    blocks[2].vertical_force = -11.0;
    expect_together_as_alone(SkippingMotion(ground), blocks, ways(true, 1), "floats");
    blocks[2] = blocks[0];
    blocks[2].base_inclination = 1.2;
    expect_together_as_alone(SkippingMotion(ground), blocks, ways(true, 1), "lifted");
    blocks[2] = blocks[0];
    ground.accel_v = wild_motion(-3.0, 0.01, 2000).accel_h;
    expect_together_as_alone(SkippingMotion(ground), blocks, ways(true, 1), "vertical");
    ground.accel_v.clear();
    const SkippingMotion motion(ground);
    const SlipStages one{{0.0, blocks[0], 0.0}}, two{{0.0, blocks[0], 0.0}, {0.01, block_with_yields(0.8, 30.0), 0.0}};
    const std::vector<const SlipStages*> mixed{&one, &two, &one, &two};
    const std::vector<SlideResult> together = slide_together(motion, mixed, {});
    expect_same(together[0], slide(motion, one), "one stage");
    expect_same(together[3], slide(motion, two), "two stages");
    EXPECT_NE(together[0].slip, together[3].slip);
}

// The test above would hold if all of them went alone.
TEST(BlockTogether, plain_blocks_do_go_together)
{
    const SkippingMotion motion(wild_motion(6.0, 0.01, 2000));
    const SlideOptions options;
    const auto goes = [&](double up) {
        const SlipStages stages{{0.0, block_with_yields(1.0, up), 0.0}};
        std::vector<SlipMotion> blocks(4, SlipMotion(stages, options));
        return SlipMotion::pass_together(motion, 1.0, {&blocks[0], &blocks[1], &blocks[2], &blocks[3]});
    };
    EXPECT_EQ(goes(30.0), has_batched_runs()); // on a processor without them they go alone
    EXPECT_EQ(goes(1.0), has_batched_runs());  // both ways
}
