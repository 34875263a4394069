// [flexible_block] through `damslip screen`: defaults, mass ratios, one analysis or both, period and ratio of the tied modes.
#include "analysis/prepare/flexible_mass.hpp"
#include "cli/program.hpp"
#include "scene/read.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>
#include <unistd.h>

namespace {

using namespace damslip;
using FlexibleJson = nlohmann::json;

class FlexibleScene : public testing::Test {
protected:
    void SetUp() override
    {
        folder = std::filesystem::temp_directory_path() / ("damslip_flexible_" + std::to_string(::getpid()));
        std::filesystem::create_directories(folder);
        std::ofstream csv(folder / "wave.csv");
        csv << "time_s,accel_m_s2\n";
        for (int k = 0; k <= 500; ++k)
            csv << 0.01 * k << "," << 3.0 * std::sin(0.16 * k) * std::sin(0.00628318 * k) << "\n";
    }
    void TearDown() override { std::filesystem::remove_all(folder); }

    FlexibleJson rows(const std::string& flexible, const std::string& dam = "")
    {
        const std::string file = (folder / "block.toml").string();
        std::ofstream(file) << "[section]\nheight_m = 20\nbase_m = 40\ncrest_m = 40\n[dam]\ndensity_kg_m3 = 2000\n"
                            << dam << "[contact]\nfriction = 0.12\n[[motion.record]]\nhorizontal = \"wave.csv\"\n"
                            << flexible;
        std::ostringstream out, talk;
        code = cli::run_program({"screen", file, "--json", "--quiet"}, out, talk, false);
        told = talk.str();
        EXPECT_EQ(code, 0) << told;
        const FlexibleJson j = FlexibleJson::parse(out.str());
        warnings = j.value("warnings", FlexibleJson::array()).dump();
        return j.value("flexible_block", FlexibleJson());
    }

    std::filesystem::path folder;
    std::string told, warnings;
    int code = 0;
};

TEST_F(FlexibleScene, PeriodAloneIsWhatItWas)
{
    const FlexibleJson old = rows("[regressions]\nperiod_s = 0.4\n");
    ASSERT_EQ(old.size(), 2u);
    EXPECT_GT(old[0]["coupled_max_slip_mm"].get<double>(), 1.0);
    EXPECT_EQ(rows("[flexible_block]\nperiod_s = 0.4\n"), old);
    EXPECT_EQ(rows("[flexible_block]\nperiod_s = 0.4\ndamping = 0.05\nmode = \"both\"\n"), old);
    EXPECT_TRUE(rows("").is_null());
}

TEST_F(FlexibleScene, DampingAndMassRatioMatter)
{
    const double slip = rows("[flexible_block]\nperiod_s = 0.4\n")[0]["coupled_max_slip_mm"];
    EXPECT_LT(rows("[flexible_block]\nperiod_s = 0.4\ndamping = 0.3\n")[0]["coupled_max_slip_mm"].get<double>(), slip);
    EXPECT_NE(rows("[flexible_block]\nperiod_s = 0.4\nmass_ratio = 0.4\n")[0]["coupled_max_slip_mm"].get<double>(),
              slip);
}

// A rectangle's (y/H)^1.5 has Gamma = 4/2.5^2 = 0.64; the same by L and M_1 of 1 600 000 kg/m: L = 640 000, M_1 = 400 000.
TEST_F(FlexibleScene, ThreeWaysToTheSameMassRatio)
{
    const FlexibleJson by_ratio = rows("[flexible_block]\nperiod_s = 0.4\nmass_ratio = 0.64\n"),
                       by_shape = rows("[flexible_block]\nperiod_s = 0.4\nshape_exponent = 1.5\n"),
                       by_sums = rows(
                           "[flexible_block]\nperiod_s = 0.4\nmodal_load_kg_m = 640000\nmodal_mass_kg_m = 400000\n");
    for (const char* key : {"coupled_max_slip_mm", "decoupled_max_slip_mm"}) {
        const double slip = by_ratio[0][key];
        EXPECT_NEAR(by_shape[0][key].get<double>(), slip, 1e-9 * slip);
        EXPECT_NEAR(by_sums[0][key].get<double>(), slip, 1e-9 * slip);
    }
}

TEST_F(FlexibleScene, OneAnalysisAlone)
{
    const FlexibleJson both = rows("[flexible_block]\nperiod_s = 0.4\n"),
                       one = rows("[flexible_block]\nperiod_s = 0.4\nmode = \"decoupled\"\n"),
                       other = rows("[flexible_block]\nperiod_s = 0.4\nmode = \"coupled\"\n");
    EXPECT_EQ(one[0]["decoupled_max_slip_mm"], both[0]["decoupled_max_slip_mm"]);
    EXPECT_TRUE(one[0]["coupled_max_slip_mm"].is_null());
    EXPECT_EQ(other[0]["coupled_max_slip_mm"], both[0]["coupled_max_slip_mm"]);
    EXPECT_TRUE(other[0]["decoupled_max_slip_mm"].is_null());
}

// A block 40 m wide and 20 m high shears and bends: its period lies near 4 H/v_s, v_s^2 = G/rho, of a shear column, and its
// effective mass between those of a slender cantilever (0.613) and of a shear column (8/pi^2 = 0.811).
TEST_F(FlexibleScene, PeriodOfTheTiedModes)
{
    const FlexibleJson found = rows("[flexible_block]\nperiod_s = \"modes\"\n", "young_modulus_GPa = 0.4\n");
    EXPECT_GT(found[0]["coupled_max_slip_mm"].get<double>(), 0.0);
    EXPECT_NE(warnings.find("of the tied model, T_s = "), std::string::npos) << warnings;
    Scene scene = read_scene(folder / "block.toml");
    resolve_flexible_modes(scene);
    const double shear_speed = std::sqrt(0.4e9 / (2 * 1.2) / 2000.0);
    EXPECT_NEAR(*scene.flexible_block->period, 4 * 20 / shear_speed, 0.25 * 4 * 20 / shear_speed);
    EXPECT_GT(*scene.flexible_block->mass_ratio, 0.613);
    EXPECT_LT(*scene.flexible_block->mass_ratio, 8 / (std::numbers::pi * std::numbers::pi));
}

} // namespace
