// Rock slopes that cannot be, and what a right one becomes.
#include "core/input_error.hpp"
#include "scene/read.hpp"
#include "scene/section.hpp"
#include "scene/write.hpp"

#include <gtest/gtest.h>

namespace {

using namespace damslip;

std::string slope_scene_text(const std::string& section, const std::string& more = {})
{
    return "[section]\n" + section + "[dam]\ndensity_kg_m3 = 2600\n[contact]\nfriction_deg = 37\n" + more;
}

std::string slope_message(const std::string& section, const std::string& more = {})
{
    try {
        parse_scene(slope_scene_text(section, more), "slope.toml", FileCheck::skip);
    } catch (const InputError& error) {
        return error.what();
    }
    return "(accepted)";
}

const std::string good_slope = "slope_height_m = 12\nface_dip_deg = 60\nplane_dip_deg = 35\ncrack_distance_m = 4\n";

TEST(RockSlopeInput, NeedsItsFourFigures)
{
    EXPECT_EQ(slope_message(good_slope), "(accepted)");
    EXPECT_EQ(slope_message("slope_height_m = 12\nface_dip_deg = 60\nplane_dip_deg = 35\n"),
              "slope.toml:1:1: error: section.crack_distance_m is missing.\n"
              "  expected: slope_height_m, face_dip_deg, plane_dip_deg and crack_distance_m of a rock slope\n"
              "  fix:      add  crack_distance_m = 4  to [section]");
    const std::string all = slope_message("upper_dip_deg = 5\n");
    for (const char* key : {"slope_height_m", "face_dip_deg", "plane_dip_deg", "crack_distance_m"})
        EXPECT_NE(all.find(std::string("section.") + key + " is missing."), std::string::npos) << key;
}

TEST(RockSlopeInput, IsOneDescription)
{
    EXPECT_NE(slope_message(good_slope + "height_m = 3\n").find("rock slope together with a polygon or dimensions"),
              std::string::npos);
    EXPECT_NE(slope_message(good_slope + "polygon_m = [[0, 0], [2, 0], [0, 3]]\n")
                  .find("rock slope together with a polygon or dimensions"),
              std::string::npos);
}

TEST(RockSlopeInput, PlaneComesOutInTheFace)
{
    EXPECT_EQ(slope_message("slope_height_m = 12\nface_dip_deg = 30\nplane_dip_deg = 35\ncrack_distance_m = 4\n"),
              "slope.toml:4:1: error: section.plane_dip_deg = 35 is not flatter than section.face_dip_deg = 30.\n"
              "  expected: a plane that comes out in the face: plane_dip_deg < face_dip_deg\n"
              "  fix:      exchange them, if mixed up");
    EXPECT_NE(slope_message(good_slope + "upper_dip_deg = -50\n").find("upper_dip_deg"), std::string::npos);
    EXPECT_NE(slope_message("slope_height_m = 12\nface_dip_deg = 60\nplane_dip_deg = 50\ncrack_distance_m = 4\n")
                  .find("plane_dip_deg"),
              std::string::npos);
}

TEST(RockSlopeInput, CrackCutsTheBlock)
{
    // The plane comes up 12 cot 35 - 12 cot 60 = 10.2 m behind the crest; the toe is 6.93 m before it.
    const auto crack = [](const std::string& distance) {
        return slope_message(
            "slope_height_m = 12\nface_dip_deg = 60\nplane_dip_deg = 35\ncrack_distance_m = " + distance + "\n");
    };
    EXPECT_EQ(crack("10.2"), "(accepted)");
    EXPECT_NE(crack("10.3").find("the plane has come up to the surface before the crack"), std::string::npos);
    EXPECT_EQ(crack("-6.9"), "(accepted)");
    EXPECT_NE(crack("-7").find("puts the crack before the slope"), std::string::npos);
    EXPECT_NE(crack("nan").find("crack_distance"), std::string::npos);
}

TEST(RockSlopeInput, WaterFitsIntoTheCrack)
{
    EXPECT_EQ(slope_message(good_slope, "[reservoir]\nlevel_m = 4.34\n"), "(accepted)");
    const std::string message = slope_message(good_slope, "[reservoir]\nlevel_m = 4.4\n");
    EXPECT_NE(message.find("slope.toml:11:1: error: reservoir.level_m = 4.4 does not fit into the tension crack"),
              std::string::npos)
        << message;
}

TEST(RockSlopeInput, WaterInTheCrackPressesAndSeepsOut)
{
    const Scene scene = parse_scene(slope_scene_text(good_slope, "[reservoir]\n"), "slope.toml", FileCheck::skip);
    EXPECT_EQ(scene.reservoir->model, ReservoirModel::hydrostatic);
    EXPECT_DOUBLE_EQ(scene.reservoir->level, upstream_face(scene.section).back().y); // to the rim
    ASSERT_TRUE(scene.uplift);
    EXPECT_EQ(scene.uplift->model, UpliftModel::linear);
    // What the scene says itself stays.
    const Scene own =
        parse_scene(slope_scene_text(good_slope, "[reservoir]\nmodel = \"added-mass\"\n[uplift]\nmodel = \"none\"\n"),
                    "slope.toml", FileCheck::skip);
    EXPECT_EQ(own.reservoir->model, ReservoirModel::added_mass);
    EXPECT_EQ(own.uplift->model, UpliftModel::none);
}

TEST(RockSlopeInput, ResolvedSceneIsTheSameBlock)
{
    const Scene scene = parse_scene(slope_scene_text(good_slope + "upper_dip_deg = 5\n", "[reservoir]\nlevel_m = 3\n"),
                                    "slope.toml", FileCheck::skip);
    const Scene again = parse_scene(resolved_toml(scene), "again.toml", FileCheck::skip);
    EXPECT_EQ(again.section.polygon, scene.section.polygon);
    EXPECT_EQ(scene_hash(again), scene_hash(scene));
}

} // namespace
