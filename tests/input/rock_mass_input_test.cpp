// Rock with mass: what it needs, and what it does not go together with.
#include "core/input_error.hpp"
#include "scene/read.hpp"

#include <gtest/gtest.h>

namespace {

using namespace damslip;

std::string rock_message(const std::string& foundation, const std::string& more = {}, const std::string& toe = "45, 0")
{
    try {
        parse_scene("[section]\npolygon_m = [[0, 0], [" + toe +
                        "], [12, 60], [0, 60]]\n[dam]\ndensity_kg_m3 = 2500\nyoung_modulus_GPa = 25\n[foundation]\n"
                        "young_modulus_GPa = 30\n" +
                        foundation + "[contact]\nfriction = 0.77\n" + more,
                    "dam.toml", FileCheck::skip);
    } catch (const InputError& error) {
        return error.what();
    }
    return "(accepted)";
}

const std::string heavy = "density_kg_m3 = 2650\nmass = \"with-mass\"\n", massless = "mass = \"massless\"\n",
                  fixed = "boundary = \"fixed\"\n", viscous = "boundary = \"viscous\"\n";

TEST(RockMassInput, NeedsADensity)
{
    EXPECT_EQ(rock_message("mass = \"with-mass\"\n" + fixed),
              "dam.toml:8:1: error: foundation.mass = \"with-mass\" with foundation.density_kg_m3 = 0.\n"
              "  expected: the density of the rock: 2500 ... 2900 kg/m3 is usual\n"
              "  fix:      write  density_kg_m3 = 2650  in [foundation], or  mass = \"massless\"  for rock without "
              "inertia");
    EXPECT_EQ(rock_message("density_kg_m3 = 0\n"), // would run as 2650
              "dam.toml:8:1: error: foundation.density_kg_m3 = 0 with foundation.mass = \"with-mass\".\n"
              "  expected: the density of the rock: 2500 ... 2900 kg/m3 is usual; left out it is 2650 where rock radiates\n"
              "  fix:      delete density_kg_m3, or write  mass = \"massless\"  for rock without inertia");
    EXPECT_EQ(rock_message(""), "(accepted)");
    EXPECT_EQ(rock_message(heavy + fixed), "(accepted)");
    EXPECT_EQ(rock_message("density_kg_m3 = 2650\n" + massless), "(accepted)"); // weight only
}

TEST(RockMassInput, ViscousEdgesNeedMassAndALevelBase)
{
    EXPECT_EQ(
        rock_message(massless + viscous),
        "dam.toml:9:1: error: foundation.boundary = \"viscous\" with foundation.mass = \"massless\": no waves travel "
        "there.\n"
        "  expected: mass = \"with-mass\" for viscous edges, no boundary for massless rock\n"
        "  fix:      write  mass = \"with-mass\"  in [foundation], or delete boundary");
    EXPECT_EQ(rock_message(heavy + viscous), "(accepted)");
    EXPECT_EQ(rock_message(heavy + viscous, "", "45, -3"),
              "dam.toml:10:1: error: foundation.boundary = \"viscous\" with a toe 3 m below the heel.\n"
              "  expected: a level base: the free field is that of a half space with a level surface\n"
              "  fix:      write  boundary = \"fixed\"  in [foundation], or level the base");
    EXPECT_EQ(rock_message(heavy + fixed, "", "45, -3"), "(accepted)");
}

TEST(RockMassInput, DoesNotSlideFar)
{
    EXPECT_EQ(rock_message(heavy + fixed, "sliding = \"finite\"\n"),
              "dam.toml:9:1: error: foundation.mass = \"with-mass\" with contact.sliding = \"finite\".\n"
              "  expected: contact.sliding = \"small\": the rock's nodes stay opposite the dam's\n"
              "  fix:      write  sliding = \"small\"  in [contact], or  mass = \"massless\"  in [foundation]");
    EXPECT_NE(rock_message(heavy + fixed, "[mesh]\nfile = \"dam.msh\"\n").find("with mesh.file = "), std::string::npos);
    EXPECT_NE(rock_message(heavy + fixed, "[mesh]\nrock_contact_size_m = 2\n").find("with mesh.rock_contact_size_m."),
              std::string::npos);
}

TEST(RockMassInput, RockSizeNeedsRock)
{
    EXPECT_NE(
        rock_message("depth_m = 100\n", "[mesh]\nrock_size_m = 0.1\n").find("elements along the 100 m of the rock"),
        std::string::npos);
    EXPECT_NE(rock_message("boundary = \"soft\"\n").find("foundation.boundary"), std::string::npos);
}

} // namespace
