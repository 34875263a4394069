// Moduli from frequencies: those of a scene lead back to its moduli.
#include "analysis/modes/modes.hpp"
#include "core/input_error.hpp"
#include "program_answer.hpp"
#include "scene/read.hpp"
#include "scene/scene_text.hpp"
#include "source_dir.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <string>

namespace damslip {
namespace {

std::string dam(double concrete, double rock)
{
    std::string text =
        "[section]\nheight_m = 30\nbase_m = 24\ncrest_m = 4\n[dam]\ndensity_kg_m3 = 2400\nyoung_modulus_GPa = " +
        std::to_string(concrete) +
        "\n[contact]\nfriction = 0.8\n[reservoir]\nlevel_m = 26\nmodel = \"added-mass\"\n[uplift]\nmodel = "
        "\"none\"\n[mesh]\nsize_m = 3\ncontact_size_m = 2\n";
    if (rock > 0.0) text += "[foundation]\nyoung_modulus_GPa = " + std::to_string(rock) + "\nmass = \"massless\"\n";
    return text;
}

Scene parsed(const std::string& text)
{
    return parse_scene(text, "dam.toml", FileCheck::skip);
}

double frequency(const std::string& text, int mode)
{
    return compute_modes(prepare(parsed(text), Method::finite_elements), {.count = 3}).modes.frequency[mode - 1];
}

// On a rigid base f goes with the root of E: the modulus comes back, and d ln E = 2 d ln f.
TEST(Calibrate, OneFrequencyGivesTheModulusOfTheDam)
{
    const double f = frequency(dam(25.0, 0.0), 1);
    const Calibration c = calibrate(parsed(dam(18.0, 0.0)), {.measured = {{f}}, .scatter = 0.03});
    ASSERT_EQ(c.moduli.size(), 1u);
    EXPECT_NEAR(c.moduli[0].after / 25e9, 1.0, 1e-6);
    EXPECT_NEAR(c.moduli[0].beta, 0.06, 6e-4);
    EXPECT_NEAR(*c.scene.dam.young_modulus / 25e9, 1.0, 1e-6);
    EXPECT_NEAR(c.frequencies[0].by_dam, 0.5, 3e-3);
    EXPECT_LT(c.misfit, 1e-6);
}

// Two frequencies on rock: both moduli; without the second the rock stays and says so.
TEST(Calibrate, TwoFrequenciesGiveTheRockToo)
{
    const std::string truth = dam(25.0, 12.0), guess = dam(20.0, 20.0);
    const double first = frequency(truth, 1), second = frequency(truth, 2);
    const Calibration c = calibrate(parsed(guess), {.measured = {{first}, {second, {}, 2}}, .scatter = 0.005});
    ASSERT_EQ(c.moduli.size(), 2u);
    EXPECT_NEAR(c.moduli[0].after / 25e9, 1.0, 1e-4);
    EXPECT_NEAR(c.moduli[1].after / 12e9, 1.0, 1e-4);
    ASSERT_TRUE(c.rank_correlation);
    EXPECT_LT(*c.rank_correlation, 0.0); // a stiffer dam on softer rock
    // Without acoustic water all stiffness is in the two moduli.
    for (const FittedFrequency& f : c.frequencies) EXPECT_NEAR(f.by_dam + f.by_rock, 0.5, 5e-3);

    const Calibration one = calibrate(parsed(guess), {.measured = {{first}}});
    EXPECT_EQ(one.moduli.size(), 1u);
    ASSERT_FALSE(one.notes.empty());
    EXPECT_NE(one.notes.front().find("one frequency"), std::string::npos);
}

// Frequencies with and without water hardly tell the rock from the dam: it keeps its modulus.
TEST(Calibrate, WaterDoesNotTellTheRock)
{
    const std::string truth = dam(25.0, 20.0);
    std::string dry = truth;
    dry.replace(dry.find("[reservoir]\nlevel_m = 26\nmodel = \"added-mass\"\n"), 46, "");
    const Calibration c = calibrate(
        parsed(dam(20.0, 20.0)), {.measured = {{frequency(truth, 1)}, {frequency(dry, 1), 0.0, 1}}, .scatter = 0.02});
    ASSERT_EQ(c.moduli.size(), 1u);
    EXPECT_NEAR(c.moduli[0].after / 25e9, 1.0, 1e-3);
}

// Damping of an empty dam on a rigid base is the structure's own; added mass, on which a_M does not act, asks for more.
TEST(Calibrate, WithoutWavesTheMeasuredDampingIsTheStructures)
{
    std::string dry = dam(25.0, 0.0);
    dry.replace(dry.find("[reservoir]\nlevel_m = 26\nmodel = \"added-mass\"\n"), 46, "");
    const Calibration c = calibrate(parsed(dry), {.measured = {{frequency(dry, 1)}}, .damping = 0.03});
    const Calibration wet =
        calibrate(parsed(dam(25.0, 0.0)), {.measured = {{frequency(dam(25.0, 0.0), 1)}}, .damping = 0.03});
    EXPECT_GT(wet.damping->ratio, 0.032);
    EXPECT_LT(wet.damping->waves, 0.0);
    ASSERT_TRUE(c.damping);
    EXPECT_NEAR(c.damping->ratio, 0.03, 3e-4);
    EXPECT_NEAR(c.scene.damping.ratio, c.damping->ratio, 0.0);
}

TEST(Calibrate, AFrequencyThatNoModulusGivesIsNoAnswer)
{
    EXPECT_THROW(calibrate(parsed(dam(25.0, 0.0)), {.measured = {{90.0}}}), NotConverged);
    EXPECT_THROW(calibrate(parsed(dam(25.0, 0.0)), {.measured = {{4.0, 31.0, 1}}}), InputError);
    // f goes with the root of E here: 25 GPa (f/f_0)^2 < 1 GPa is known before a fit.
    const double f = frequency(dam(25.0, 0.0), 1);
    try {
        calibrate(parsed(dam(25.0, 0.0)), {.measured = {{0.18 * f}}});
        ADD_FAILURE() << "0.9 GPa is no concrete";
    } catch (const NotConverged& e) {
        EXPECT_NE(std::string(e.what()).find("0.81 GPa or less of the dam"), std::string::npos) << e.what();
    }
    EXPECT_EQ(calibrate(parsed(dam(25.0, 0.0)), {.measured = {{0.21 * f}}}).moduli.size(), 1u); // 1.1 GPa
}

TEST(Calibrate, TheCommandPrintsLawsThatFragilityReads)
{
    const std::string file = std::string(source_dir()) + "/examples/pine_flat.toml";
    const ProgramAnswer a = answer_of({"calibrate", file, "--frequency", "3.4", "--json"});
    ASSERT_EQ(a.code, 0) << a.talk;
    const auto j = nlohmann::json::parse(a.out);
    const std::string laws = j["laws"];
    EXPECT_NE(laws.find("key = \"dam.young_modulus_GPa\""), std::string::npos);
    EXPECT_NE(laws.find("beta = 0.04"), std::string::npos);
    EXPECT_EQ(answer_of({"calibrate", file}).code, 2);
    EXPECT_EQ(answer_of({"calibrate", file, "--frequency", "3.4", "--second", "3.3"}).code, 2);
    EXPECT_EQ(answer_of({"calibrate", file, "--at", "60:3.4"}).code, 2);
    EXPECT_EQ(answer_of({"calibrate", file, "--frequency-empty", "3.4"}).code, 3);
}

} // namespace
} // namespace damslip
