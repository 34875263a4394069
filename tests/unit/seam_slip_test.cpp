// Slip on a seam with a passive wedge under a shipped record, against an independent integration of the chain of blocks.
#include "analysis/screen/screening.hpp"
#include "records/read/read_record.hpp"
#include "scene/read.hpp"
#include "sliding/block/rigid_block.hpp"
#include "sliding/block/slide.hpp"
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

/// Factor of the seam in a state of the screening.
double factor_in(const Scene& scene, const std::string& state)
{
    const Screening screening = run_screening(prepare(scene, Method::rigid_block), 1);
    const Planes& planes = screening.planes;
    for (std::size_t k = 0; k < planes.states.size(); ++k)
        if (planes.states[k].ground.name == state) return planes.rows.back().factors[k].value();
    ADD_FAILURE() << state;
    return 0.0;
}

// A combination with a water level, drains or partial factors of its own is the scene with them.
TEST(SeamSlip, CombinationsAreScenesOfTheirOwn)
{
    Scene scene = read_scene(std::string(source_dir()) + "/examples/seam_dam.toml");
    for (const char* name : {"usual", "low", "no drains", "halved"}) scene.combinations.emplace_back().name = name;
    scene.combinations[1].reservoir_level = 55.0;
    scene.combinations[2].drains_effective = false;
    scene.combinations[3].friction_divisor = scene.combinations[3].cohesion_divisor = 2.0;
    Scene low = scene, undrained = scene;
    low.reservoir->level = 55.0;
    undrained.drains->efficiency = 0.0;
    EXPECT_NEAR(factor_in(scene, "low"), factor_in(low, "usual"), 1e-9);
    EXPECT_NEAR(factor_in(scene, "no drains"), factor_in(undrained, "usual"), 1e-9);
    EXPECT_NEAR(factor_in(scene, "halved"), 0.5 * factor_in(scene, "usual"), 1e-9);
    EXPECT_GT(factor_in(scene, "low"), 1.1 * factor_in(scene, "usual"));
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

/// What is kept of a seam for many frictions gives the bits of a seam made anew, and serves no other path or wedge.
TEST(SeamGround, ServesSeamsOfOtherStrengthsAlone)
{
    Scene scene = exact::seam_scene();
    Seam& seam = scene.seams[0];
    seam.wedge->angles.clear();
    const sliding::SeamGround ground(scene, seam);
    ASSERT_GT(ground.scan().size(), 100u);
    std::vector<double> yields;
    for (const double friction : {0.55, 0.7, 0.9})
        for (const InterfaceModel model : {InterfaceModel::smooth, InterfaceModel::friction}) {
            Seam other = seam;
            other.strength.friction = friction;
            other.wedge->friction = friction + 0.1;
            other.interface.model = model;
            other.interface.friction = 0.3;
            ASSERT_TRUE(ground.serves(other));
            const sliding::SeamPlane kept = sliding::seam_plane(scene, other, {}, ground), anew = sliding::seam_plane(scene, other, {});
            EXPECT_EQ(kept.yield, anew.yield);
            EXPECT_EQ(kept.angle, anew.angle);
            EXPECT_EQ(kept.yield, sliding::seam_plane(scene, other, {{"static"}}).yield); // searched with its factors
            yields.push_back(kept.yield);
        }
    EXPECT_GT(yields.back(), yields.front() + 0.1);
    const auto serves = [&](auto change) {
        Seam other = seam;
        change(other);
        return ground.serves(other);
    };
    EXPECT_FALSE(serves([](Seam& s) { s.wedge->search_to -= 0.1; }));
    EXPECT_FALSE(serves([](Seam& s) { s.wedge->distance += 1.0; }));
    EXPECT_FALSE(serves([](Seam& s) { s.wedge.reset(); }));
    EXPECT_FALSE(serves([](Seam& s) { s.uplift = UpliftModel::linear; }));
    EXPECT_FALSE(serves([](Seam& s) { s.depth = s.depth.value_or(8.0) + 1.0; }));
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
