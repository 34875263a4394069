// Bad scene files and the exact words their users read.
#include "core/input_error.hpp"
#include "scene/read.hpp"

#include <gtest/gtest.h>

namespace {

using namespace damslip;

const std::string good = R"([section]
height_m = 62.5
base_m = 45
crest_m = 12
neck_m = 11
[dam]
density_kg_m3 = 2500
[contact]
friction = 0.77
)";

std::string message(const std::string& text, FileCheck files = FileCheck::skip)
{
    try {
        parse_scene(text, "dam.toml", files);
    } catch (const InputError& error) {
        return error.what();
    }
    return "(accepted)";
}

std::string with(const std::string& from, const std::string& to)
{
    std::string text = good;
    return text.replace(text.find(from), from.size(), to);
}

bool has(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}

#define EXPECT_SAYS(text, part) EXPECT_TRUE(has(text, part)) << text

TEST(SceneInput, ValueOutOfRange)
{
    EXPECT_EQ(
        message(with("friction = 0.77", "friction = -0.77")),
        "dam.toml:9:12: error: contact.friction = -0.77 is not allowed.\n"
        "  expected: a number 0 ... 10: Coulomb mu, peak; or friction_deg, its angle (a dam on rock: 0.6 to 1.2)\n"
        "  fix:      for example  friction = 0.77");
}

TEST(SceneInput, UnknownKeyGetsASuggestion)
{
    EXPECT_EQ(
        message(with("friction = 0.77", "friction = 0.77\nresidual_pth = 3")),
        "dam.toml:10:1: error: unknown key contact.residual_pth. Did you mean contact.residual_path?\n"
        "  expected: keys of [contact]: friction, cohesion_kPa, cohesion_lost_at_slip, sliding, max_slip_m, "
        "residual_friction, "
        "residual_slip_m, residual_path, friction_table_m, separation, enforcement, "
        "tangential_stiffness_N_m3, slip_tolerance, normal, pressure_at_zero_clearance_kPa, "
        "clearance_at_zero_pressure_m, bond, tensile_strength_kPa, fracture_energy_tension_N_m, "
        "fracture_energy_shear_N_m, unloading, softening, dynamic_increase, kinetic_friction_ratio, characteristic_rate_m_s, relaxation_time_s, "
        "relaxation_slip_m, restitution\n"
        "  fix:      write  residual_path");
    EXPECT_SAYS(message(with("friction = 0.77", "friction = 0.77\ncohesion_kpa = 3")),
                "fix:      write  cohesion_kPa = 100");
}

TEST(SceneInput, MissingUnitInTheName)
{
    EXPECT_EQ(message(with("base_m = 45", "base = 45")), "dam.toml:1:1: error: section.base_m is missing.\n"
                                                         "  expected: polygon_m, or height_m, base_m and crest_m\n"
                                                         "  fix:      add  base_m = 45  or a polygon_m to [section]\n"
                                                         "dam.toml:3:1: error: section.base has no unit in its name.\n"
                                                         "  expected: base_m, base_mm, base_cm, base_ft\n"
                                                         "  fix:      write  base_m = 45");
    EXPECT_SAYS(message(with("base_m = 45", "base_yd = 45")), "section.base_yd has an unknown unit in its name.");
}

TEST(SceneInput, AllErrorsAtOnceInTheOrderOfTheFile)
{
    const std::string text = message("[section]\nheight_m = -1\nbase_m = \"45\"\n[dam]\ndensity_kg_m3 = "
                                     "nan\n[contact]\nfriction = 0.7\n[resevoir]\nlevel_m = 3\n");
    EXPECT_SAYS(text, "dam.toml:2:12: error: section.height_m = -1 is not allowed.");
    EXPECT_SAYS(text, "dam.toml:3:10: error: section.base_m = \"45\" is not allowed.");
    EXPECT_SAYS(text, "dam.toml:5:17: error: dam.density_kg_m3 = nan is not allowed.");
    EXPECT_SAYS(text, "dam.toml:8:2: error: unknown table [resevoir]. Did you mean [reservoir]?");
    EXPECT_LT(text.find(":2:12"), text.find(":8:2"));
}

