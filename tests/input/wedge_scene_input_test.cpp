// Scenes of a rock wedge that cannot be, and what is said.
#include "core/input_error.hpp"
#include "scene/read.hpp"
#include "scene/write.hpp"

#include <gtest/gtest.h>

namespace {

using namespace damslip;

const std::string wedge_good_text = R"([wedge]
density_kg_m3 = 2600
height_m = 40
face_dip_deg = 65
face_dip_direction_deg = 185
upper_dip_deg = 12
upper_dip_direction_deg = 195
[[wedge.plane]]
dip_deg = 45
dip_direction_deg = 105
friction_deg = 30
[[wedge.plane]]
dip_deg = 70
dip_direction_deg = 235
friction_deg = 20
cohesion_kPa = 48
)";

std::string wedge_said(const std::string& text)
{
    try {
        parse_scene(text, "w.toml", FileCheck::skip);
    } catch (const InputError& error) {
        return error.what();
    }
    return "(accepted)";
}

std::string wedge_with(const std::string& from, const std::string& to)
{
    std::string text = wedge_good_text;
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return wedge_said(text.replace(at, from.size(), to));
}

void wedge_expect(const std::string& said, const std::string& words)
{
    EXPECT_NE(said.find(words), std::string::npos) << said;
}

TEST(WedgeSceneInput, GoodOneIsReadAndWrittenAlike)
{
    EXPECT_EQ(wedge_said(wedge_good_text), "(accepted)");
    const Scene scene = parse_scene(wedge_good_text, "w.toml", FileCheck::skip);
    const std::string resolved = resolved_toml(scene);
    EXPECT_EQ(resolved.find("[section]"), std::string::npos);
    EXPECT_EQ(resolved.find("[contact]"), std::string::npos);
    EXPECT_EQ(resolved_toml(parse_scene(resolved, "w.toml", FileCheck::skip)), resolved);
}

TEST(WedgeSceneInput, UnitsOfEveryKey)
{
    const Scene m =
        parse_scene("[wedge]\ndensity_t_m3 = 2.6\nvolume_m3 = 100\nmotion_azimuth_rad = 1.5\n"
                    "[[wedge.plane]]\ndip_rad = 0.8\ndip_direction_rad = 1.8\nfriction = 0.5\narea_m2 = 20\n"
                    "cohesion_MPa = 0.02\nwater_pressure_kPa = 3\n"
                    "[[wedge.plane]]\ndip_deg = 70\ndip_direction_deg = 235\nfriction_deg = 45\narea_m2 = 30\n"
                    "[[wedge.force]]\nname = \"anchor\"\nforce_MN = 1.5\ntrend_deg = 90\nplunge_deg = -30\n",
                    "w.toml", FileCheck::skip);
    EXPECT_DOUBLE_EQ(m.wedge->density, 2600.0);
    EXPECT_DOUBLE_EQ(*m.wedge->motion_azimuth, 1.5);
    EXPECT_DOUBLE_EQ(m.wedge->planes[0].cohesion, 2e4);
    EXPECT_DOUBLE_EQ(*m.wedge->planes[0].water_pressure, 3e3);
    EXPECT_NEAR(m.wedge->planes[1].friction, 1.0, 1e-15);
    EXPECT_DOUBLE_EQ(m.wedge->forces[0].force, 1.5e6);
    EXPECT_EQ(m.wedge->planes[0].name, "plane 1");
}

TEST(WedgeSceneInput, RangesOfEveryKey)
{
    for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
             {"density_kg_m3 = 2600", "density_kg_m3 = 0"},
             {"height_m = 40", "height_m = -1"},
             {"face_dip_deg = 65", "face_dip_deg = 91"},
             {"face_dip_direction_deg = 185", "face_dip_direction_deg = 361"},
             {"upper_dip_deg = 12", "upper_dip_deg = 90"},
             {"upper_dip_direction_deg = 195", "upper_dip_direction_deg = -5"},
             {"dip_deg = 45", "dip_deg = 95"},
             {"dip_direction_deg = 105", "dip_direction_deg = nan"},
             {"friction_deg = 30", "friction_deg = 90"},
             {"cohesion_kPa = 48", "cohesion_kPa = -1"},
             {"cohesion_kPa = 48", "water_pressure_kPa = -1"},
             {"cohesion_kPa = 48", "area_m2 = -1"},
             {"height_m = 40", "height_m = 40\nwater = \"half\""},
             {"height_m = 40", "height_m = 40\ncohesion_lost_at_slip = 1"},
             {"height_m = 40", "height_m = 40\nmotion_azimuth_deg = 400"},
             {"cohesion_kPa = 48", "[[wedge.force]]\nforce_kN = 0\ntrend_deg = 0\nplunge_deg = 0"},
             {"cohesion_kPa = 48", "[[wedge.force]]\nforce_kN = 1\ntrend_deg = -1\nplunge_deg = 0"},
             {"cohesion_kPa = 48", "[[wedge.force]]\nforce_kN = 1\ntrend_deg = 0\nplunge_deg = 91"}})
        wedge_expect(wedge_with(from, to), "is not allowed.");
    wedge_expect(wedge_with("dip_deg = 45\n", ""), "wedge.plane[1].dip_deg is missing.");
    wedge_expect(wedge_with("height_m", "heigth_m"), "Did you mean wedge.height_m?");
    wedge_expect(wedge_said("wedge = 3\n"), "wedge = 3 is not allowed.");
}

