// Contact laws and sub-steps that contradict each other.
#include "core/input_error.hpp"
#include "scene/read.hpp"

#include <gtest/gtest.h>

namespace {

using namespace damslip;

std::string joint_message(const std::string& contact)
{
    try {
        parse_scene("[section]\nheight_m = 62.5\nbase_m = 45\n[dam]\ndensity_kg_m3 = 2500\n[contact]\nfriction = "
                    "0.77\n" +
                        contact,
                    "dam.toml", FileCheck::skip);
    } catch (const InputError& error) {
        return error.what();
    }
    return "(accepted)";
}

TEST(JointInput, StiffnessAndPenaltyBelongTogether)
{
    EXPECT_EQ(joint_message("tangential_stiffness_N_m3 = 1e11\n"),
              "dam.toml:8:1: error: contact.tangential_stiffness_N_m3 is given, but contact.enforcement is not "
              "\"penalty\".\n"
              "  expected: enforcement = \"penalty\" with tangential_stiffness_N_m3\n"
              "  fix:      write  enforcement = \"penalty\"  or delete tangential_stiffness_N_m3");
    EXPECT_EQ(joint_message("enforcement = \"penalty\"\n"),
              "dam.toml:8:1: error: contact.enforcement = \"penalty\" without contact.tangential_stiffness_N_m3.\n"
              "  expected: both\n"
              "  fix:      add  tangential_stiffness_N_m3 = 1e11  to [contact]");
    EXPECT_EQ(joint_message("enforcement = \"penalty\"\ntangential_stiffness_N_m3 = 0\n"),
              "dam.toml:9:29: error: contact.tangential_stiffness_N_m3 = 0 is not allowed.\n"
              "  expected: a number > 0 [N_m3]: enforcement penalty: shear stress per elastic slip\n"
              "  fix:      for example  tangential_stiffness_N_m3 = 1e11");
}

TEST(JointInput, ReachBelongsToFiniteSliding)
{
    EXPECT_EQ(joint_message("max_slip_m = 5\n"),
              "dam.toml:8:1: error: contact.max_slip_m is given, but contact.sliding is not \"finite\".\n"
              "  expected: sliding = \"finite\" with max_slip_m\n"
              "  fix:      write  sliding = \"finite\"  or delete max_slip_m");
    EXPECT_EQ(joint_message("sliding = \"finite\"\nmax_slip_m = 5\n"), "(accepted)");
}

TEST(JointInput, SlipToleranceBelongsToItsLaw)
{
    EXPECT_EQ(joint_message("slip_tolerance = 0.005\n"),
              "dam.toml:8:1: error: contact.slip_tolerance is given, but contact.enforcement is not "
              "\"slip-tolerance\".\n"
              "  expected: enforcement = \"slip-tolerance\" with slip_tolerance\n"
              "  fix:      write  enforcement = \"slip-tolerance\"  or delete slip_tolerance");
    EXPECT_EQ(joint_message("enforcement = \"slip_tolerance\"\n"),
              "dam.toml:8:15: error: contact.enforcement = \"slip_tolerance\" is not allowed.\n"
              "  expected: one of \"exact\", \"penalty\", \"slip-tolerance\": FE, before slip: rigid (exact), elastic "
              "with tangential_stiffness (penalty), or with elastic slip up to slip_tolerance x contact element length "
              "(slip-tolerance); the last two also run exact and state the error of the slip\n"
              "  fix:      write  enforcement = \"slip-tolerance\"");
}

TEST(JointInput, SubstepsAreFixedOrChosen)
{
    EXPECT_EQ(joint_message("[time]\nsubsteps = 11\n"), "dam.toml:9:1: error: time.substeps = 11 is not allowed.\n"
                                                        "  expected: 0 ... 10: k of the steps dt / 2^k\n"
                                                        "  fix:      write  substeps = 2  for steps of dt / 4");
    EXPECT_EQ(joint_message("[time]\nsubsteps = 2\nslip_tolerance = 0.01\n"),
              "dam.toml:10:1: error: time.slip_tolerance and time.substeps are both given.\n"
              "  expected: one of them: fixed sub-steps, or sub-steps chosen to a tolerance\n"
              "  fix:      delete one");
    EXPECT_NE(joint_message("[time]\nsubsteps = 1.5\n").find("a whole number"), std::string::npos);
}

TEST(JointInput, UnknownPreset)
{
    EXPECT_NE(joint_message("[analysis]\npreset = \"goldgruber-2014\"\n").find("write  preset = \"goldgruber-2015\""),
              std::string::npos);
}

} // namespace