// A dimension that is refused is not missing as well; a slope higher than the dam is no dam.
TEST(SceneInput, DimensionsOfTheSection)
{
    const std::string negative = message(with("height_m = 62.5", "height_m = -30"));
    EXPECT_SAYS(negative, "section.height_m = -30 is not allowed.");
    EXPECT_FALSE(has(negative, "is missing")) << negative;
    EXPECT_SAYS(message(with("height_m = 62.5\n", "")), "section.height_m is missing.");
    EXPECT_SAYS(message(with("crest_m = 12", "crest_m = 12\nupstream_slope = 0.1\nupstream_slope_height_m = 70")),
                "section.upstream_slope_height_m = 70 is above section.height_m = 62.5.");
    EXPECT_EQ(message(with("crest_m = 12", "crest_m = 12\nupstream_slope = 0.1\nupstream_slope_height_m = 62.5")),
              "(accepted)");
}

TEST(SceneInput, MissingRequiredKeys)
{
    const std::string text = message("[section]\nheight_m = 3\nbase_m = 2\n[dam]\n");
    EXPECT_SAYS(text, "error: contact.friction is missing.");
    EXPECT_SAYS(text, "dam.toml:4:1: error: dam.density_kg_m3 is missing.");
    EXPECT_SAYS(text, "add  density_kg_m3 = 2500  to [dam]");
}

TEST(SceneInput, SyntaxErrorHasItsPlace)
{
    EXPECT_SAYS(message("[section]\nheight_m = 62,5\n"), "dam.toml:2:14: error:");
    EXPECT_SAYS(message(good + "friction = 0.8\n"), "dam.toml:10");
}

TEST(SceneInput, WrongKindOfValue)
{
    EXPECT_SAYS(message(good + "cohesion_lost_at_slip = 1\n"),
                "dam.toml:10:25: error: contact.cohesion_lost_at_slip = 1 is not allowed.");
    EXPECT_SAYS(message(good + "residual_path = \"liner\"\n"), "fix:      write  residual_path = \"linear\"");
    EXPECT_SAYS(message("section = 3\n" + good.substr(good.find("[dam]"))),
                "dam.toml:1:11: error: section = 3 is not allowed.");
    EXPECT_SAYS(message(good + "[[reservoir]]\nlevel_m = 3\n"), "reservoir = [...] is not allowed.");
    EXPECT_SAYS(message(good + "[motion]\nrecord = 3\n"), "write  [[motion.record]]");
    EXPECT_SAYS(message(good + "[motion]\npolarity = 2\n"), "motion.polarity = 2 is not allowed.");
    EXPECT_SAYS(message(good + "[motion]\nscale = inf\n"), "motion.scale = inf is not allowed.");
}

TEST(SceneInput, TheSameKeyInTwoUnits)
{
    EXPECT_SAYS(message(good + "friction_deg = 40\n"),
                "contact.friction is given twice, as friction and friction_deg.");
}

TEST(SceneInput, PolygonMistakes)
{
    const std::string rest = "\n[dam]\ndensity_kg_m3 = 2500\n[contact]\nfriction = 0.77\n";
    const auto polygon = [&](const std::string& list) { return message("[section]\npolygon_m = " + list + rest); };
    EXPECT_EQ(polygon("[[0, 0], [45, 0], [12, 62.5], [0, 62.5]]"), "(accepted)");
    EXPECT_SAYS(polygon("[[0, 0], [0, 62.5], [12, 62.5], [45, 0]]"), "runs clockwise");
    EXPECT_SAYS(polygon("[[0, 0], [45, 0], [0, 62.5], [45, 62.5]]"),
                "crosses itself: edge (45, 0)-(0, 62.5) meets edge (45, 62.5)-(0, 0)");
    EXPECT_SAYS(polygon("[[1, 0], [45, 0], [0, 62.5]]"), "starts at (1, 0)");
    EXPECT_SAYS(polygon("[[0, 0], [45, 0]]"), "has 2 vertices");
    EXPECT_SAYS(polygon("[[0, 0], [45, 0], [45, 0], [0, 60]]"), "repeats the vertex (45, 0)");
    EXPECT_SAYS(polygon("[[0, 0], [45, 0], [60, -5], [60, 60], [0, 60]]"), "on or below the base");
    EXPECT_SAYS(polygon("[[0, 0], [45]]"), "a pair [a, b] of numbers");
    EXPECT_SAYS(message("[section]\npolygon_m = [[0, 0], [45, 0], [0, 60]]\nheight_m = 3" + rest),
                "polygon_m is given together with dimensions");
}