TEST(WedgeSceneInput, ShapeIsGivenOneWay)
{
    wedge_expect(wedge_with("height_m = 40\n", ""), "wedge.height_m is missing.");
    wedge_expect(wedge_with("face_dip_deg = 65\n", ""), "wedge.face_dip_deg is missing.");
    wedge_expect(wedge_with("height_m = 40", "height_m = 40\nvolume_m3 = 5"),
                 "wedge.volume_m3 = 5 is given together with height or surfaces.");
    wedge_expect(wedge_with("friction_deg = 30", "friction_deg = 30\narea_m2 = 4"),
                 "wedge.plane[1].area_m2 = 4 is given together with wedge.height_m.");
    const std::string bare = "[wedge]\ndensity_kg_m3 = 2600\nvolume_m3 = 5\n" +
                             wedge_good_text.substr(wedge_good_text.find("[[wedge.plane]]"));
    wedge_expect(wedge_said(bare), "wedge.plane[1].area_m2 is missing.");
    wedge_expect(wedge_said("[wedge]\ndensity_kg_m3 = 2600\nvolume_m3 = 5\nwater = \"full\"\n" +
                            wedge_good_text.substr(wedge_good_text.find("[[wedge.plane]]"))),
                 "wedge.water = \"full\" is given without wedge.height_m.");
    wedge_expect(wedge_with("cohesion_kPa = 48", "water_pressure_kPa = 3\n[wedge_]"), "unknown table [wedge_]");
    wedge_expect(wedge_said("[wedge]\nwater = \"full\"\n" + wedge_good_text.substr(8) + "water_pressure_kPa = 3\n"),
                 "together with wedge.water = \"full\"");
}

TEST(WedgeSceneInput, TwoPlanesThatMeetInTheFace)
{
    const std::size_t second = wedge_good_text.rfind("[[wedge.plane]]");
    wedge_expect(wedge_said(wedge_good_text.substr(0, second)), "the wedge has 1 [[wedge.plane]].");
    wedge_expect(wedge_said(wedge_good_text + wedge_good_text.substr(second)), "the wedge has 3 [[wedge.plane]].");
    wedge_expect(wedge_with("dip_deg = 70\ndip_direction_deg = 235", "dip_deg = 45\ndip_direction_deg = 105"),
                 "are parallel.");
    wedge_expect(wedge_with("face_dip_deg = 65", "face_dip_deg = 25"),
                 "bound no wedge: the line of intersection plunges 31.197 degrees towards 157.73.");
    wedge_expect(wedge_with("face_dip_direction_deg = 185", "face_dip_direction_deg = 5"), "bound no wedge");
    wedge_expect(wedge_with("friction_deg = 30", "name = \"X\"\nfriction_deg = 30") == "(accepted)" ? wedge_said([] {
                     std::string t = wedge_good_text;
                     for (std::size_t at = 0; (at = t.find("friction_deg", at)) != std::string::npos; at += 26)
                         t.insert(at, "name = \"X\"\n");
                     return t;
                 }())
                                                                                                    : "",
                 "two planes are named \"X\".");
}

TEST(WedgeSceneInput, TablesOfADamHaveNoPlace)
{
    for (const char* table : {"[section]\nheight_m = 1\n", "[dam]\ndensity_kg_m3 = 2400\n", "[contact]\nfriction = 1\n",
                              "[reservoir]\n", "[uplift]\n", "[foundation]\n", "[[combination]]\nname = \"x\"\n",
                              "[time]\n", "[flexible_block]\nperiod_s = 1\n"})
        wedge_expect(wedge_said(wedge_good_text + table), "has no place in a scene of a [wedge].");
    EXPECT_EQ(wedge_said(wedge_good_text + "[criteria]\nallowable_slip_m = 0.1\n[sliding]\nrun_out_max_s = 5\n"),
              "(accepted)");
}

} // namespace
