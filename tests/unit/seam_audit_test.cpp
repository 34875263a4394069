// Seams and lifts where an independent reference found other numbers; the expected ones are its own, or identities.
#include "analysis/prepare/plane_model.hpp"
#include "analysis/prepare/rigid_model.hpp"
#include "records/read/read_record.hpp"
#include "scene/read.hpp"
#include "sliding/equilibrium/base_state.hpp"
#include "sliding/planes/lifts.hpp"
#include "sliding/planes/seam.hpp"
#include "source_dir.hpp"
#include "verification/exact/reference_scene.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace damslip::seam_audit {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

Scene parsed(const std::string& text)
{
    return parse_scene(text, "planes.toml", FileCheck::skip);
}

const std::string dam = "[section]\nheight_m = 40\nbase_m = 26\ncrest_m = 4\n[dam]\ndensity_kg_m3 = 2400\n[contact]\nfriction = 0.9\n";

/// Horizontal pulses, and vertical ones that take more than the weight.
GroundMotion lifting_motion()
{
    GroundMotion motion;
    motion.dt = 0.01;
    for (int i = 0; i < 400; ++i) {
        const double t = 0.01 * i;
        motion.accel_h.push_back(9.0 * std::sin(2.0 * std::numbers::pi * t));
        motion.accel_v.push_back(-14.0 * std::pow(std::sin(1.3 * std::numbers::pi * t), 2));
    }
    motion.accel_h.front() = motion.accel_h.back() = motion.accel_v.back() = 0.0;
    return motion;
}

TEST(AuditPlanes, FrictionOfZeroYieldsAtOnce)
{
    Scene scene = parsed(dam);
    scene.contact.friction = 0.0;
    EXPECT_EQ(sliding::base_limits(scene).yield_with_crack, 0.0);
}

TEST(AuditPlanes, ASeamUnderTheBaseLiftsOffAndSlidesAsTheBase)
{
    Scene scene = parsed(dam + "[reservoir]\nlevel_m = 18\nmodel = \"hydrostatic\"\n[uplift]\nmodel = \"linear\"\n"
                               "[foundation]\nyoung_modulus_GPa = 20\ndensity_kg_m3 = 2600\n[[seam]]\nname = \"S\"\ndepth_m = 0.2\nfriction = 0.9\n"
                               "uplift = \"linear\"\nexit = \"free-face\"\n");
    scene.seams[0].depth = 1e-4;
    for (const bool two_way : {false, true}) {
        scene.sliding.two_way = two_way;
        const sliding::SlideResult base = slide_model(scene, make_rigid_model(scene, {}), lifting_motion(), 1),
                                   seam = slide_model(scene, plane_model(scene, "S"), lifting_motion(), 1);
        EXPECT_GT(base.lift_offs, 0);
        EXPECT_GT(base.max_slip, 0.1);
        EXPECT_NEAR(seam.max_slip, base.max_slip, 1e-3 * base.max_slip);
    }
}

// Integrated beside this program with the yield at every friction of the path; it was 6e-4 off under vertical motion.
TEST(AuditPlanes, FrictionThatFallsOverTheSlipUnderVerticalMotion)
{
    Scene scene = exact::seam_scene();
    Contact& strength = scene.seams[0].strength;
    strength.residual_friction = 0.6;
    strength.residual_slip = 0.3;
    strength.residual_path = Interpolation::linear;
    const std::string folder = std::string(source_dir()) + "/records/data/ec8_3.0_";
    GroundMotion motion;
    const Record h = records::read_record(folder + "h.csv");
    motion.dt = h.dt;
    motion.accel_h = h.acceleration;
    motion.accel_v = records::read_record(folder + "v.csv").acceleration;
    const RigidModel model = plane_model(scene, "D");
    EXPECT_NEAR(1e3 * slide_model(scene, model, motion, 1).max_slip, 265.81, 0.01);
    EXPECT_NEAR(1e3 * slide_model(scene, model, motion, -1).max_slip, 317.97, 0.01);
}

// The first stage holds against the ground's push upstream, the second does not.
TEST(AuditPlanes, GoesUpstreamOnceItsPeakIsLost)
{
    Scene scene = exact::seam_scene();
    scene.reservoir.reset();
    scene.drains.reset();
    scene.seams[0].uplift = UpliftModel::none;
    Contact& strength = scene.seams[0].strength;
    strength.residual_friction = 0.3;
    strength.residual_slip = 0.01;
    scene.sliding.two_way = true;
    GroundMotion motion;
    motion.dt = 0.01;
    for (int i = 0; i < 200; ++i) motion.accel_h.push_back(i < 60 ? 12.0 : i < 160 ? -5.0 : 0.0);
    const RigidModel model = plane_model(scene, "D");
    ASSERT_GT(model.upstream.law.constant, 5.0);
    const double upstream = slide_bodies(scene, model, motion, 1).slide.upstream_slip;
    EXPECT_GT(upstream, 0.01);
    EXPECT_DOUBLE_EQ(slide_model(scene, model, motion, 1).upstream_slip, upstream);
}

TEST(AuditPlanes, AnAngleAtWhichTheWedgeFallsLeavesTheBodyAlone)
{
    Scene scene = exact::seam_scene();
    Seam& seam = scene.seams[0];
    seam.uplift = UpliftModel::linear; // the water carries the wedge below 44 degrees
    const std::vector<sliding::GroundState> states{{"static"}};
    seam.wedge->angles = {25.0 * degree};
    const sliding::SeamPlane falls = sliding::seam_plane(scene, seam, states);
    EXPECT_TRUE(falls.wedge_left_out);
    seam.wedge->angles = {25.0 * degree, 49.0 * degree};
    const sliding::SeamPlane both = sliding::seam_plane(scene, seam, states);
    EXPECT_DOUBLE_EQ(both.yield, falls.yield);
    EXPECT_DOUBLE_EQ(both.factors[0].factor, falls.factors[0].factor);
    seam.wedge->angles = {49.0 * degree};
    EXPECT_GT(sliding::seam_plane(scene, seam, states).factors[0].factor, both.factors[0].factor);
}

