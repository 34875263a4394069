// Anchors that cannot be: their place, their steel, and what they do not go with.
#include "core/input_error.hpp"
#include "scene/read.hpp"
#include "scene/write.hpp"

#include <gtest/gtest.h>

namespace {

using namespace damslip;

std::string scene_with(const std::string& tables)
{
    return "[section]\nheight_m = 60\nbase_m = 45\n[dam]\ndensity_kg_m3 = 2500\n[contact]\nfriction = 0.77\n" + tables;
}

std::string anchor_message(const std::string& tables)
{
    try {
        parse_scene(scene_with(tables), "dam.toml", FileCheck::skip);
    } catch (const InputError& error) {
        return error.what();
    }
    return "(accepted)";
}

std::string anchor_with(const std::string& more, const std::string& place = "4")
{
    return "[[anchor]]\ndistance_m = " + place +
           "\nfree_length_m = 30\narea_m2_m = 0.002\nyield_strength_MPa = 1600\n" + more;
}

TEST(AnchorInput, NeedsPlaceAndSteel)
{
    EXPECT_EQ(anchor_message(anchor_with("prestress_kN_m = 1900\n")), "(accepted)");
    for (const char* key : {"distance_m", "free_length_m", "area_m2_m", "yield_strength_MPa"}) {
        std::string text = anchor_with("");
        const std::size_t from = text.find(key);
        text.erase(from, text.find('\n', from) + 1 - from);
        EXPECT_NE(anchor_message(text).find("is missing"), std::string::npos) << key;
    }
}

TEST(AnchorInput, CrossesItsJoint)
{
    EXPECT_EQ(anchor_message(anchor_with("", "46")),
              "dam.toml:9:1: error: anchor[1].distance_m = 46 is outside the base, 45 m long.\n"
              "  expected: 0 to 45 m from its upstream end\n"
              "  fix:      move the anchor into the joint");
    const std::string joint = "[[lift_joint]]\nname = \"neck\"\nelevation_m = 30\nfriction = 0.8\n";
    // The triangle is 22.5 m wide at half its height.
    EXPECT_EQ(anchor_message(joint + anchor_with("joint = \"neck\"\n", "22")), "(accepted)");
    EXPECT_NE(anchor_message(joint + anchor_with("joint = \"neck\"\n", "23"))
                  .find("outside the lift joint \"neck\", 22.5 m long"),
              std::string::npos);
    EXPECT_EQ(anchor_message(joint + anchor_with("joint = \"nek\"\n")),
              "dam.toml:17:1: error: anchor[1].joint = \"nek\" is not the name of a [[lift_joint]].\n"
              "  expected: \"neck\"\n"
              "  fix:      correct the name, or delete  joint  for an anchor through the base");
}

TEST(AnchorInput, HoldsItsPrestress)
{
    EXPECT_EQ(
        anchor_message(anchor_with("prestress_kN_m = 3200\n")),
        "dam.toml:13:1: error: anchor[1].prestress_kN_m = 3200 is not below the yield force, yield_strength_MPa x "
        "area_m2_m = 3200 kN/m.\n"
        "  expected: a lock-off force below 3200 kN/m (usual: 0.6 of it)\n"
        "  fix:      write  prestress_kN_m = 1920 , or give more area_m2_m");
    EXPECT_NE(anchor_message(anchor_with("rupture_strain = 0.008\n")).find("is not above the yield strain"),
              std::string::npos);
}

TEST(AnchorInput, NamesDiffer)
{
    const std::string named = anchor_with("name = \"a\"\n");
    EXPECT_NE(anchor_message(named + named).find("two anchors are named \"a\"."), std::string::npos);
    EXPECT_EQ(anchor_message(anchor_with("") + anchor_with("")), "(accepted)");
}

TEST(AnchorInput, GoesWithWhatKnowsItsForce)
{
    const std::string anchor = anchor_with("");
    for (const char* other : {"[sliding]\nscheme = \"slammer\"\n", "[sliding]\nlift_off = \"ballistic\"\n",
                              "[flexible_block]\nperiod_s = 0.3\nmass_ratio = 0.8\n"})
        EXPECT_NE(anchor_message(anchor + other).find("with [[anchor]]."), std::string::npos) << other;
}

// Water that follows the opening goes with either of the two.
TEST(AnchorInput, NotWithFrictionOverTheRate)
{
    const std::string rate = "kinetic_friction_ratio = 0.8\ncharacteristic_rate_m_s = 0.01\n";
    const std::string message = anchor_message(rate + anchor_with(""));
    EXPECT_NE(message.find("contact.kinetic_friction_ratio with [[anchor]]."), std::string::npos) << message;
    EXPECT_NE(message.find("forces over its slip (anchors) or friction over its rate"), std::string::npos) << message;
}

TEST(AnchorInput, IsWrittenAsItWasRead)
{
    const Scene scene = parse_scene(
        scene_with(anchor_with("name = \"crest\"\nprestress_kN_m = 1900\ndowel = true\n") + anchor_with("")),
        "dam.toml", FileCheck::skip);
    ASSERT_EQ(scene.anchors.size(), 2u);
    EXPECT_EQ(scene.anchors[0].limit_force, AnchorForceRule::prestress);
    EXPECT_EQ(scene.anchors[1].limit_force, AnchorForceRule::yield); // passive
    EXPECT_EQ(scene.anchors[1].name, "anchor 2");
    const std::string text = resolved_toml(scene);
    EXPECT_EQ(resolved_toml(parse_scene(text, "dam.toml", FileCheck::skip)), text);
}

// A scene without anchors says nothing of them.
TEST(AnchorInput, LeavesNoTraceWhereThereAreNone)
{
    const Scene scene = parse_scene(scene_with(""), "dam.toml", FileCheck::skip);
    EXPECT_EQ(resolved_toml(scene).find("anchor"), std::string::npos);
}

} // namespace
