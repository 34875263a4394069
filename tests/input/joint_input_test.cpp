// Contact laws and sub-steps that contradict each other.
#include "core/input_error.hpp"
#include "scene/read.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

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

// Strengths and energies of a bond that breaks belong together; what says otherwise names the key that is missing.
TEST(JointInput, ABondThatBreaksHasItsStrengthsAndEnergies)
{
    const auto has = [](const std::string& contact, const std::vector<std::string>& parts) {
        const std::string message = joint_message(contact);
        for (const std::string& part : parts) EXPECT_NE(message.find(part), std::string::npos) << message;
    };
    const std::string breaks = "bond = \"fracture\"\n";
    EXPECT_EQ(joint_message(breaks + "cohesion_kPa = 500\nfracture_energy_shear_N_m = 1500\n"), "(accepted)");
    has("cohesion_kPa = 500\nbond = \"together\"\nfracture_energy_shear_N_m = 1500\n",
        {"dam.toml:10:1: error: contact.fracture_energy_shear_N_m is given, but the bond is lost together.",
         "write  bond = \"fracture\"  with its energies, or delete fracture_energy_shear_N_m"});
    has(breaks, {"contact breaks by energy, but contact.cohesion_kPa and contact.tensile_strength_kPa are both 0.",
                 "a strength above 0"});
    has(breaks + "cohesion_kPa = 500\n",
        {"contact has cohesion and breaks by energy, but no contact.fracture_energy_shear_N_m.",
         "add  fracture_energy_shear_N_m = 1500"});
    has(breaks + "tensile_strength_kPa = 300\n",
        {"contact has tensile strength, but no contact.fracture_energy_tension_N_m.",
         "add  fracture_energy_tension_N_m = 150"});
    has(breaks + "cohesion_kPa = 500\nfracture_energy_shear_N_m = 1500\ncohesion_lost_at_slip = false\n",
        {"contact.cohesion_lost_at_slip = false with a bond that breaks.", "delete cohesion_lost_at_slip"});
}

TEST(JointInput, SofteningAndDynamicIncreaseNeedABondThatBreaks)
{
    const auto has = [](const std::string& contact, const std::vector<std::string>& parts) {
        const std::string message = joint_message(contact);
        for (const std::string& part : parts) EXPECT_NE(message.find(part), std::string::npos) << message;
    };
    const std::string breaks = "cohesion_kPa = 500\nfracture_energy_shear_N_m = 1500\n";
    EXPECT_EQ(joint_message(breaks + "softening = \"exponential\"\ndynamic_increase = 1.2\n"), "(accepted)");
    has("cohesion_kPa = 500\nsoftening = \"exponential\"\n",
        {"dam.toml:9:1: error: contact.softening is given, but the bond is lost together.", "or delete softening"});
    has("cohesion_kPa = 500\nbond = \"pairs\"\ndynamic_increase = 1.2\n",
        {"dam.toml:10:1: error: contact.dynamic_increase is given, but the bond is lost by pairs.", "or delete dynamic_increase"});
    has(breaks + "dynamic_increase = 0.5\n", {"contact.dynamic_increase = 0.5 is not allowed.", "a number 1 ... 3"});
    has(breaks + "softening = \"linaer\"\n", {"dam.toml:10:13: error:", "one of \"linear\", \"exponential\""});
    has(breaks + "unloading = \"plastic\"\nsoftening = \"exponential\"\n",
        {"contact.softening is given with contact.unloading = \"plastic\".", "delete softening, or unloading"});
    has(breaks + "unloading = \"plastic\"\ndynamic_increase = 1.2\n",
        {"contact.dynamic_increase is given with contact.unloading = \"plastic\".", "delete dynamic_increase, or unloading"});
    has("[lifts]\nspacing_m = 3\nfriction = 0.8\nbond = \"bonded\"\ncohesion_kPa = 500\ntensile_strength_kPa = 300\n"
        "dynamic_increase = 1.2\n",
        {"lifts.dynamic_increase is given, but the lifts have no bond that breaks by energy.", "add the fracture energies"});
}

TEST(JointInput, LawsOfJointsNeedContactThatIsExactAndStepsThatAreImplicit)
{
    const std::string breaks = "bond = \"fracture\"\ncohesion_kPa = 500\nfracture_energy_shear_N_m = 1500\n";
    for (const auto& [other, instead] :
         {std::pair{"enforcement = \"penalty\"\ntangential_stiffness_N_m3 = 1e11\n", "enforcement = \"exact\""},
          {"separation = \"none\"\n", "separation = \"allowed\""},
          {"[time]\nscheme = \"central-difference\"\n", "scheme = \"hht\""}}) {
        const std::string message = joint_message(breaks + other);
        EXPECT_NE(message.find(instead + std::string(" with laws of joints beyond Coulomb's")), std::string::npos)
            << message;
        EXPECT_NE(message.find("or leave out "), std::string::npos) << message;
    }
}

// The longest element that carries the bond as it is: a quarter of the process zone, E' G / (4 f^2), here that of tension. On a rigid base E' is the dam's
// alone, in plane strain.
TEST(JointInput, ElementsLongerThanTheProcessZoneAreNoted)
{
    const auto notes = [](double size) {
        const Scene scene = parse_scene(
            "[section]\nheight_m = 20\nbase_m = 16\n[dam]\ndensity_kg_m3 = 2400\nyoung_modulus_GPa = 25\npoisson_ratio "
            "= 0.2\n"
            "[contact]\nfriction = 0.8\nbond = \"fracture\"\ncohesion_kPa = 2000\ntensile_strength_kPa = 1500\n"
            "fracture_energy_tension_N_m = 150\nfracture_energy_shear_N_m = 500\n[mesh]\ncontact_size_m = " +
                std::to_string(size) + "\n",
            "dam.toml", FileCheck::skip);
        for (const Diagnostic& note : scene.notes)
            if (note.problem.find("longer than a quarter of the bond's process zone") != std::string::npos)
                return note.problem + " " + note.expected;
        return std::string();
    };
    const std::string note = notes(2.0);
    ASSERT_NE(note, "");
    EXPECT_NE(note.find("elements of 2 m"), std::string::npos) << note;
    const std::size_t at = note.find("mesh.contact_size_m of at most ");
    ASSERT_NE(at, std::string::npos) << note;
    const double longest = std::stod(note.substr(at + 31));
    EXPECT_EQ(notes(0.999 * longest), "");
    EXPECT_NE(notes(1.001 * longest), "");
    const double modulus = 25e9 / (1.0 - 0.2 * 0.2), tension = modulus * 150.0 / (4.0 * 1.5e6 * 1.5e6);
    EXPECT_NEAR(longest, tension, 1e-5 * tension); // printed with six digits
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
