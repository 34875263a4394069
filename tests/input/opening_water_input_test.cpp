// Keys of water that follows the opening of the base.
#include "core/input_error.hpp"
#include "scene/read.hpp"
#include "scene/write.hpp"

#include <gtest/gtest.h>

namespace {

using namespace damslip;

const char* const opening_dam =
    "[section]\nheight_m = 62.5\nbase_m = 45\n[dam]\ndensity_kg_m3 = 2500\n[contact]\nfriction = 0.77\n";
const char* const opening_base = "[reservoir]\n[uplift]\nmodel = \"linear\"\n";

std::string opening_message(const std::string& text)
{
    try {
        parse_scene(opening_dam + text, "dam.toml", FileCheck::skip);
    } catch (const InputError& error) {
        return error.what();
    }
    return "(accepted)";
}

bool opening_says(const std::string& text, const char* part)
{
    return opening_message(text).find(part) != std::string::npos;
}

TEST(OpeningWaterInput, MouthWantsASpeed)
{
    EXPECT_EQ(opening_message(std::string(opening_base) + "opening = \"mouth\"\n"),
              "dam.toml:11:1: error: uplift.opening = \"mouth\" without uplift.mouth_speed_m_s.\n"
              "  expected: the speed at which water enters the crack, above 0 [m_s]: no value of it is agreed on\n"
              "  fix:      add  mouth_speed_m_s = 5  (and try others), or write  opening = \"full\"");
    EXPECT_EQ(opening_message(std::string(opening_base) + "opening = \"mouth\"\nmouth_speed_m_s = 5\n"), "(accepted)");
    EXPECT_TRUE(opening_says(std::string(opening_base) + "opening = \"mouth\"\nmouth_speed_m_s = 0\n",
                             "uplift.mouth_speed_m_s"));
}

TEST(OpeningWaterInput, WaterNeedsWater)
{
    EXPECT_TRUE(opening_says("[reservoir]\n[uplift]\nmodel = \"none\"\nopening = \"full\"\n",
                             "uplift.opening = \"full\" with uplift.model = \"none\"."));
    EXPECT_TRUE(opening_says("[uplift]\nmodel = \"linear\"\nopening = \"zero\"\n",
                             "with neither [reservoir] nor [tailwater]."));
    EXPECT_TRUE(
        opening_says("[tailwater]\nlevel_m = 3\n[uplift]\nmodel = \"linear\"\nopening = \"reynolds\"\nwet_end = "
                     "\"with-waves\"\n",
                     "uplift.wet_end = \"with-waves\" without [reservoir]."));
    EXPECT_TRUE(
        opening_says(std::string(opening_base) + "after = \"full\"\n[sliding]\nscheme = \"slammer\"\n", "(accepted)"));
    EXPECT_TRUE(opening_says(std::string(opening_base) + "opening = \"full\"\n[sliding]\nscheme = \"slammer\"\n",
                             "sliding.scheme = \"slammer\" with uplift.opening = \"full\"."));
}

TEST(OpeningWaterInput, LimitsOfTheFlow)
{
    const std::string flow = std::string(opening_base) + "opening = \"reynolds\"\n";
    EXPECT_EQ(opening_message(flow), "(accepted)");
    EXPECT_TRUE(opening_says(flow + "joint_clearance_m = 0\n", "uplift.joint_clearance_m"));
    EXPECT_TRUE(opening_says(flow + "water_viscosity_Pa_s = 0\n", "uplift.water_viscosity_Pa_s"));
    EXPECT_TRUE(opening_says(flow + "cavitation_pressure_kPa = 5\n", "uplift.cavitation_pressure_kPa"));
}

// A sweep over the rules reads keys that the scene's own rule does not: a note, no error.
TEST(OpeningWaterInput, KeysOfAnotherRuleAreNoted)
{
    const Scene scene = parse_scene(opening_dam + std::string(opening_base) +
                                        "opening = \"full\"\nmouth_speed_m_s = 5\njoint_clearance_m = 0.0003\n",
                                    "dam.toml", FileCheck::skip);
    ASSERT_EQ(scene.notes.size(), 1u); // mouth_speed is for  sweep --opening-water mouth
    EXPECT_EQ(scene.notes.front().problem, "uplift.joint_clearance is not read with uplift.opening = \"full\".");
}

// Without its keys the resolved scene has none of them.
TEST(OpeningWaterInput, LeavesNoTraceUnlessNamed)
{
    const std::string text =
        resolved_toml(parse_scene(opening_dam + std::string(opening_base), "dam.toml", FileCheck::skip));
    for (const char* key : {"opening", "after", "mouth", "clearance", "viscosity", "cavitation", "wet_end"})
        EXPECT_EQ(text.find(key), std::string::npos) << key;
}

} // namespace
