// A body on a seam that slides both ways: leaves its wedge, comes back, meets it.
#include "free_blocks.hpp"
#include "records/read/read_record.hpp"
#include "sliding/planes/seam.hpp"
#include "sliding/planes/seam_motion.hpp"
#include "source_dir.hpp"
#include "verification/exact/reference_scene.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace damslip {

namespace {

using sliding::Chain;
using sliding::ChainBlock;
using sliding::ChainInterface;
using sliding::SeamPlane;
using sliding::SeamSlide;
using sliding::SeamStage;
using sliding::SlideOptions;
using sliding::SlideResult;
using sliding::slide_seam;
constexpr double in_rad = std::numbers::pi / 180.0;

/// 5e6 kg/m on a level seam, before it 2e5 kg/m on a plane that rises by 25°; smooth between them.
SeamStage body_and_wedge()
{
    ChainBlock body, wedge;
    body.mass = 5e6;
    body.length = 1.0;
    body.force = {10e6, 0.0};
    body.uplift = 15e6;
    body.friction = 0.6;
    wedge.mass = 2e5;
    wedge.dip = -25.0 * in_rad;
    wedge.length = 8.0 / std::sin(25.0 * in_rad);
    wedge.friction = std::tan(40.0 * in_rad);
    ChainInterface face;
    face.length = 8.0;
    SeamStage stage;
    stage.chain.blocks = {body, wedge};
    stage.chain.interfaces = {face};
    stage.body.blocks = {body};
    return stage;
}

GroundMotion body_pulses(double up, double down)
{
    GroundMotion motion;
    motion.dt = 0.01;
    for (int i = 0; i <= 400; ++i) {
        const double s = std::sin(std::numbers::pi * i / 100.0);
        motion.accel_h.push_back((s < 0.0 ? up : down) * s * (i < 200 ? -1.0 : 1.0));
    }
    return motion;
}

TEST(SeamMotion, ImpactsAreThoseOfASmallStepIntegration)
{
    const SeamStage stage = body_and_wedge();
    const GroundMotion motion = body_pulses(9.0, 14.0);
    const SeamSlide found = slide_seam(motion, {stage}, {});
    // Level seam, smooth wedge: P = W₂ tan(φ + α), Σm, factor Σm/(Σm + m₂ tan α tan(φ + α)), all written out.
    const double m = 5e6, m2 = 2e5, tangent = std::tan(65.0 * in_rad), drive = 10e6, friction = 0.6 * (m * 9.81 - 15e6);
    const double together = (friction + m2 * 9.81 * tangent - drive) / (m + m2), alone = (friction - drive) / m,
                 back = (friction + drive) / m;
    const double inertia = m + m2 + m2 * std::tan(25.0 * in_rad) * tangent, ratio = m / inertia;
    double x = 0.0, v = 0.0, wedge = 0.0, gap = 0.0;
    int impacts = 0;
    constexpr int parts = 20000;
    for (int i = 0; i < 1200; ++i)
        for (int k = 0; k < (i < 400 ? parts : 2000); ++k) {
            const double h = 0.01 / (i < 400 ? parts : 2000);
            const double share = (k + 0.5) / parts;
            const double a = i < 400 ? motion.accel_h[std::size_t(i)] * (1.0 - share) + motion.accel_h[std::size_t(i) + 1] * share : 0.0;
            const bool touches = x >= wedge;
            double s = 0.0;
            if (v > 0.0 || (v == 0.0 && a > (touches ? together : alone)))
                s = touches ? (m + m2) / inertia * (a - together) : a - alone;
            else if (v < 0.0 || -a > back)
                s = a + back;
            double next = v + s * h;
            if ((v > 0.0 && next < 0.0) || (v < 0.0 && next > 0.0)) next = 0.0;
            const double before = x;
            x += 0.5 * (v + next) * h;
            v = next;
            if (touches && x > before) wedge = x;
            else if (before < wedge && x >= wedge) {
                v *= ratio;
                ++impacts;
                x = wedge;
            }
            gap = std::max(gap, wedge - x);
        }
    EXPECT_GE(found.impacts, 1);
    EXPECT_EQ(found.impacts, impacts);
    EXPECT_GT(gap, 0.05);
    EXPECT_NEAR(found.slide.max_gap, gap, 2e-5 * gap);
    EXPECT_NEAR(found.slide.slip, x, 2e-5 * std::abs(x));
    EXPECT_EQ(found.slide.status, Status::at_rest);
    EXPECT_GT(found.ledger.impact, 0.0);
    EXPECT_LT(std::abs(found.ledger.error()), 1e-9 * found.ledger.ground);
    // What the plastic impact of the two masses takes, by both rates.
    EXPECT_NEAR(sliding::yield_upstream_alone(stage.body).law.constant, back, 1e-12 * back);
}

/// Rate after over rate before: 25/27 of a body of 5e6 and a wedge of 2e5 kg/m.
TEST(SeamMotion, AnImpactLeaves25Of27)
{
    SeamStage stage = body_and_wedge();
    // Without weight nothing rubs. The ground throws the body back, a force of 0.5 m/s² brings it to the wedge at a known rate.
    stage.chain.gravity = stage.body.gravity = 0.0;
    for (Chain* chain : {&stage.chain, &stage.body}) {
        for (ChainBlock& b : chain->blocks) b.force = {}, b.uplift = 0.0;
        chain->blocks[0].force.x = 0.5 * 5e6;
    }
    GroundMotion motion;
    motion.dt = 0.1;
    motion.accel_h = {-1.0, -1.0, 0.0, 0.0, 0.0, 0.0, 0.0};
    SlideOptions options;
    options.sliding.run_out_max = 0.0;
    const SeamSlide found = slide_seam(motion, {stage}, options);
    ASSERT_EQ(found.impacts, 1);
    // s'' = -0.5, then rises to 0.5 m/s² in 0.1 s: v = -0.05 m/s and x = -1/120 m at 0.2 s; at x = 0 v² = 0.05² + 2 · 0.5/120.
    const double q = 1.0 / std::cos(25.0 * in_rad), chain_mass = 5e6 + 2e5 * q * q, square = 0.0025 + 1.0 / 120.0;
    const double lost = 0.5 * square * (5e6 - chain_mass * std::pow(25.0 / 27.0, 2.0));
    EXPECT_NEAR(found.ledger.impact, lost, 1e-10 * lost);
}

TEST(SeamMotion, WorksCloseWithEverything)
{
    Scene scene = exact::seam_scene();
    Seam& seam = scene.seams[0];
    seam.interface = {InterfaceModel::friction, std::nullopt, std::tan(15.0 * in_rad), 30e3};
    seam.dip = -2.0 * in_rad;
    seam.strength.cohesion = 40e3;
    seam.strength.residual_friction = 0.66;
    seam.strength.residual_slip = 0.05;
    seam.dilation = 2.0 * in_rad;
    seam.wedge->dilation = 4.0 * in_rad;
    seam.dilation_slip = 0.03;
    const SeamPlane plane = sliding::seam_plane(scene, seam, {{"static"}});
    ASSERT_EQ(plane.bodies.front().chain.blocks.size(), 2u);
    const std::string folder = std::string(source_dir()) + "/records/data/ec8_3.0_";
    GroundMotion motion;
    const Record h = records::read_record(folder + "h.csv");
    motion.dt = h.dt;
    for (const double a : h.acceleration) motion.accel_h.push_back(6.0 * a);
    for (const double a : records::read_record(folder + "v.csv").acceleration) motion.accel_v.push_back(0.5 * a);
    for (const int polarity : {1, -1}) {
        SlideOptions options;
        options.polarity = polarity;
        const SeamSlide found = slide_seam(motion, plane.bodies, options);
        EXPECT_GT(found.impacts, 0);
        EXPECT_GT(found.slide.upstream_slip, 1e-3);
        EXPECT_NEAR(found.slide.slip, found.slide.downstream_slip - found.slide.upstream_slip, 1e-12);
        EXPECT_LT(std::abs(found.ledger.error()), 1e-10 * std::abs(found.ledger.ground));
        EXPECT_LT(found.ledger.planes[0], 0.0);
        EXPECT_NE(found.ledger.interfaces[0], 0.0);
        options.sliding.two_way = false;
        EXPECT_EQ(slide_seam(motion, plane.bodies, options).slide.upstream_slip, 0.0);
    }
}

TEST(SeamMotion, IsTheOneWaySlideWhereNothingGoesBack)
{
    const Scene scene = exact::seam_scene();
    const SeamPlane plane = sliding::seam_plane(scene, scene.seams[0], {{"static"}});
    const std::string folder = std::string(source_dir()) + "/records/data/ec8_3.0_";
    GroundMotion motion;
    const Record h = records::read_record(folder + "h.csv");
    motion.dt = h.dt;
    motion.accel_h = h.acceleration;
    motion.accel_v = records::read_record(folder + "v.csv").acceleration;
    for (const int polarity : {1, -1}) {
        SlideOptions options;
        options.polarity = polarity;
        const SlideResult both = slide_seam(motion, plane.bodies, options).slide;
        options.sliding.two_way = false;
        const SlideResult one = sliding::slide(motion, plane.stages, options);
        EXPECT_NEAR(both.max_slip, one.max_slip, 1e-12);
        EXPECT_EQ(both.phases, one.phases);
        EXPECT_EQ(both.upstream_slip, 0.0);
    }
}

/// The body pushes a flat wedge that no motion here moves back, and is weak enough upstream to leave it.
SeamStage over_a_flat_wedge()
{
    SeamStage stage = body_and_wedge();
    ChainBlock &body = stage.chain.blocks[0], &wedge = stage.chain.blocks[1];
    body.friction = 0.45;
    body.force = {6e6, 0.0};
    wedge.dip = -10.0 * in_rad;
    wedge.friction = std::tan(50.0 * in_rad);
    stage.body.blocks = {body};
    return stage;
}

/// The same behind a block whose segment dips by 18°, with friction in the face between them.
SeamStage bent_body()
{
    SeamStage stage = over_a_flat_wedge();
    ChainBlock first;
    first.mass = 1.5e6;
    first.dip = 18.0 * in_rad;
    first.length = 20.0;
    first.friction = 0.3;
    first.uplift = 3e6;
    first.force = {1e6, -1e6};
    ChainInterface face;
    face.length = 12.0;
    face.friction = 0.6;
    for (Chain* chain : {&stage.chain, &stage.body}) {
        chain->blocks.insert(chain->blocks.begin(), first);
        chain->interfaces.insert(chain->interfaces.begin(), face);
        chain->dam = 1;
    }
    return stage;
}

/// A wedge that is nearly as weak as the body, so that it slows down later.
SeamStage with_a_weak_wedge()
{
    SeamStage stage = body_and_wedge();
    ChainBlock &body = stage.chain.blocks[0], &wedge = stage.chain.blocks[1];
    body.uplift = 0.0;
    body.friction = 0.7;
    body.force = {body.mass * (0.7 * 9.81 - 6.2), 0.0};
    wedge.mass = 1e6;
    wedge.dip = -4.0 * in_rad;
    wedge.friction = std::tan(30.0 * in_rad);
    stage.body.blocks = {body};
    return stage;
}

/// Twice downstream and back.
GroundMotion swings(double downstream, double upstream)
{
    GroundMotion motion;
    motion.dt = 0.01;
    for (int i = 0; i <= 400; ++i) {
        const double s = std::sin(std::numbers::pi * i / 100.0);
        motion.accel_h.push_back((s > 0.0 ? downstream : upstream) * s);
    }
    return motion;
}

/// Slips within 0.4 %, gaps within 1 %, the ledger to 1e-10.
SeamSlide as_free_blocks(const SeamStage& stage, const GroundMotion& motion, const FreeBlocksOptions& options = {})
{
    const SeamSlide found = slide_seam(motion, {stage}, {});
    const FreeBlocks free = slide_freely(stage.chain, motion, options);
    EXPECT_EQ(found.slide.status, Status::at_rest);
    constexpr double given_way = 3e-5; // by the springs
    EXPECT_NEAR(found.slide.slip, free.slip, 4e-3 * std::abs(free.slip) + given_way);
    EXPECT_NEAR(found.slide.max_slip, free.max_slip, 4e-3 * free.max_slip + given_way);
    EXPECT_NEAR(found.slide.max_gap, free.max_gap, 1e-2 * free.max_gap + given_way);
    EXPECT_EQ(found.slide.max_gap > 1e-4, free.openings > 0);
    EXPECT_LT(std::abs(found.ledger.error()), 1e-10 * found.ledger.ground);
    return found;
}

TEST(SeamMotion, IsThatOfFreeBlocksOnStiffSprings)
{
    const SeamSlide down = as_free_blocks(body_and_wedge(), swings(6.0, 1.0));
    EXPECT_EQ(down.slide.max_gap, 0.0);
    const SeamSlide both = as_free_blocks(over_a_flat_wedge(), swings(6.0, 7.5));
    EXPECT_EQ(both.impacts, 1);
    EXPECT_GT(both.slide.upstream_slip, 0.5);
    EXPECT_GT(both.slide.max_slip - both.slide.slip, 0.5);
}

TEST(SeamMotion, ABodyOfSeveralBlocksGoesBothWays)
{
    const SeamStage stage = bent_body();
    const SeamSlide found = as_free_blocks(stage, swings(6.0, 7.5));
    EXPECT_EQ(found.impacts, 1);
    EXPECT_GT(found.slide.upstream_slip, 0.2);
    EXPECT_LT(found.ledger.interfaces[0], 0.0); // friction between its blocks
    EXPECT_EQ(found.least_pressure, 0.0);
}

/// A path that dips to the ground before the toe: the rock there would have to climb back, and stays as a wedge does.
TEST(SeamMotion, RockThatWouldHaveToBePulledUpstreamStays)
{
    Scene scene = exact::seam_scene();
    Seam& seam = scene.seams[0];
    seam.wedge.reset();
    seam.exit = SeamExit::daylight;
    seam.depth.reset();
    seam.points = {{-30.0, 0.0}, {-1.0, -6.0}, {48.0, -8.0}, {80.0, -20.0}};
    scene.foundation->ground = {{-30.0, 0.0}, {0.0, 0.0}, {50.0, 0.0}, {80.0, -20.0}};
    const SeamPlane plane = sliding::seam_plane(scene, seam, {{"static"}});
    ASSERT_EQ(plane.bodies.size(), 1u);
    const SeamStage& stage = plane.bodies.front();
    ASSERT_EQ(stage.chain.blocks.size(), 3u);
    ASSERT_EQ(stage.body.blocks.size(), 2u);
    EXPECT_DOUBLE_EQ(stage.body.blocks[1].force.x, stage.chain.blocks[1].force.x - stage.chain.interfaces[1].water);
    EXPECT_GT(plane.upstream.law.constant, 0.0);
    EXPECT_LT(plane.upstream.law.constant, 20.0);
    const double back = 1.3 * plane.upstream.law.constant;
    const SeamSlide found = slide_seam(swings(back, back), plane.bodies, {});
    EXPECT_GT(found.impacts, 0);
    EXPECT_GT(found.slide.upstream_slip, 1e-2);
    EXPECT_LT(std::abs(found.ledger.error()), 1e-10 * found.ledger.ground);
}

TEST(SeamMotion, TheYieldGrowsBySlipInContactAndBothWays)
{
    SeamStage stage = over_a_flat_wedge();
    const GroundMotion motion = swings(6.0, 7.5);
    const double small = slide_seam(motion, {stage}, {}).slide.slip;
    constexpr double density = 3.0 * 2650.0;
    stage.growth = sliding::yield_growth(stage.chain, density);
    FreeBlocksOptions options;
    options.moved = density * stage.chain.interfaces[0].length;
    const SeamSlide found = as_free_blocks(stage, motion, options);
    EXPECT_EQ(found.impacts, 1);
    EXPECT_LT(found.slide.slip, 0.95 * small);
}

TEST(SeamMotion, GrowsAsTheOneWaySlideWhereNothingGoesBack)
{
    Scene scene = exact::seam_scene();
    scene.planes.geometry = PlaneGeometry::linear;
    const SeamPlane plane = sliding::seam_plane(scene, scene.seams[0], {{"static"}});
    const std::string folder = std::string(source_dir()) + "/records/data/ec8_3.0_";
    GroundMotion motion;
    const Record h = records::read_record(folder + "h.csv");
    motion.dt = h.dt;
    for (const double a : h.acceleration) motion.accel_h.push_back(1.5 * a);
    motion.accel_v = records::read_record(folder + "v.csv").acceleration;
    for (const bool vertical : {true, false}) {
        if (!vertical) motion.accel_v.clear();
        SlideOptions options;
        options.sliding.two_way = false;
        const SeamSlide found = slide_seam(motion, plane.bodies, options);
        const SlideResult one = sliding::slide(motion, plane.stages, options);
        ASSERT_GT(one.max_slip, 0.3);
        EXPECT_NEAR(found.slide.max_slip, one.max_slip, 1e-11);
        EXPECT_LT(std::abs(found.ledger.error()), 1e-10 * std::abs(found.ledger.ground));
    }
}

TEST(SeamMotion, AWedgeThatSlowsDownLaterRunsAhead)
{
    const SeamStage stage = with_a_weak_wedge();
    const SeamSlide found = as_free_blocks(stage, swings(25.0, 4.5));
    EXPECT_EQ(found.partings, 2);
    EXPECT_EQ(found.impacts, 1);
    EXPECT_GT(found.slide.max_gap, 0.01);
    EXPECT_GT(found.ledger.impact, 0.0);
    EXPECT_EQ(found.least_pressure, 0.0); // nothing pulls
    const sliding::SkippingMotion strong(swings(25.0, 4.5)), usual(swings(14.0, 9.0));
    EXPECT_TRUE(sliding::may_run_ahead(strong, {stage}, 1));
    EXPECT_FALSE(sliding::may_run_ahead(usual, {body_and_wedge()}, 1));
    // A wedge that the ground moves before the body: it slides by itself, and the body follows.
    SeamStage weaker = stage;
    weaker.chain.blocks[1].friction = std::tan(26.0 * in_rad);
    const SeamSlide first = as_free_blocks(weaker, swings(6.1, 4.0));
    EXPECT_EQ(first.slide.max_slip, 0.0);
    EXPECT_EQ(first.partings, 1);
}

} // namespace

} // namespace damslip
