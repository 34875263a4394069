// Blocks of constant yield and the batches: same bits with and without skipping, same slip as the general integrator.
#include "block_motions.hpp"
#include "sliding/block/rigid_block.hpp"
#include "sliding/block/slide_batch.hpp"
#include "verification/exact/block_slip.hpp"

#include <gtest/gtest.h>
#include <random>

using namespace damslip;
using namespace damslip::sliding;
using namespace damslip::test;

namespace {

constexpr double two_thirds[] = {0.02, 0.1, 0.3, 0.5, 0.7, 0.95}; // of the peak

SlideOptions ways(bool two_way)
{
    SlideOptions options;
    options.sliding.two_way = two_way;
    return options;
}

} // namespace

TEST(BlockConstantYield, skipping_gives_the_same_bits)
{
    for (const int n : {1, 5, 32, 33, 1023, 1024, 5000}) {
        const SkippingMotion motion(wild_motion(6.0, 0.01, n));
        for (const double ratio : two_thirds)
            for (const int polarity : {1, -1}) {
                ConstantYieldOptions options{polarity, 60.0, Scan::skip_blocks};
                const SlipSummary quick = slide_constant_yield(motion, {6.0 * ratio}, options);
                options.scan = Scan::every_sample;
                EXPECT_TRUE(quick == slide_constant_yield(motion, {6.0 * ratio}, options)) << n << " " << ratio;
                EXPECT_TRUE(quick == slide_constant_yield(motion.motion().accel_h, 0.01, 6.0 * ratio, options));
            }
    }
}

// Two independent codes for the same exact solution; the sums run in another order. 1e-12 of the path.
TEST(BlockConstantYield, agrees_with_the_general_integrator)
{
    const GroundMotion ground = wild_motion(6.0, 0.01, 4000);
    const SkippingMotion motion(ground);
    for (const double ratio : two_thirds)
        for (const double inclination : {0.0, 0.08}) {
            RigidBlock block = block_with_yields(6.0 * ratio, 10.0 * ratio);
            block.base_inclination = inclination;
            block.friction += std::tan(inclination);
            block.added_mass.xx = 0.4;
            const Yield yield = yield_downstream(block);
            const SlideResult general = slide(ground, block, ways(false));
            const SlipSummary quick = slide_constant_yield(motion, {yield.law.constant, yield.factor});
            EXPECT_NEAR(quick.slip, general.slip, 1e-12 * general.slip);
            EXPECT_NEAR(quick.max_slip, general.max_slip, 1e-12 * general.slip);
            EXPECT_NEAR(quick.peak_slip_rate, general.peak_slip_rate, 1e-12 * general.peak_slip_rate);
            EXPECT_EQ(quick.phases, general.phases);
            EXPECT_EQ(quick.status, general.status);
        }
}

// A block that is never lifted takes a way of its own; with a history every interval is crossed event by event.
TEST(BlockConstantYield, a_block_in_permanent_contact_slides_to_the_bits_of_the_general_integrator)
{
    GroundMotion ground = wild_motion(6.0, 0.01, 3000);
    for (const bool vertical : {false, true}) {
        if (vertical) ground.accel_v = wild_motion(-3.0, 0.01, 3000).accel_h;
        const SkippingMotion motion(ground);
        for (const double ratio : two_thirds)
            for (const bool two_way : {false, true})
                for (const double inclination : {0.0, 0.08})
                    for (const int polarity : {1, -1}) {
                        RigidBlock block = block_with_yields(6.0 * ratio, 10.0 * ratio);
                        block.base_inclination = inclination;
                        block.friction += std::tan(inclination);
                        block.added_mass.xx = 0.4;
                        SlideOptions options = ways(two_way);
                        options.polarity = polarity;
                        const SlideResult quick = slide(motion, {{0.0, block, 0.0}}, options);
                        options.history = HistoryOutput::samples;
                        const SlideResult general = slide(motion, {{0.0, block, 0.0}}, options);
                        EXPECT_EQ(quick.slip, general.slip);
                        EXPECT_EQ(quick.downstream_slip, general.downstream_slip);
                        EXPECT_EQ(quick.upstream_slip, general.upstream_slip);
                        EXPECT_EQ(quick.max_slip, general.max_slip);
                        EXPECT_EQ(quick.peak_slip_rate, general.peak_slip_rate);
                        EXPECT_EQ(quick.phases, general.phases);
                        EXPECT_EQ(quick.end_time, general.end_time);
                        EXPECT_EQ(quick.status, general.status);
                        if (general.phases == 0) continue; // no times
                        EXPECT_EQ(quick.first_slip_time, general.first_slip_time);
                        EXPECT_EQ(quick.last_slip_time, general.last_slip_time);
                    }
    }
}

