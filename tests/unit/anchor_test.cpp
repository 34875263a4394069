// Anchors: the bar, the dowel's polygon, and the sliding block's balance of energy on random bars.
#include "scene/anchor_bar.hpp"
#include "sliding/block/slide_batch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <random>

namespace {

using namespace damslip;
using namespace damslip::sliding;

Anchor strand()
{
    Anchor a;
    a.name = "strand";
    a.free_length = 30.0;
    a.area = 0.002;
    a.yield_strength = 1600e6;
    a.inclination = 0.2;
    return a;
}

// The polygon lies inside the circle, at most 1 - cos(π/128) = 3.1e-4 of its radius, and touches it at its corners.
TEST(AnchorDowel, PolygonInTheCircle)
{
    for (int k = 0; k <= 1000; ++k) {
        const double n = k / 1000.0, radius = std::hypot(n, dowel_share(n));
        EXPECT_LE(radius, 1.0 + 1e-15) << n;
        EXPECT_GE(radius, 1.0 - 3.1e-4) << n;
    }
    for (int k = 0; k < dowel_chords; ++k) {
        const double n = dowel_chord(k).from;
        EXPECT_NEAR(dowel_share(n), std::sqrt(1.0 - n * n), 1e-14);
    }
    EXPECT_EQ(dowel_share(1.0), 0.0);
}

TEST(AnchorDowel, CountsLessTheFrictionItTakesAway)
{
    Anchor a = strand();
    a.dowel = true;
    const double shear = a.area * a.yield_strength / std::numbers::sqrt3;
    EXPECT_NEAR(anchor_bar(a, 0.7).dowel, shear * (std::cos(0.2) - 0.7 * std::sin(0.2)), 1e-9 * shear);
    a.inclination = -a.inclination;
    EXPECT_NEAR(anchor_bar(a, 0.7).dowel, shear * (std::cos(0.2) - 0.7 * std::sin(0.2)), 1e-9 * shear);
    a.inclination = 1.4; // so flat that it only lifts
    EXPECT_EQ(anchor_bar(a, 0.7).dowel, 0.0);
}

TEST(AnchorBar, YieldsAtItsSlip)
{
    for (const double psi : {0.0, 0.3, -0.3, 1.2}) {
        Anchor a = strand();
        a.inclination = psi;
        a.prestress = 1e6;
        const AnchorBar bar = anchor_bar(a, 0.7);
        const double way = (psi < 0.0 ? -1.0 : 1.0) * bar.slip_to_yield();
        AnchorHistory h = anchor_at_lock_off(bar);
        h.stretch_to(bar, bar.stretch(0.0, way));
        EXPECT_NEAR(h.force / bar.yield_force, 1.0, 1e-12) << psi;
        EXPECT_NEAR(h.plastic_strain, 0.0, 1e-14);
    }
}

TEST(AnchorBar, StaysSlackAfterYieldUntilItIsTautAgain)
{
    const AnchorBar bar = anchor_bar(strand(), 0.7);
    AnchorHistory h = anchor_at_lock_off(bar);
    const double yield = bar.length * bar.yield_strain();
    h.stretch_to(bar, 3.0 * yield);
    EXPECT_NEAR(h.plastic_work, 2.0 * yield * bar.yield_force, 1e-9 * h.plastic_work);
    h.stretch_to(bar, 1.5 * yield);
    EXPECT_EQ(h.force, 0.0);
    h.stretch_to(bar, 2.5 * yield);
    EXPECT_NEAR(h.force, 0.5 * bar.yield_force, 1e-9 * bar.yield_force);
}

GroundMotion rough_motion(std::mt19937& random)
{
    GroundMotion motion;
    motion.dt = 0.02;
    std::uniform_real_distribution<double> uniform(-6.0, 6.0);
    for (int k = 0; k < 200; ++k) motion.accel_h.push_back(k == 0 ? 0.0 : uniform(random));
    motion.accel_h.insert(motion.accel_h.end(), 2, 0.0);
    return motion;
}

AnchorBar random_bar(std::mt19937& random)
{
    std::uniform_real_distribution<double> part(0.0, 1.0);
    AnchorBar bar;
    bar.name = "bar";
    const double psi = 3.0 * (part(random) - 0.5);
    bar.length = 0.05 + part(random);
    bar.sine = std::sin(psi);
    bar.cosine = std::cos(psi);
    bar.yield_force = 3.0 * part(random);
    bar.axial_stiffness = bar.yield_force / (0.002 + 0.01 * part(random));
    bar.prestress = part(random) < 0.5 ? 0.0 : 0.6 * bar.yield_force;
    if (part(random) < 0.5) bar.rupture_strain = bar.yield_strain() * (1.1 + 3.0 * part(random));
    return bar;
}

/// Mass 1, g = 10, with the bars' prestress as make_rigid_block() gives it.
RigidBlock block_on(const std::vector<AnchorBar>& bars, double friction)
{
    RigidBlock block;
    block.mass = 1.0;
    block.gravity = 10.0;
    block.friction = friction;
    for (const AnchorBar& bar : bars) {
        block.horizontal_force -= bar.prestress * bar.sine;
        block.vertical_force += bar.prestress * bar.cosine;
        block.dowel_force += bar.dowel * dowel_share(bar.prestress / bar.yield_force);
    }
    return block;
}

// Without friction all work of the ground is in the block and its bars: ½ v² + stored + plastic + lost = ∫ a_h v dt + stored
// before. The integral by the trapezoid over samples a 16th of the motion's: (1.3 ms)²/12 of a curvature of some 100 of the
// whole per s², 1e-5; 1e-4 with a decade for bars that snap within a sample.
TEST(AnchoredBlock, EnergyIsInTheBarsWithoutFriction)
{
    std::mt19937 random(3);
    for (int trial = 0; trial < 15; ++trial) {
        const std::vector<AnchorBar> bars{random_bar(random), random_bar(random)};
        const GroundMotion coarse = rough_motion(random);
        constexpr int parts = 16;
        GroundMotion motion;
        motion.dt = coarse.dt / parts;
        for (std::size_t k = 0; k + 1 < coarse.accel_h.size(); ++k)
            for (int i = 0; i < parts; ++i)
                motion.accel_h.push_back(coarse.accel_h[k] + (coarse.accel_h[k + 1] - coarse.accel_h[k]) * i / parts);
        motion.accel_h.push_back(0.0);
        SlideOptions options;
        options.history = HistoryOutput::samples;
        options.sliding.run_out_max = 0.0;
        options.anchors = bars;
        const RigidBlock block = block_on(bars, 0.0);
        if (block.mass * block.gravity + block.vertical_force <= 0.0) continue;
        const SlideResult r = slide(motion, SlipStages{{0.0, block, 0.0}}, options);
        ASSERT_EQ(r.history.slip_rate.size(), motion.accel_h.size()) << trial;
        double work = 0.0, scale = 1e-6;
        for (std::size_t k = 0; k + 1 < motion.accel_h.size(); ++k) {
            work += 0.5 * motion.dt *
                    (motion.accel_h[k] * r.history.slip_rate[k] + motion.accel_h[k + 1] * r.history.slip_rate[k + 1]);
            scale = std::max(scale, std::abs(work));
        }
        double in_bars = 0.0;
        for (std::size_t i = 0; i < bars.size(); ++i) {
            const AnchorOutcome& bar = r.anchors[i];
            in_bars += bar.stored + bar.history.plastic_work + bar.history.loss -
                       0.5 * bars[i].prestress * bars[i].prestress / bars[i].stiffness();
        }
        const double v = r.history.slip_rate.back();
        EXPECT_NEAR(0.5 * v * v + in_bars, work, 1e-4 * scale) << trial;
    }
}

// Events are located, so the sampling of one and the same motion does not matter, whatever the bars and dowels do.
TEST(AnchoredBlock, SubdivisionDoesNotMatter)
{
    std::mt19937 random(11);
    int snapped = 0, yielded = 0;
    for (int trial = 0; trial < 60; ++trial) {
        std::vector<AnchorBar> bars{random_bar(random), random_bar(random)};
        if (trial % 2) bars[0].dowel = 0.3 * bars[0].yield_force;
        const GroundMotion coarse = rough_motion(random);
        GroundMotion fine;
        fine.dt = coarse.dt / 3.0;
        for (std::size_t k = 0; k + 1 < coarse.accel_h.size(); ++k)
            for (int i = 0; i < 3; ++i)
                fine.accel_h.push_back(coarse.accel_h[k] + (coarse.accel_h[k + 1] - coarse.accel_h[k]) * i / 3.0);
        fine.accel_h.push_back(0.0);
        SlideOptions options;
        options.anchors = bars;
        const SlipStages stages{{0.0, block_on(bars, 0.2), 0.0}};
        const SlideResult a = slide(coarse, stages, options), b = slide(fine, stages, options);
        EXPECT_NE(a.status, Status::not_resolved) << trial;
        EXPECT_NEAR(a.slip, b.slip, 1e-9 * std::max(1.0, a.max_slip)) << trial;
        EXPECT_NEAR(a.max_slip, b.max_slip, 1e-9 * std::max(1.0, a.max_slip)) << trial;
        const SkippingMotion skipping(coarse);
        EXPECT_EQ(slide(skipping, stages, options).slip, a.slip) << trial;
        const SkippingMotion motions[] = {skipping};
        const int polarities[] = {1};
        const SlipStages blocks[] = {stages};
        EXPECT_EQ(slide_batch(motions, blocks, polarities, options, 1).front().slip, a.slip) << trial;
        for (const AnchorOutcome& bar : a.anchors) {
            snapped += bar.history.snapped_at.has_value();
            yielded += bar.history.plastic_strain > 0.0;
        }
    }
    EXPECT_GT(snapped, 5);
    EXPECT_GT(yielded, 10);
}

// Bars that never come to pull leave the slip as it is.
TEST(AnchoredBlock, BarsWithoutForceChangeNothing)
{
    std::mt19937 random(5);
    const GroundMotion motion = rough_motion(random);
    AnchorBar bar = random_bar(random);
    bar.axial_stiffness = 1e-9;
    bar.yield_force = 1e-12;
    bar.prestress = 0.0;
    SlideOptions options;
    const SlipStages stages{{0.0, block_on({}, 0.2), 0.0}};
    const double plain = slide(motion, stages, options).slip;
    options.anchors = {bar};
    EXPECT_NEAR(slide(motion, stages, options).slip, plain, 1e-11);
}

TEST(AnchoredBlock, RefusesWhatHasNoForceOverSlip)
{
    SlideOptions options;
    options.anchors = {AnchorBar{"bar", 1.0, 0.0, 1.0, 1.0, 1.0, 0.0, {}, 0.0}};
    GroundMotion motion;
    motion.dt = 0.1;
    motion.accel_h = {0.0, 1.0};
    options.sliding.lift_off = LiftOff::ballistic;
    EXPECT_THROW(slide(motion, SlipStages{{0.0, block_on({}, 0.2), 0.0}}, options), InputError);
    options.sliding.lift_off = LiftOff::no_friction;
    options.sliding.scheme = SlidingScheme::slammer;
    EXPECT_THROW(slide(motion, SlipStages{{0.0, block_on({}, 0.2), 0.0}}, options), InputError);
}

/// The block with an uplift `change` higher while it slides either way, by a crack or from the start.
struct WetBlocks {
    RigidBlock cracking, wet;
};

WetBlocks wet_blocks(const RigidBlock& block, double change)
{
    WetBlocks blocks{block, block};
    OpeningUplift opening;
    opening.accel_v = {0.0};
    opening.downstream = opening.upstream = {change};
    blocks.cracking.opening = std::make_shared<const OpeningUplift>(opening);
    blocks.wet.uplift += change;
    return blocks;
}

// A crack whose uplift is the same whichever way the block slides decides start, slide and stop as that uplift does from the
// beginning: beside anchors and beside friction over the rate, with and without lag. Round-off apart.
TEST(OpeningWater, BesideAnchorsAndRates)
{
    std::mt19937 random(5);
    int slid = 0;
    for (int trial = 0; trial < 40; ++trial) {
        const GroundMotion motion = rough_motion(random);
        const bool anchored = trial % 2 == 0;
        std::vector<AnchorBar> bars;
        if (anchored) bars = {random_bar(random), random_bar(random)};
        const WetBlocks blocks = wet_blocks(block_on(bars, 0.35), 3.0);
        RateFriction rate;
        if (!anchored) {
            rate.kinetic_ratio = 0.6;
            rate.characteristic_rate = 0.02;
            if (trial % 4 == 1) rate.relaxation_time = 0.05;
            if (trial % 8 == 1) rate.relaxation_slip = 0.01;
        }
        SlideOptions options;
        options.anchors = bars;
        const SlideResult a = slide(motion, SlipStages{{0.0, blocks.cracking, 0.0, rate}}, options),
                          b = slide(motion, SlipStages{{0.0, blocks.wet, 0.0, rate}}, options);
        if (b.status == Status::static_failure) continue;
        EXPECT_EQ(a.status, b.status) << trial;
        EXPECT_EQ(a.phases, b.phases) << trial;
        EXPECT_NEAR(a.slip, b.slip, 1e-9 * std::max(1e-3, b.max_slip)) << trial;
        slid += b.max_slip > 1e-3;
    }
    EXPECT_GT(slid, 20);
}

// Mirrored motion, mirrored cracks, mirrored slip: each direction has its own crack, at rest too.
TEST(OpeningWater, EachDirectionHasItsOwnBesideRates)
{
    std::mt19937 random(6);
    RateFriction rate;
    rate.kinetic_ratio = 0.7;
    rate.characteristic_rate = 0.05;
    rate.relaxation_time = 0.1;
    for (int trial = 0; trial < 10; ++trial) {
        GroundMotion motion = rough_motion(random), mirrored = motion;
        for (double& a : mirrored.accel_h) a = -a;
        RigidBlock block = block_on({}, 0.35), swapped = block;
        OpeningUplift opening;
        opening.accel_v = {0.0};
        opening.downstream = {4.0};
        opening.upstream = {0.5};
        block.opening = std::make_shared<const OpeningUplift>(opening);
        std::swap(opening.downstream, opening.upstream);
        swapped.opening = std::make_shared<const OpeningUplift>(opening);
        const SlideResult a = slide(motion, SlipStages{{0.0, block, 0.0, rate}}),
                          b = slide(mirrored, SlipStages{{0.0, swapped, 0.0, rate}});
        EXPECT_GT(a.slip, 0.0) << trial; // the wet crack is downstream's
        EXPECT_NEAR(a.slip, -b.slip, 1e-12 * a.max_slip) << trial;
    }
}

} // namespace
