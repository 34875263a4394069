// Slip on a seam with a passive wedge under a shipped record, against an independent integration of the chain of blocks.
#include "records/read/read_record.hpp"
#include "sliding/block/slide.hpp"
#include "sliding/block/yield.hpp"
#include "sliding/planes/seam.hpp"
#include "source_dir.hpp"
#include "verification/exact/reference_scene.hpp"

#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace damslip {

namespace {

constexpr double deg = std::numbers::pi / 180.0;

double slip(const Scene& scene, bool vertical, int polarity)
{
    const std::string folder = std::string(source_dir()) + "/records/data/ec8_3.0_";
    GroundMotion motion;
    const Record h = records::read_record(folder + "h.csv");
    motion.dt = h.dt;
    motion.accel_h = h.acceleration;
    if (vertical) motion.accel_v = records::read_record(folder + "v.csv").acceleration;
    sliding::SlideOptions options;
    options.polarity = polarity;
    options.sliding.two_way = false;
    const sliding::SeamPlane plane = sliding::seam_plane(scene, scene.seams[0], {{"static"}});
    return 1e3 * sliding::slide(motion, plane.stages, options).max_slip;
}

TEST(SeamSlip, IsThatOfAnIndependentIntegration)
{
    Scene scene = exact::seam_scene();
    const std::array<std::array<double, 4>, 2> printed{
        {{118.118290, 117.018739, 143.534387, 162.656935}, {24.705912, 40.060308, 41.165871, 65.840039}}};
    for (const std::array<double, 4>& row : printed) {
        std::size_t k = 0;
        for (const bool vertical : {false, true})
            for (const int polarity : {1, -1}) EXPECT_NEAR(slip(scene, vertical, polarity), row[k++], 2e-6);
        scene.seams[0].interface = {InterfaceModel::friction, std::nullopt, std::tan(20.0 * deg), 0.0};
    }
}

TEST(SeamSlip, StagesFollowStrengthDrainsAndDilation)
{
    Scene scene = exact::seam_scene();
    Seam& seam = scene.seams[0];
    seam.strength.cohesion = 50e3;
    seam.strength.residual_friction = 0.6;
    seam.strength.residual_slip = 0.02;
    seam.dilation = seam.wedge->dilation = 5.0 * deg;
    seam.dilation_slip = 0.01;
    scene.drains->lost_at_slip = 0.03;
    const sliding::SlipStages stages = sliding::seam_stages(scene, seam, 25.0 * deg, 0.0);
    std::vector<double> from, yields;
    for (const sliding::SlipStage& stage : stages) {
        from.push_back(stage.from_slip);
        yields.push_back(sliding::yield_acceleration(stage.block));
    }
    EXPECT_EQ(from, (std::vector<double>{0.0, 0.0, 0.01, 0.02, 0.03}));
    EXPECT_GT(yields[0], yields[1]);                    // cohesion is gone
    EXPECT_NEAR(yields[1], 0.799915098, 1e-8);          // as without it
    EXPECT_DOUBLE_EQ(yields[1], yields[2]);             // dilation changes the motion, not the yield
    EXPECT_GT(stages[1].block.chain_mass, stages[2].block.chain_mass);
    EXPECT_GT(yields[2], yields[3]);                    // residual friction
    EXPECT_GT(yields[3], yields[4]);                    // no drains
}

TEST(SeamSlip, GeometryMakesTheYieldGrow)
{
    Scene scene = exact::seam_scene();
    const double small = slip(scene, false, 1);
    const sliding::SeamPlane plane = sliding::seam_plane(scene, scene.seams[0], {{"static"}});
    scene.planes.geometry = PlaneGeometry::linear;
    const double linear = slip(scene, false, 1);
    EXPECT_LT(linear, small);
    // First order: the yield has grown by κ s, 0.6 % of a_y at the end.
    EXPECT_NEAR(linear / small, 1.0, 0.05);
    EXPECT_NEAR(plane.growth * small * 1e-3 / plane.yield, 0.0061, 2e-4);
}

/// A path that rises more steeply than its friction lets it slide has no yield, and no slip whatever shakes it.
TEST(SeamSlip, ALockedPathStaysAndHasItsStatus)
{
    Scene scene = exact::seam_scene();
    Seam& seam = scene.seams[0];
    seam.wedge.reset();
    seam.exit = SeamExit::daylight;
    seam.depth.reset();
    seam.points = {{0.0, -8.0}, {48.0, -8.0}, {50.0, 0.0}};
    const sliding::SeamPlane plane = sliding::seam_plane(scene, seam, {{"static"}});
    EXPECT_EQ(plane.status, sliding::ChainStatus::locked);
    EXPECT_TRUE(std::isinf(plane.yield));
    EXPECT_GT(plane.factors[0].factor, 1.0);
    for (const int polarity : {1, -1}) EXPECT_EQ(slip(scene, true, polarity), 0.0);
    seam.points.back() = {70.0, 0.0}; // less steep: it slides
    EXPECT_EQ(sliding::seam_plane(scene, seam, {{"static"}}).status, sliding::ChainStatus::stands);
    EXPECT_GT(slip(scene, true, -1), 0.0);
}

} // namespace

} // namespace damslip
