// Keys of acoustic water that contradict each other.
#include "core/input_error.hpp"
#include "scene/effect_plan.hpp"
#include "scene/keys.hpp"
#include "scene/plausible.hpp"
#include "scene/read.hpp"
#include "scene/rock_mass.hpp"
#include "scene/write.hpp"
#include "sliding/equilibrium/limit_equilibrium.hpp"

#include <gtest/gtest.h>

namespace {

using namespace damslip;

const char* const wet_scene =
    "[section]\nheight_m = 62.5\nbase_m = 45\n[dam]\ndensity_kg_m3 = 2500\n[contact]\nfriction = 0.77\n[reservoir]\n";

std::string message_of_text(const std::string& text)
{
    try {
        parse_scene(text, "dam.toml", FileCheck::skip);
    } catch (const InputError& error) {
        return error.what();
    }
    return "(accepted)";
}

std::string water_message(const std::string& reservoir)
{
    return message_of_text(wet_scene + reservoir + "[uplift]\nmodel = \"none\"\n");
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
    const auto message = [](const std::string& reservoir, const std::string& rest) {
        return message_of_text(wet_scene + ("floor = \"rock\"\n" + reservoir) + "[uplift]\nmodel = \"none\"\n" + rest);
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
    const auto message = [&](const std::string& reservoir) {
        return message_of_text(section + reservoir + "[uplift]\nmodel = \"none\"\n");
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

/// Notes of a dam 30 m high with water, each on a line.
std::string notes_of_dam(const std::string& more)
{
    std::string all;
    for (const Diagnostic& note :
         parse_scene("section = { height_m = 30, base_m = 24, crest_m = 4 }\ndam = { density_kg_m3 = 2400 }\n"
                     "contact = { friction = 0.8 }\n" +
                         more,
                     "dam.toml", FileCheck::skip)
             .notes)
        all += note_text(note) + "\n";
    return all;
}

// What is given and changes nothing is noted, once, with what reads it; its default, as a resolved scene writes it, is not.
TEST(WaterInput, WhatNothingReadsIsNoted)
{
    const std::string water = "reservoir = { level_m = 27, model = \"added-mass\"", linear = "uplift = { model = \"linear\" }\n",
                      drains = "drains = { distance_m = 4, efficiency = 0.67 }\n";
    EXPECT_EQ(notes_of_dam(water + " }\n" + linear + drains),
              "dam.toml:6: [drains] is not read with uplift.model = \"linear\". Usual: model = \"drains\" or \"seepage\", the "
              "models that read it. Write  model = \"drains\"  in [uplift], or delete [drains].\n");
    EXPECT_EQ(notes_of_dam(water + " }\nuplift = { model = \"drains\" }\n" + drains), "");
    EXPECT_EQ(notes_of_dam(water + " }\nuplift = { model = \"seepage\" }\n" + drains), "");
    const std::string curtain = "curtain = { distance_m = 2 }\n";
    EXPECT_NE(notes_of_dam(water + " }\n" + linear + curtain).find("[curtain] is not read with uplift.model = \"linear\"."),
              std::string::npos);
    EXPECT_EQ(notes_of_dam(water + " }\nuplift = { model = \"curtain\" }\n" + curtain), "");
    EXPECT_NE(notes_of_dam(water + ", far_end = \"closed\" }\n" + linear)
                  .find("reservoir.far_end is not read with reservoir.model = \"added-mass\"."),
              std::string::npos);
    EXPECT_EQ(notes_of_dam(water + ", far_end = \"absorbing\" }\n" + linear), "");
    EXPECT_NE(notes_of_dam("reservoir = { level_m = 27, model = \"hydrostatic\" }\nadded_mass = { formula = \"zangar\" }\n" + linear)
                  .find("[added_mass] is not read with reservoir.model = \"hydrostatic\"."),
              std::string::npos);
    const std::string rock = "foundation = { young_modulus_GPa = 20, mass = \"massless\", ";
    EXPECT_NE(notes_of_dam(rock + "boundary = \"fixed\" }\n").find("foundation.boundary is not read with foundation.mass"),
              std::string::npos);
    EXPECT_NE(notes_of_dam(rock + "density_kg_m3 = 2650 }\n").find("foundation.density_kg_m3 is not read with"),
              std::string::npos);
    EXPECT_EQ(notes_of_dam(rock + "density_kg_m3 = 2650 }\nstages = { gravity = \"dam-and-rock\" }\n"), "");
    EXPECT_NE(notes_of_dam("damping = { ratio = 0.03, mass_coefficient_1_s = 1, stiffness_coefficient_s = 0.001 }\n")
                  .find("damping.ratio is not read by finite elements"),
              std::string::npos);
    const Scene scene = parse_scene("section = { height_m = 30, base_m = 24, crest_m = 4 }\ndam = { density_kg_m3 = 2400 }\n"
                                    "contact = { friction = 0.8 }\n" +
                                        water + " }\n" + linear + "foundation = { young_modulus_GPa = 20, mass = \"massless\" }\n",
                                    "dam.toml", FileCheck::skip);
    EXPECT_TRUE(scene.notes.empty());
    EXPECT_TRUE(parse_scene(resolved_toml(scene), "dam.toml", FileCheck::skip).notes.empty());
}

// Drains that the uplift does not read are no effect of the run, and have no load combination; a seam with drained water reads them.
TEST(WaterInput, DrainsCountWhereTheyAreRead)
{
    const auto scene_with = [](const std::string& model, const std::string& more = "") {
        return parse_scene("section = { height_m = 30, base_m = 24, crest_m = 4 }\ndam = { density_kg_m3 = 2400 }\n"
                           "contact = { friction = 0.8 }\nreservoir = { level_m = 27 }\nuplift = { model = \"" +
                               model + "\" }\ndrains = { distance_m = 4, efficiency = 0.67 }\n" + more,
                           "dam.toml", FileCheck::skip);
    };
    const auto combined = [](const Scene& scene) {
        for (const Combination& c : sliding::combinations(scene, {}))
            if (c.name == "drains ineffective") return true;
        return false;
    };
    for (const char* model : {"drains", "seepage"}) {
        EXPECT_TRUE(make_effect_plan(scene_with(model), Method::rigid_block).on(Effect::drains)) << model;
        EXPECT_TRUE(combined(scene_with(model))) << model;
    }
    for (const Method method : {Method::rigid_block, Method::finite_elements})
        EXPECT_FALSE(make_effect_plan(scene_with("linear"), method).on(Effect::drains));
    EXPECT_FALSE(combined(scene_with("linear")));
    EXPECT_TRUE(combined(scene_with("linear", "foundation = { young_modulus_GPa = 20, density_kg_m3 = 2650 }\n"
                                              "[[seam]]\ndepth_m = 3\nfriction = 0.7\nuplift = \"drains\"\n"
                                              "[seam.wedge]\nfriction_deg = 40\n")));
}

// Tailwater stands no higher than the crest unless the reservoir flows over it; ice pushes on the face.
TEST(WaterInput, TailwaterAndIceStayBelowTheCrest)
{
    const auto block = [](const std::string& more) {
        return message_of_text("section = { polygon_m = [[0,0],[20,0],[20,10],[0,10]] }\ndam = { density_kg_m3 = 2400 }\n"
                          "contact = { friction = 0.8 }\nuplift = { model = \"none\" }\n" +
                          more);
    };
    EXPECT_EQ(block("reservoir = { level_m = 8 }\ntailwater = { level_m = 14 }\n"),
              "dam.toml:6:15: error: tailwater.level_m = 14 is 4 m above the crest at 10 m.\n"
              "  expected: a tailwater up to the crest, 10 m; higher only with  overtopped = true  in [reservoir]\n"
              "  fix:      check datum and unit: levels are measured from the heel");
    EXPECT_EQ(block("reservoir = { level_m = 8 }\ntailwater = { level_m = 10 }\n"), "(accepted)");
    EXPECT_EQ(block("reservoir = { level_m = 15, overtopped = true }\ntailwater = { level_m = 14 }\n"), "(accepted)");
    EXPECT_NE(block("reservoir = { level_m = 8 }\n[[combination]]\nname = \"flood\"\ntailwater_level_m = 11\n")
                  .find("combination[1].tailwater_level_m = 11 is 1 m above the crest at 10 m."),
              std::string::npos);
    EXPECT_NE(block("reservoir = { level_m = 8 }\nice = { force_kN_m = 100, level_m = 50 }\n")
                  .find("ice.level_m = 50 is 40 m above the crest at 10 m."),
              std::string::npos);
    EXPECT_EQ(block("reservoir = { level_m = 8 }\nice = { force_kN_m = 100, level_m = 10 }\n"), "(accepted)");
}

// Only where there is water under the base, and a rule for its opening.
TEST(WaterInput, RegressionsLeaveOutARuleOfTheOpeningThatIsThere)
{
    const auto left_out = [](const std::string& uplift) {
        return note_texts(not_honoured(parse_scene(wet_scene + ("[uplift]\n" + uplift), "dam.toml", FileCheck::skip),
                                       methods::regressions));
    };
    EXPECT_TRUE(left_out("model = \"none\"\n").empty());
    EXPECT_TRUE(left_out("model = \"linear\"\n").empty());
    EXPECT_EQ(left_out("model = \"linear\"\nopening = \"full\"\n").size(), 1u);
}

} // namespace
