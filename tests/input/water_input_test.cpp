// Keys of acoustic water that contradict each other.
#include "core/input_error.hpp"
#include "scene/read.hpp"
#include "scene/rock_mass.hpp"
#include "scene/write.hpp"

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

// A floor that is the rock needs acoustic water, radiating rock, and no other word on the bottom.
TEST(WaterInput, FloorOnRockNeedsWaterAndRockThatCarryWaves)
{
    const auto message = [](const std::string& reservoir, const std::string& rest) -> std::string {
        try {
            parse_scene(wet_scene + ("floor = \"rock\"\n" + reservoir) + "[uplift]\nmodel = \"none\"\n" + rest,
                        "dam.toml", FileCheck::skip);
        } catch (const InputError& error) {
            return error.what();
        }
        return "(accepted)";
    };
    const std::string acoustic = "model = \"acoustic\"\n", rock = "[foundation]\nyoung_modulus_GPa = 30\n";
    EXPECT_EQ(message(acoustic, rock), "(accepted)");
    EXPECT_EQ(message("", rock),
              "dam.toml:9:1: error: reservoir.floor = \"rock\" without reservoir.model = \"acoustic\".\n"
              "  expected: acoustic water: an added mass has no pressure on the floor\n"
              "  fix:      write  model = \"acoustic\", or write  floor = \"absorbing\"  in [reservoir]");
    EXPECT_EQ(
        message(acoustic, rock + "mass = \"massless\"\n"),
        "dam.toml:9:1: error: reservoir.floor = \"rock\" with foundation.mass = \"massless\".\n"
        "  expected: radiating rock: a floor that keeps its waves would send them back into the water\n"
        "  fix:      write  mass = \"with-mass\"  and  boundary = \"absorbing\"  in [foundation], or write  floor = "
        "\"absorbing\"  in [reservoir]");
    EXPECT_NE(message(acoustic, "").find("reservoir.floor = \"rock\" without [foundation]."), std::string::npos);
    EXPECT_NE(message(acoustic, rock + "boundary = \"viscous\"\ndensity_kg_m3 = 2650\n")
                  .find("with a foundation.boundary that is not \"absorbing\"."),
              std::string::npos);
    EXPECT_NE(message(acoustic + "bottom_reflection = 0.7\n", rock).find("with reservoir.bottom_reflection."),
              std::string::npos);
    EXPECT_NE(message(acoustic + "bottom_density_kg_m3 = 2600\nbottom_modulus_GPa = 30\n", rock)
                  .find("with reservoir.bottom_density."),
              std::string::npos);
    EXPECT_NE(message(acoustic + "bottom_motion = \"still\"\n", rock).find("with reservoir.bottom_motion = \"still\"."),
              std::string::npos);
    EXPECT_NE(message(acoustic + "far_end = \"open\"\n", rock).find("with reservoir.far_end = \"open\"."),
              std::string::npos);
    EXPECT_EQ(message(acoustic + "far_end = \"closed\"\n", rock), "(accepted)");
}

// The resolved scene can be read again, and names the floor only where it is the rock; a scene that loses the rock keeps its
// coefficient: α = 0.7274 of 30 GPa, 2650 kg/m3, nu 0.2.
TEST(WaterInput, FloorOnRockIsWrittenAndReadAgain)
{
    const auto scene_of = [](const std::string& reservoir) {
        return parse_scene(
            wet_scene + reservoir +
                "[uplift]\nmodel = \"none\"\n[foundation]\nyoung_modulus_GPa = 30\npoisson_ratio = 0.2\n",
            "dam.toml", FileCheck::skip);
    };
    const Scene on_rock = scene_of("model = \"acoustic\"\nfloor = \"rock\"\n");
    EXPECT_TRUE(floor_on_rock(on_rock));
    const std::string text = resolved_toml(on_rock);
    EXPECT_NE(text.find("floor = \"rock\""), std::string::npos);
    EXPECT_EQ(text.find("bottom_reflection"), std::string::npos);
    EXPECT_EQ(resolved_toml(parse_scene(text, "dam.toml", FileCheck::skip)), text);

    const Scene massless = with_massless_rock(on_rock);
    EXPECT_FALSE(floor_on_rock(massless));
    EXPECT_NEAR(massless.reservoir->bottom_reflection, 0.7274, 5e-5);
    const std::string of_massless = resolved_toml(massless);
    EXPECT_EQ(of_massless.find("floor = "), std::string::npos);
    EXPECT_EQ(resolved_toml(parse_scene(of_massless, "dam.toml", FileCheck::skip)), of_massless);

    const std::string by_material = resolved_toml(scene_of("bottom_density_kg_m3 = 2600\nbottom_modulus_GPa = 30\n"));
    EXPECT_EQ(resolved_toml(parse_scene(by_material, "dam.toml", FileCheck::skip)), by_material);

    Scene added_mass = on_rock;
    added_mass.reservoir->model = ReservoirModel::added_mass;
    const std::string of_added_mass = resolved_toml(added_mass);
    EXPECT_EQ(resolved_toml(parse_scene(of_added_mass, "dam.toml", FileCheck::skip)), of_added_mass);
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