TEST(AuditPlanes, TheFrictionThatHoldsASearchedWedgeHoldsIt)
{
    Scene scene = exact::seam_scene();
    Seam& seam = scene.seams[0];
    seam.wedge->angles.clear();
    seam.strength.friction = sliding::seam_plane(scene, seam, {{"static"}}).holding_friction;
    const sliding::SeamPlane held = sliding::seam_plane(scene, seam, {{"static"}});
    EXPECT_NEAR(held.yield, 0.0, 1e-6);
    EXPECT_NEAR(held.factors[0].factor, 1.0, 1e-6);
}

// A lift that is cracked at rest is so in the smallest earthquake, too. By hand: 0.8907, 0.8112, 0.7448.
TEST(AuditPlanes, AnEarthquakeStartsFromTheCrackThatIsThere)
{
    const Scene scene = parsed(dam + "[reservoir]\nlevel_m = 40\nmodel = \"hydrostatic\"\n[uplift]\nmodel = \"linear\"\n"
                                     "crack = \"seismic-unchanged\"\n[lifts]\nelevations_m = [10]\nfriction = 0.9\nuplift = \"linear\"\n");
    const std::vector<sliding::GroundState> states{
        {"static"}, {"small", 1e-9}, {"0.05", 0.05 * 9.80665}, {"0.1", 0.1 * 9.80665}};
    const sliding::LiftPlane lift = sliding::lift_planes(scene, states)[0];
    EXPECT_NEAR(lift.states[0].factor, 0.8907, 1e-4);
    EXPECT_NEAR(lift.states[1].factor, lift.states[0].factor, 1e-7);
    EXPECT_NEAR(lift.states[2].factor, 0.8112, 1e-4);
    EXPECT_NEAR(lift.states[3].factor, 0.7448, 1e-4);
}

// ∫ of Westergaard's parabola times an amplification with kinks, in closed form.
TEST(AuditPlanes, AmplificationByPointsIsIntegratedBetweenThem)
{
    const Scene scene =
        parsed("[section]\nheight_m = 40\nbase_m = 32\ncrest_m = 5\n[dam]\ndensity_kg_m3 = 2400\n[contact]\nfriction = 0.9\n"
               "[reservoir]\nlevel_m = 40\nmodel = \"added-mass\"\n[added_mass]\nformula = \"westergaard-simplified\"\n"
               "[uplift]\nmodel = \"none\"\n[lifts]\nelevations_m = [10]\nfriction = 0.8\nuplift = \"none\"\n"
               "amplification = \"points\"\namplification_points_m = [[0, 1], [20, 1], [20.5, 3], [40, 3]]\n");
    EXPECT_NEAR(sliding::lift_planes(scene, std::vector<sliding::GroundState>{{"static"}})[0].mean_amplification, 2.034427, 1e-6);
}

// The plan of the rigid block leaves out lift joints and what crosses them; on the plane of one they are there. A stiff dam by finite elements
// slid 114 mm where the rigid block, without the anchor, slid 236 mm.
TEST(AuditPlanes, AnchorsThroughALiftCountOnIt)
{
    const auto scene_of = [&](const std::string& more) {
        return parsed("[section]\nheight_m = 40\nbase_m = 26\ncrest_m = 4\n[dam]\ndensity_kg_m3 = 2400\n[contact]\nfriction = 0.9\n"
                      "[reservoir]\nlevel_m = 36\nmodel = \"hydrostatic\"\n[uplift]\nmodel = \"none\"\n"
                      "[[lift_joint]]\nname = \"J\"\nelevation_m = 14\nfriction = 0.6\n[lifts]\nelevations_m = [14]\nfriction = 0.6\nuplift = \"none\"\n" +
                      more);
    };
    const std::string anchor = "[[anchor]]\nname = \"A\"\njoint = \"J\"\ndistance_m = 3\nfree_length_m = 50\narea_m2_m = 0.002\n"
                               "yield_strength_MPa = 1500\nprestress_kN_m = 800\ninclination_deg = 20\n";
    const std::vector<sliding::GroundState> rest{{"static"}};
    const sliding::LiftPlane without = sliding::lift_planes(scene_of(""), rest).front(), with = sliding::lift_planes(scene_of(anchor), rest).front();
    const double normal = 800e3 * std::cos(20.0 * degree), along = 800e3 * std::sin(20.0 * degree);
    EXPECT_NEAR(with.states[0].normal, without.states[0].normal + normal, 1e-6 * normal);
    EXPECT_NEAR(with.states[0].shear, without.states[0].shear - along, 1e-6 * along);

    GroundMotion motion = lifting_motion();
    motion.accel_v.clear();
    const auto slip_of = [&](const Scene& scene) {
        const Ready ready = prepare(scene, Method::rigid_block, std::make_shared<std::vector<RecordPair>>());
        EXPECT_TRUE(ready.scene.anchors.empty()); // of the base there is none
        const std::vector<RigidModel> models = all_models(ready);
        EXPECT_EQ(models.size(), 2u);
        EXPECT_EQ(models[1].anchors.size(), scene.anchors.size());
        return slide_model(scene, models[1], motion, 1).max_slip;
    };
    EXPECT_LT(slip_of(scene_of(anchor)), 0.8 * slip_of(scene_of("")));
}

} // namespace
} // namespace damslip::seam_audit
