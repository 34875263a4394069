// The column that softens with its strain: closed forms, SLAMMER's iteration, and what `screen` says of it.
#include "program_answer.hpp"
#include "sliding/flexible/flexible_mode.hpp"
#include "verification/external/slammer_scheme.hpp"

#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <numbers>
#include <unistd.h>

namespace damslip::sliding {

namespace {

using std::numbers::pi;

/// A burst of ten cycles of f [Hz], rising and falling as a sine.
GroundMotion burst(double amplitude, double f)
{
    GroundMotion motion;
    motion.name = "burst";
    motion.dt = 0.005;
    const double length = 10.0 / f;
    for (int k = 0; k * motion.dt <= length; ++k) {
        const double t = k * motion.dt;
        motion.accel_h.push_back(amplitude * std::sin(pi * t / length) * std::sin(2.0 * pi * f * t));
    }
    return motion;
}

TEST(StrainColumn, linear_column_has_four_travel_times_and_the_damping_of_both)
{
    const StrainCompatible c = strain_compatible({30.0, 400.0, 0.05, 1200.0, 0.0}, burst(2.0, 3.0), 0.81);
    EXPECT_DOUBLE_EQ(c.block.period, 4.0 * 30.0 / 400.0);
    EXPECT_NEAR(c.block.damping_ratio, 0.05 + 0.55016 * std::pow(3.0, -0.9904), 1e-15);
    EXPECT_EQ(c.iterations, 0);
    EXPECT_TRUE(c.settled);
    EXPECT_EQ(strain_compatible({30.0, 400.0, 0.05, 0.0, 0.0}, burst(2.0, 3.0), 0.81).block.damping_ratio, 0.05);
    // Rock as soft as the column would take 55 %: no more than 20 % is given to it.
    EXPECT_NEAR(strain_compatible({30.0, 400.0, 0.05, 400.0, 0.0}, burst(2.0, 3.0), 0.81).block.damping_ratio, 0.25,
                1e-15);
}

/// A slow ramp of acceleration: x follows a/omega^2, so the strain is known without integrating.
TEST(StrainColumn, slow_motion_strains_it_as_a_static_load)
{
    GroundMotion motion;
    motion.dt = 0.01;
    for (int k = 0; k <= 4000; ++k) motion.accel_h.push_back(2.0 * std::sin(pi * k / 4000.0));
    const double height = 20.0, velocity = 500.0, reference = 5e-4;
    const StrainCompatible c = strain_compatible({height, velocity, 0.05, 0.0, reference}, motion, 0.81, 1e-10);
    ASSERT_TRUE(c.settled);
    // gamma = 0.65 · 1.57 · (4/pi) (a/omega^2)/H with omega = pi V_s/(2H): gamma = K (1 + gamma/gamma_r), solved for gamma.
    const double k = 0.65 * 1.57 * 4.0 / pi * 2.0 * std::pow(2.0 * height / (pi * velocity), 2) / height;
    const double strain = k / (1.0 - k / reference);
    EXPECT_NEAR(c.strain, strain, 2e-4 * strain); // 40 s of load on 0.2 s of period: x leads a/omega^2 by 1e-4
    EXPECT_NEAR(c.velocity, velocity / std::sqrt(1.0 + strain / reference), 1e-4 * velocity);
}

/// SLAMMER's scheme stops at 5 % and steps by Newmark's average acceleration; with its tolerance and a small step both are the same.
TEST(StrainColumn, is_the_iteration_of_slammer)
{
    for (const double amplitude : {0.5, 2.0, 5.0}) {
        const GroundMotion motion = burst(amplitude, 2.0);
        const StrainCompatible ours = strain_compatible({40.0, 350.0, 0.05, 1100.0, 5e-4}, motion, 0.81, 0.05);
        const auto theirs =
            external::slammer_equivalent_linear({40.0, 350.0, 1100.0, 0.05, 0.05}, motion.accel_h, motion.dt);
        ASSERT_TRUE(theirs);
        EXPECT_EQ(ours.iterations, theirs->iterations);
        EXPECT_NEAR(ours.velocity, theirs->velocity, 1e-3 * theirs->velocity) << amplitude;
        EXPECT_NEAR(ours.block.damping_ratio, theirs->damping, 2e-3 * theirs->damping) << amplitude;
    }
}

class ColumnScene : public testing::Test {
protected:
    void SetUp() override
    {
        folder = std::filesystem::temp_directory_path() / ("damslip column " + std::to_string(::getpid()));
        std::filesystem::create_directories(folder);
        std::ofstream record(folder / "burst.csv");
        record << "time_s,accel_m_s2\n";
        const GroundMotion motion = burst(4.0, 2.5);
        for (std::size_t k = 0; k < motion.accel_h.size(); ++k)
            record << 0.005 * static_cast<double>(k) << "," << motion.accel_h[k] << "\n";
    }
    void TearDown() override { std::filesystem::remove_all(folder); }

