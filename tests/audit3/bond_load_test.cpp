// What a bond is said to carry (A13), and whether its elements carry it (A11).
#include "core/file.hpp"
#include "program_answer.hpp"

#include <filesystem>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

namespace {

using namespace damslip;

/// A folder of this process with a record that hardly shakes.
std::filesystem::path folder()
{
    const auto at = std::filesystem::temp_directory_path() / ("damslip_bond_load_" + std::to_string(::getpid()));
    std::filesystem::create_directories(at);
    write_file(at / "r.csv", "# units: m/s2\n# dt: 0.01 s\n0\n0.01\n0\n0\n");
    return at;
}

/// A block of 20 x 10 m pushed at half its height; its bond breaks in shear alone.
std::string pushed_block(const std::string& force_kN_m)
{
    return "[section]\npolygon_m = [[0, 0], [20, 0], [20, 10], [0, 10]]\n"
           "[dam]\ndensity_kg_m3 = 2400\nyoung_modulus_GPa = 25\npoisson_ratio = 0\n"
           "[contact]\nfriction = 0.6\ncohesion_kPa = 500\nfracture_energy_shear_N_m = 200\n"
           "[[force]]\nname = \"push\"\nx_m = 0\ny_m = 5\nforce_x_kN_m = " +
           force_kN_m +
           "\n[mesh]\nsize_m = 2\ncontact_size_m = 1\n"
           "[[motion.record]]\nname = \"r\"\nhorizontal = \"r.csv\"\n";
}

TEST(Audit3, A13_NoLoadThatStandsIsAboveTMax)
{
    const auto stages_of = [](const std::string& force) {
        write_file(folder() / "block.toml", pushed_block(force));
        const ProgramAnswer answer = answer_of(
            {"fe", (folder() / "block.toml").string(), "--no-mesh-error", "--polarity", "1", "--json", "--quiet"});
        return nlohmann::json::parse(answer.out).at("stages");
    };
    const auto pushed = [](const nlohmann::json& stages) {
        for (const auto& row : stages)
            if (row.at("stage") == "water") return row;
        return nlohmann::json();
    };
    const nlohmann::json lighter = pushed(stages_of("7500")), heavier = pushed(stages_of("9000"));
    ASSERT_EQ(lighter.at("status"), "stands") << lighter;
    ASSERT_EQ(heavier.at("status"), "BOND BREAKS") << heavier;
    EXPECT_GE(9000.0 * heavier.at("t_max").get<double>(), 7500.0) << heavier;
    EXPECT_LE(heavier.at("t_max").get<double>(), heavier.at("t_limit").get<double>()) << heavier;
}

/// A dam with a bonded lift joint: its mesh resolves a quarter of the process zone, but no more than 240 elements along the joint.
std::string lift_with_bond(const std::string& energy_N_m)
{
    return "[section]\nheight_m = 16\nbase_m = 12\ncrest_m = 3\n"
           "[dam]\ndensity_kg_m3 = 2400\nyoung_modulus_GPa = 25\npoisson_ratio = 0.2\n"
           "[contact]\nfriction = 1\n"
           "[[lift_joint]]\nname = \"neck\"\nelevation_m = 12\nfriction = 1\ncohesion_kPa = 1800\n"
           "tensile_strength_kPa = 1800\nfracture_energy_shear_N_m = 1800\nfracture_energy_tension_N_m = " +
           energy_N_m + "\n[mesh]\nsize_m = 2\n[[motion.record]]\nname = \"r\"\nhorizontal = \"r.csv\"\n";
}

TEST(Audit3, A11_ALiftTooCoarseForItsBondIsSaidBeforeTheRun)
{
    for (const auto& [energy, said] : {std::pair{"1", true}, std::pair{"180", false}}) { // a quarter: 2 mm, 0.36 m
        write_file(folder() / "lift.toml", lift_with_bond(energy));
        const ProgramAnswer answer =
            answer_of({"explain", (folder() / "lift.toml").string(), "--method", "fe"});
        EXPECT_EQ(answer.code, 0) << answer.talk;
        const std::string all = answer.out + answer.talk;
        EXPECT_EQ(all.find("neck: elements of") != std::string::npos, said) << energy;
    }
}

} // namespace
