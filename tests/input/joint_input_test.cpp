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
              "  expected: a number >= 1 [N_m3]: enforcement penalty: shear stress per elastic slip\n"
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

TEST(JointInput, SoftPressureBelongsToItsLaw)
{
    EXPECT_EQ(joint_message("pressure_at_zero_clearance_MPa = 2\n"),
              "dam.toml:8:1: error: contact.pressure_at_zero_clearance_kPa is given, but contact.normal is not "
              "\"exponential\".\n"
              "  expected: normal = \"exponential\" with pressure_at_zero_clearance_kPa\n"
              "  fix:      write  normal = \"exponential\"  or delete pressure_at_zero_clearance_kPa");
    EXPECT_EQ(joint_message("clearance_at_zero_pressure_mm = 1\n"),
              "dam.toml:8:1: error: contact.clearance_at_zero_pressure_m is given, but contact.normal is not "
              "\"exponential\".\n"
              "  expected: normal = \"exponential\" with clearance_at_zero_pressure_m\n"
              "  fix:      write  normal = \"exponential\"  or delete clearance_at_zero_pressure_m");
    EXPECT_EQ(joint_message("normal = \"exponential\"\nclearance_at_zero_pressure_m = 0\n"),
              "dam.toml:9:32: error: contact.clearance_at_zero_pressure_m = 0 is not allowed.\n"
              "  expected: a number 1e-06 ... 1 [m]: normal exponential: c0, the pressure acts from this clearance "
              "on\n"
              "  fix:      for example  clearance_at_zero_pressure_m = 0.001");
    EXPECT_EQ(joint_message("normal = \"exponential\"\npressure_at_zero_clearance_MPa = 2\n"), "(accepted)");
}

TEST(JointInput, SoftPressureNeitherPullsNorFollowsASlipTolerance)
{
    EXPECT_EQ(joint_message("normal = \"exponential\"\nseparation = \"none\"\n"),
              "dam.toml:8:1: error: contact.normal = \"exponential\" with contact.separation = \"none\".\n"
              "  expected: separation = \"allowed\": the exponential pressure ends at its clearance, it cannot pull\n"
              "  fix:      write  separation = \"allowed\"  or  normal = \"hard\"");
    EXPECT_EQ(joint_message("normal = \"exponential\"\nenforcement = \"slip-tolerance\"\n"),
              "dam.toml:8:1: error: contact.normal = \"exponential\" with contact.enforcement = "
              "\"slip-tolerance\".\n"
              "  expected: enforcement = \"exact\" or \"penalty\" with the exponential pressure\n"
              "  fix:      write  enforcement = \"penalty\"  with tangential_stiffness_N_m3, or  enforcement = "
              "\"exact\"");
}

} // namespace