// With a history every interval is crossed event by event.
TEST(BlockConstantYield, general_integrator_skips_to_the_same_bits)
{
    GroundMotion ground = wild_motion(6.0, 0.01, 3000);
    ground.accel_v = wild_motion(-12.0, 0.01, 3000).accel_h; // opens the base at times
    const SkippingMotion motion(ground);
    for (const LiftOff lift_off : {LiftOff::no_friction, LiftOff::ballistic})
        for (const int polarity : {1, -1}) {
            SlideOptions options;
            options.sliding.lift_off = lift_off;
            options.polarity = polarity;
            const SlipStages stages{{0.0, block_with_yields(3.0, 4.0), 0.0}, {0.01, block_with_yields(2.0, 3.0), 0.0}};
            const SlideResult quick = slide(motion, stages, options);
            options.history = HistoryOutput::samples;
            const SlideResult plain = slide(motion, stages, options);
            EXPECT_GT(plain.lift_offs, 0);
            EXPECT_EQ(plain.slip, quick.slip);
            EXPECT_EQ(plain.peak_slip_rate, quick.peak_slip_rate);
            EXPECT_EQ(plain.phases, quick.phases);
            EXPECT_EQ(plain.lift_offs, quick.lift_offs);
            EXPECT_EQ(plain.end_time, quick.end_time);
        }
}

TEST(BlockConstantYield, coasts_after_the_record_and_says_when_it_does_not_stop)
{
    const GroundMotion motion = steady(5.0, 1.0);
    const SlipSummary rest = slide_constant_yield(motion.accel_h, motion.dt, 2.0);
    EXPECT_LT(relative(rest.slip, exact::slip_under_rectangle(5.0, 1.0, 2.0)), 1e-14);
    EXPECT_EQ(rest.status, Status::at_rest);
    const SlipSummary cut =
        slide_constant_yield(motion.accel_h, motion.dt, 2.0, {1, 1.0, Scan::every_sample});
    EXPECT_EQ(cut.status, Status::sliding_at_end);
    EXPECT_LT(relative(cut.slip, 1.5 + 3.0 - 1.0), 1e-14);
    const SlipSummary fixed = slide_constant_yield(motion.accel_h, motion.dt, -0.5);
    EXPECT_EQ(fixed.status, Status::static_failure);
    EXPECT_LT(relative(fixed.slip, 0.5 * 5.5), 1e-14);
}

// The crossing rounds to the end of the interval: the movement starts on the sample, and there is nothing to divide by.
TEST(BlockConstantYield, starts_on_a_sample_above_the_yield_by_its_last_digit)
{
    const double above = std::nextafter(0.3, 1.0);
    const SkippingMotion motion({"last digit", 0.01, {0.0, -0.9, above, above, 0.0}, {}, {}});
    for (const Scan scan : {Scan::every_sample, Scan::skip_blocks}) {
        const SlipSummary s = slide_constant_yield(motion, {0.3}, {1, 60.0, scan});
        EXPECT_GT(s.downstream_slip, 0.0);
        EXPECT_LT(s.downstream_slip, 1e-19);
        EXPECT_EQ(s.phases, 1);
    }
}

