// Lift joints that cannot be: where they lie, and what they lack.
#include "core/input_error.hpp"
#include "scene/read.hpp"

#include <gtest/gtest.h>

namespace {

using namespace damslip;

std::string lift_joint_message(const std::string& joints, const std::string& contact = {})
{
    try {
        parse_scene("[section]\nheight_m = 60\nbase_m = 45\n[dam]\ndensity_kg_m3 = 2500\n[contact]\nfriction = 0.77\n" +
                        contact + joints,
                    "dam.toml", FileCheck::skip);
    } catch (const InputError& error) {
        return error.what();
    }
    return "(accepted)";
}

std::string lift_at(const std::string& elevation, const std::string& more = "friction = 0.8\n")
{
    return "[[lift_joint]]\nelevation_m = " + elevation + "\n" + more;
}

TEST(LiftJointInput, NeedsFrictionAndElevation)
{
    EXPECT_EQ(
        lift_joint_message(lift_at("30", "")),
        "dam.toml:8:1: error: lift_joint[1].friction is missing.\n"
        "  expected: a number 0 ... 10: Coulomb mu, peak; or friction_deg, its angle (a dam on rock: 0.6 to 1.2)\n"
        "  fix:      add  friction = 0.77  to [lift_joint]");
    EXPECT_NE(lift_joint_message("[[lift_joint]]\nfriction = 0.8\n").find("lift_joint[1].elevation_m is missing."),
              std::string::npos);
    EXPECT_NE(lift_joint_message(lift_at("30", "friction = 1\nenforcement = \"exact\"\n"))
                  .find("unknown key lift_joint[1].enforcement"),
              std::string::npos);
}

TEST(LiftJointInput, LiesInsideTheDam)
{
    EXPECT_EQ(lift_joint_message(lift_at("60")),
              "dam.toml:9:1: error: lift_joint[1].elevation_m = 60 is not inside the dam.\n"
              "  expected: above the base at 0 m and below the crest at 60 m\n"
              "  fix:      move the joint, or delete it");
    EXPECT_NE(lift_joint_message(lift_at("0")).find("is not inside the dam"), std::string::npos);
    EXPECT_NE(lift_joint_message(lift_at("-3")).find("is not inside the dam"), std::string::npos);
}

// A triangle 60 m high, elements of 1.5 m: at 59 m it is 0.75 m wide.
TEST(LiftJointInput, HasRoomForElements)
{
    EXPECT_EQ(lift_joint_message(lift_at("59")),
              "dam.toml:9:1: error: lift_joint[1].elevation_m = 59: the section is 0.75 m wide there, less than one "
              "element of 1.5 m.\n"
              "  expected: a joint at least one element wide\n"
              "  fix:      lower the joint, or give a smaller mesh.size_m");
    EXPECT_EQ(lift_joint_message(lift_at("30") + lift_at("30.25")),
              "dam.toml:12:1: error: lift_joint[2].elevation_m = 30.25 is 0.25 m from lift_joint[1]: no room for an "
              "element of 1.5 m.\n"
              "  expected: at least half an element, 0.75 m, between base, joints and crest\n"
              "  fix:      move the joint, or give a smaller mesh.size_m");
    EXPECT_NE(lift_joint_message(lift_at("30") + lift_at("30")).find("is 0 m from lift_joint[1]"), std::string::npos);
    EXPECT_NE(lift_joint_message(lift_at("0.5")).find("is 0.5 m from the base"), std::string::npos);
    EXPECT_EQ(lift_joint_message(lift_at("0.5") + "[mesh]\nsize_m = 1\n"), "(accepted)");
}

TEST(LiftJointInput, StrengthAndNamesAgree)
{
    EXPECT_NE(lift_joint_message(lift_at("30", "friction = 0.7\nresidual_friction = 0.8\n"))
                  .find("lift_joint[1].residual_friction = 0.8 is above the peak value, lift_joint[1].friction = 0.7."),
              std::string::npos);
    EXPECT_NE(lift_joint_message(lift_at("30", "friction = 0.7\nresidual_slip_m = 0.1\n"))
                  .find("lift_joint[1].residual_slip_m is given without lift_joint[1].residual_friction."),
              std::string::npos);
    const std::string named = "friction = 0.8\nname = \"a\"\n";
    EXPECT_NE(lift_joint_message(lift_at("20", named) + lift_at("40", named)).find("two lift joints are named \"a\"."),
              std::string::npos);
}

TEST(LiftJointInput, GoesWithSmallSliding)
{
    EXPECT_EQ(lift_joint_message(lift_at("30"), "sliding = \"finite\"\n"),
              "dam.toml:8:1: error: contact.sliding = \"finite\" with a [[lift_joint]].\n"
              "  expected: sliding = \"small\" where the dam has lift joints\n"
              "  fix:      write  sliding = \"small\"  or delete the [[lift_joint]]");
}

} // namespace

namespace {

TEST(RockSizeInput, NeedsRockAndTwoElementsBelowTheBase)
{
    const std::string mesh = "[mesh]\nrock_contact_size_m = 2\n";
    const std::string rock = "[foundation]\nyoung_modulus_GPa = 30\nmass = \"massless\"\n";
    EXPECT_EQ(lift_joint_message(mesh),
              "dam.toml:9:1: error: mesh.rock_contact_size_m is given without [foundation]: there is no rock.\n"
              "  expected: both or neither\n"
              "  fix:      add [foundation] or delete rock_contact_size_m");
    EXPECT_EQ(lift_joint_message(mesh + rock), "(accepted)");
    EXPECT_EQ(lift_joint_message("[mesh]\nrock_contact_size_m = 23\n" + rock),
              "dam.toml:9:1: error: mesh.rock_contact_size_m = 23 leaves less than two elements below the base of 45 "
              "m.\n"
              "  expected: at most half the base; near contact_size_m is usual\n"
              "  fix:      lessen it or leave it out");
    EXPECT_NE(lift_joint_message("[mesh]\nrock_contact_size_m = 0\n" + rock).find("a number > 0 [m]"),
              std::string::npos);
}

} // namespace
