// Keys of acoustic water that contradict each other.
#include "core/input_error.hpp"
#include "scene/read.hpp"

#include <gtest/gtest.h>

namespace {

using namespace damslip;

const char* const wet_scene =
    "[section]\nheight_m = 62.5\nbase_m = 45\n[dam]\ndensity_kg_m3 = 2500\n[contact]\nfriction = 0.77\n[reservoir]\n";

std::string water_message(const std::string& reservoir)
{
    try {
        parse_scene(wet_scene + reservoir + "[uplift]\nmodel = \"none\"\n", "dam.toml", FileCheck::skip);
    } catch (const InputError& error) {
        return error.what();
    }
    return "(accepted)";
}

TEST(WaterInput, BottomIsDescribedOnce)
{
    EXPECT_EQ(
        water_message("bottom_density_kg_m3 = 2600\n"),
        "dam.toml:9:1: error: one of reservoir.bottom_density_kg_m3 and reservoir.bottom_modulus_GPa is missing.\n"
        "  expected: both: together they give the wave reflection coefficient (Goldgruber 2015, 3-55)\n"
        "  fix:      add the other one, or give bottom_reflection instead");
    EXPECT_NE(water_message("bottom_density_kg_m3 = 2600\nbottom_modulus_GPa = 30\nbottom_reflection = 0.5\n")
                  .find("reservoir.bottom_reflection is given together with the density or modulus of the bottom."),
              std::string::npos);
    EXPECT_EQ(water_message("bottom_density_kg_m3 = 2600\nbottom_modulus_GPa = 30\nfar_end = \"damper\"\n"),
              "(accepted)");
    EXPECT_NE(water_message("bottom_reflection = -1.5\n").find("-1 ... 1"), std::string::npos);
}

// Slope 1 up to 10 m, vertical above: 45 degrees, refused where that part is wet and the water has a mass.
TEST(WaterInput, GoldgrubersMassIsOfSteepFaces)
{
    const std::string section =
        "[section]\npolygon_m = [[0, 0], [45, 0], [22, 60], [10, 60], [10, 10]]\n[dam]\ndensity_kg_m3 = 2500\n"
        "[contact]\nfriction = 0.77\n[added_mass]\nformula = \"goldgruber\"\n[reservoir]\n";
    const auto message = [&](const std::string& reservoir) -> std::string {
        try {
            parse_scene(section + reservoir + "[uplift]\nmodel = \"none\"\n", "dam.toml", FileCheck::skip);
        } catch (const InputError& error) {
            return error.what();
        }
        return "(accepted)";
    };
    EXPECT_EQ(message("level_m = 50\n"),
              "dam.toml:8:1: error: added_mass.formula = \"goldgruber\" with a wet face 45 degrees from the vertical.\n"
              "  expected: a wet upstream face within 0 to 30 degrees of the vertical, the range of (3-10)\n"
              "  fix:      use added_mass.formula = \"zangar\" or \"westergaard\"");
    EXPECT_EQ(message("level_m = 50\nmodel = \"hydrostatic\"\n"), "(accepted)");
    EXPECT_EQ(message("level_m = 0\n"), "(accepted)");
}

TEST(WaterInput, MeshNeedsFourElementsOverTheDepth)
{
    EXPECT_NE(water_message("mesh_size_m = 20\n").find("leaves fewer than four elements over the depth of 62.5 m"),
              std::string::npos);
    EXPECT_EQ(water_message("mesh_size_m = 15\n"), "(accepted)");
}

// Water in the rock brings the pressure on the floor with it.
TEST(WaterInput, FloorIsLoadedOnce)
{
    EXPECT_NE(water_message("floor_pressure = true\n[stages]\npore_pressure = \"total\"\n")
                  .find("stages.pore_pressure is given together with reservoir.floor_pressure = true"),
              std::string::npos);
    EXPECT_EQ(water_message("floor_pressure = true\n"), "(accepted)");
}

// With the preset of the source the far end is its damper at 2.4 depths and the bottom still; what the file says wins.
TEST(WaterInput, PresetTakesTheSourcesBoundaries)
{
    const std::string preset = "[analysis]\npreset = \"goldgruber-2015\"\n[uplift]\nmodel = \"none\"\n";
    const Scene source = parse_scene(wet_scene + preset, "dam.toml", FileCheck::skip);
    EXPECT_EQ(source.reservoir->far_end, FarEnd::damper);
    EXPECT_EQ(source.reservoir->bottom_motion, BottomMotion::still);
    EXPECT_EQ(source.reservoir->bottom_reflection, 1.0);
    EXPECT_DOUBLE_EQ(source.reservoir->length, 150.0);
    const Scene own =
        parse_scene(std::string(wet_scene) + "far_end = \"absorbing\"\n" + preset, "dam.toml", FileCheck::skip);
    EXPECT_EQ(own.reservoir->far_end, FarEnd::absorbing);
    EXPECT_DOUBLE_EQ(own.reservoir->length, 62.5);
}

} // namespace