TEST(BlockConstantYield, batches_do_not_depend_on_the_number_of_threads)
{
    std::vector<SkippingMotion> motions;
    for (const double peak : {2.0, 4.0, 7.0}) motions.emplace_back(wild_motion(peak, 0.01, 2000));
    std::vector<ConstantYield> yields;
    std::vector<SlipStages> blocks;
    for (int i = 1; i <= 13; ++i) {
        yields.push_back({0.4 * i});
        blocks.push_back({{0.0, block_with_yields(0.4 * i, 0.7 * i), 0.0}});
    }
    const int polarities[] = {1, -1};
    const auto one = slide_batch(motions, yields, polarities, ConstantYieldOptions{}, 1);
    ASSERT_EQ(one.size(), 3u * 13u * 2u);
    EXPECT_TRUE(one == slide_batch(motions, yields, polarities, ConstantYieldOptions{}, 2));
    EXPECT_TRUE(one == slide_batch(motions, yields, polarities, ConstantYieldOptions{}, 7));
    const std::size_t m = 1, y = 4, p = 1;
    EXPECT_TRUE(one[(m * 13 + y) * 2 + p] == slide_constant_yield(motions[m], yields[y], {-1, 60.0, Scan::every_sample}));
    const auto general = slide_batch(motions, blocks, polarities, ways(false), 3);
    for (std::size_t i = 0; i < one.size(); ++i) EXPECT_NEAR(general[i].slip, one[i].slip, 1e-12 * one[i].slip);
}

namespace {

/// White noise in steps of the samples, with some samples that repeat, cancel, or are zero: meets of yields and samples.
GroundMotion noise(unsigned seed, double dt, int samples, double grid)
{
    std::mt19937 random(seed);
    GroundMotion motion{"noise", dt, {0.0}, {}, {}};
    while (static_cast<int>(motion.accel_h.size()) < samples) {
        const double a = static_cast<double>(random() % 20001) / 10000.0 - 1.0;
        const double smooth = 0.7 * motion.accel_h.back() + a;
        motion.accel_h.push_back(grid > 0.0 ? grid * std::round(smooth / grid) : smooth);
    }
    return motion;
}

} // namespace

// Four yields go through a motion side by side; the plain run sees every sample of one block. Coarse grids of values
// put yields on samples, so that starts and stops fall on them.
TEST(BlockConstantYield, batches_have_the_bits_of_single_runs)
{
    std::vector<SkippingMotion> motions;
    for (unsigned seed = 1; seed <= 40; ++seed)
        motions.emplace_back(noise(seed, 0.005 * (seed % 5 + 1), 2 + 61 * static_cast<int>(seed),
                                   seed % 3 == 0 ? 0.0 : 0.05 * (seed % 4)));
    motions.emplace_back(wild_motion(3.0, 0.01, 5000));
    motions.emplace_back(steady(2.0, 1.0)); // drives at its first sample, and to its end
    GroundMotion with_vertical = wild_motion(3.0, 0.01, 700);
    with_vertical.accel_v = wild_motion(1.0, 0.01, 700).accel_h;
    motions.emplace_back(with_vertical);
    std::vector<ConstantYield> yields{{-0.1}, {0.0}, {0.5}};
    for (int i = 37; i >= 1; --i) yields.push_back({0.05 * i}); // not sorted
    for (ConstantYield& yield : yields) yield.factor = 0.9 + 0.1 * yield.acceleration;
    const int polarities[] = {1, -1};
    for (const double run_out : {0.0, 60.0}) {
        const auto batch = slide_batch(motions, yields, polarities, {1, run_out, Scan::skip_blocks}, 2);
        for (std::size_t i = 0; i < batch.size(); ++i) {
            const std::size_t m = i / 2 / yields.size(), y = i / 2 % yields.size();
            EXPECT_TRUE(batch[i] ==
                        slide_constant_yield(motions[m], yields[y], {polarities[i % 2], run_out, Scan::every_sample}))
                << "motion " << m << ", yield " << y << ", polarity " << polarities[i % 2];
        }
    }
}

TEST(BlockConstantYield, batch_passes_on_the_first_error)
{
    const std::vector<SkippingMotion> motions(1, SkippingMotion(steady(1.0, 1.0)));
    std::vector<SlipStages> blocks(5, SlipStages{{0.0, block_with_yield(0.5), 0.0}});
    blocks[3].front().block.mass = -1.0;
    const int polarities[] = {1};
    EXPECT_ANY_THROW(slide_batch(motions, blocks, polarities, SlideOptions{}, 2));
}