TEST(SceneInput, ChecksBetweenKeysNameBothValues)
{
    EXPECT_SAYS(message(good + "[curtain]\ndistance_m = 44.5\n"),
                "curtain.distance_m = 44.5 + curtain.thickness_m = 1, base length = 45 m");
    EXPECT_SAYS(message(good + "[foundation]\nyoung_modulus_GPa = 30\n[drains]\ndistance_m = 9\ndepth_m = 100\n"),
                "drains.depth_m = 100 reaches through the rock box, foundation.depth_m = 100.");
    EXPECT_SAYS(message(good + "residual_friction = 0.9\n"),
                "contact.residual_friction = 0.9 is above the peak value, contact.friction = 0.77");
    EXPECT_SAYS(message(good + "[uplift]\nmodel = \"curtain\"\n"), "needs a [curtain] with its distance_m");
    EXPECT_SAYS(message(good + "[uplift]\nmodel = \"points\"\npoints_m = [[0, 1], [40, 0]]\n"), "covers 0 to 40 m");
    EXPECT_SAYS(message(good + "[reservoir]\n[added_mass]\nperiod_s = 0.1\n"), "4 h/c = 0.1685 s");
    EXPECT_SAYS(message(good + "[[combination]]\nname = \"a\"\nice = true\n"),
                "combination[1].ice = true, but the scene has no [ice]");
    EXPECT_SAYS(message(good + "[[combination]]\nname = \"a\"\n[[combination]]\nname = \"a\"\n"),
                "two combinations are named \"a\"");
    EXPECT_SAYS(message(good + "[mesh]\nsize_m = 1\ncontact_size_m = 2\n"),
                "mesh.contact_size_m = 2 is above mesh.size_m = 1");
    EXPECT_SAYS(message(good + "[time]\nscheme = \"newmark\"\nalpha = -0.1\n"),
                "time.alpha belongs to time.scheme = \"hht\"");
    EXPECT_SAYS(message(with("crest_m = 12", "crest_m = 50")), "the crest ends at x = 50 m, downstream of the toe");
    EXPECT_SAYS(message(with("crest_m = 12\n", "")), "section.neck_m = 11 is given without section.crest_m");
    EXPECT_SAYS(message(with("neck_m = 11", "neck_m = 70")),
                "section.neck_m = 70 is not below section.height_m = 62.5");
    EXPECT_EQ(message(with("neck_m = 11", "neck_m = 70")).find("base_inclination"), std::string::npos)
        << "a key that the scene does not have";
}

TEST(SceneInput, RecordFilesHaveToExist)
{
    EXPECT_SAYS(message(good + "[[motion.record]]\nhorizontal = \"nowhere.at2\"\n", FileCheck::must_exist),
                "dam.toml:11:1: error: motion.record[1].horizontal: there is no file nowhere.at2.");
    EXPECT_SAYS(message(good + "[[motion.record]]\nhorizontal = \"a.at2\"\nunit = \"gs\"\n"),
                "motion.record[1].unit = \"gs\" is not allowed.");
}

TEST(SceneInput, MissingFileAndFolder)
{
    EXPECT_THROW(read_scene("no/such/scene.toml"), InputError);
    EXPECT_THROW(read_scene("/"), InputError);
}

TEST(SceneInput, ExpectationsAreChecked)
{
    EXPECT_EQ(message(good + "[expect]\nslip_m = { value = 1, digits = 6, source = \"hand\" }\n"), "(accepted)");
    EXPECT_SAYS(message(good + "[expect]\nslip_m = 1\n"), "expect.slip_m = 1 is not allowed.");
}

} // namespace