    ProgramAnswer screen(const std::string& flexible, const std::string& command = "screen") const
    {
        const std::filesystem::path scene = folder / "scene.toml";
        std::ofstream(scene)
            << "[section]\nheight_m = 10\nbase_m = 20\n[dam]\ndensity_kg_m3 = 2000\n[contact]\nfriction = 0.05\n"
               "[flexible_block]\n"
            << flexible << "[[motion.record]]\nhorizontal = \"burst.csv\"\n";
        std::vector<std::string> words{command, scene.string(), "--json"};
        if (command == "sweep") words.insert(words.end(), {"--method", "decoupled,coupled"});
        return answer_of(words);
    }

    std::filesystem::path folder;
};

TEST_F(ColumnScene, screen_shows_it_and_slides_on_its_mode)
{
    const std::string column = "height_m = 40\nshear_velocity_m_s = 350\nbase_velocity_m_s = 1100\n";
    const ProgramAnswer soft = screen(column + "reference_strain_percent = 0.05\n");
    ASSERT_EQ(soft.code, 0) << soft.talk;
    const auto answer = nlohmann::json::parse(soft.out);
    const auto& row = answer["flexible_block"][0];
    const double velocity = row["column_velocity_m_s"].get<double>(), period = row["column_period_s"].get<double>();
    EXPECT_LT(velocity, 350.0);
    EXPECT_NEAR(period, 160.0 / velocity, 1e-12);
    // A block with that period and damping given slides as far, and a sweep has the same row.
    const ProgramAnswer given = screen(
        fmt::format("period_s = {:.17g}\ndamping = {:.17g}\n", period, row["column_damping"].get<double>() / 100.0));
    const auto same = nlohmann::json::parse(given.out);
    const double slip = row["coupled_max_slip_mm"].get<double>();
    EXPECT_GT(slip, 1.0);
    EXPECT_NEAR(same["flexible_block"][0]["coupled_max_slip_mm"].get<double>(), slip, 1e-9 * slip);
    const ProgramAnswer swept = screen(column + "reference_strain_percent = 0.05\n", "sweep");
    const auto rows = nlohmann::json::parse(swept.out);
    EXPECT_NEAR(1e3 * rows["rows"][1]["max_slip_m"].get<double>(), slip, 1e-12 * slip);
}

TEST_F(ColumnScene, half_a_column_is_refused)
{
    const ProgramAnswer half = screen("height_m = 40\n");
    EXPECT_EQ(half.code, 3);
    EXPECT_NE(half.talk.find("shear_velocity"), std::string::npos) << half.talk;
    const ProgramAnswer twice = screen("height_m = 40\nshear_velocity_m_s = 350\nperiod_s = 0.2\n");
    EXPECT_NE(twice.talk.find("delete period_s"), std::string::npos) << twice.talk;
    const ProgramAnswer strain = screen("period_s = 0.2\nreference_strain_percent = 0.05\n");
    EXPECT_NE(strain.talk.find("without a column"), std::string::npos) << strain.talk;
}

} // namespace

} // namespace damslip::sliding
