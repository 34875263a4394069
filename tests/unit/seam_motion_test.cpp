// A body on a seam that slides both ways: leaves its wedge, comes back, meets it.
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
    // Without friction, load and weight's push the body swings freely: after the impact the chain is at once at rest on ice.
    stage.chain.gravity = stage.body.gravity = 0.0;
    for (Chain* chain : {&stage.chain, &stage.body})
        for (ChainBlock& b : chain->blocks) b.force = {}, b.uplift = 0.0;
    GroundMotion motion;
    motion.dt = 0.1;
    // Back by -1 m/s² for 0.1 s with ramps, then forward by the same impulse twice: it meets the wedge at a known rate.
    motion.accel_h = {0.0, -1.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0};
    SlideOptions options;
    options.sliding.run_out_max = 0.0;
    const SeamSlide found = slide_seam(motion, {stage}, options);
    ASSERT_EQ(found.impacts, 1);
    // Kinetic energy at the end over that before the impact: M (25/27)² of ½ m v² with M the chain's kinetic mass.
    const double q = 1.0 / std::cos(25.0 * in_rad), kinetic_mass = 5e6 + 2e5 * q * q;
    const double before = found.ledger.impact + found.ledger.kinetic, rate = std::sqrt(2.0 * before / 5e6);
    EXPECT_NEAR(std::sqrt(2.0 * found.ledger.kinetic / kinetic_mass) / rate, 25.0 / 27.0, 1e-9);
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
        EXPECT_LT(std::abs(found.ledger.error()), 1e-9 * std::abs(found.ledger.ground));
        EXPECT_LT(found.ledger.planes[0], 0.0);
        EXPECT_NE(found.ledger.interfaces[0], 0.0);
        options.sliding.two_way = false;
        EXPECT_EQ(slide_seam(motion, plane.bodies, options).impacts, 0);
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

} // namespace

} // namespace damslip
