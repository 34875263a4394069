// The commands of records against values by hand: a pulse and half a sine.
#include "program_answer.hpp"

#include "core/file.hpp"
#include "records/generate/wavelet_match.hpp"
#include "records/measure/measures.hpp"
#include "records/read/read_record.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <numbers>
#include <unistd.h>

namespace damslip {
namespace {

using Json = nlohmann::json;

class RecordCommand : public testing::Test {
protected:
    void SetUp() override
    {
        std::filesystem::create_directories(folder);
        // A triangle of 2 m/s^2 and 0.4 s, then rest.
        std::string samples = "# units: m/s2\nt,a\n";
        for (int k = 0; k <= 100; ++k)
            samples += fmt::format("{:.2f},{}\n", 0.01 * k, std::max(0.0, 2.0 - std::abs(k - 20) * 0.1));
        write_file(triangle, samples);
    }
    void TearDown() override { std::filesystem::remove_all(folder); }

    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / fmt::format("damslip record command {}", ::getpid());
    const std::filesystem::path triangle = folder / "triangle.csv";
};

TEST_F(RecordCommand, InfoMeasuresATriangleByHand)
{
    const ProgramAnswer answer = answer_of({"record", "info", triangle.string(), "--json"});
    ASSERT_EQ(answer.code, 0) << answer.talk;
    const Json row = Json::parse(answer.out)["records"][0];
    EXPECT_DOUBLE_EQ(row["pga_m_s2"].get<double>(), 2.0);
    EXPECT_NEAR(row["pgv_m_s"].get<double>(), 0.4, 1e-12); // A T / 2
    EXPECT_NEAR(row["cav_m_s"].get<double>(), 0.4, 1e-12);
    // 2 A^2 (T / 2) / 3 by pi / (2 g)
    EXPECT_NEAR(row["arias_intensity_m_s"].get<double>(), std::numbers::pi / (2.0 * 9.80665) * 4.0 * 0.4 / 3.0, 1e-12);
    const ProgramAnswer words = answer_of({"record", "info", triangle.string()});
    EXPECT_NE(words.out.find("triangle"), std::string::npos);
    EXPECT_EQ(words.out.find(row["sha256"].get<std::string>()), std::string::npos) << "a checksum in a table to read";
}

// A rigid oscillator has the ground's peak; a slow one follows the ground's velocity step: S_v near the velocity after the pulse, by hand 0.4 m/s.
TEST_F(RecordCommand, SpectrumHasItsLimitsByHand)
{
    const std::filesystem::path to = folder / "spectrum.csv";
    const ProgramAnswer answer = answer_of({"record", "spectrum", triangle.string(), "--damping", "0", "--from", "0.02",
                                            "--to", "10", "--count", "25", "--out", to.string(), "--json"});
    ASSERT_EQ(answer.code, 0) << answer.talk;
    const Json spectrum = Json::parse(answer.out);
    EXPECT_EQ(spectrum["damping_ratio"].get<double>(), 0.0);
    ASSERT_EQ(spectrum["points"].size(), 25u);
    const Json &first = spectrum["points"].front(), &last = spectrum["points"].back();
    EXPECT_NEAR(first["period_s"].get<double>(), 0.02, 1e-12);
    EXPECT_NEAR(first["pseudo_acceleration_m_s2"].get<double>(), 2.0, 0.02); // T a twentieth of the triangle's half
    // Long T: S_d = v T / (2 pi) |F|, F = sinc^2(w T_p / 4) of a triangle: 1 - 1.3e-3 here
    const double w = 2.0 * std::numbers::pi / 10.0, s = std::sin(w * 0.1) / (w * 0.1);
    EXPECT_NEAR(last["displacement_m"].get<double>(), 0.4 / w * s * s, 1e-4 * 0.4 / w);
    const std::string csv = read_file(to);
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 25 + 2); // a comment and the heads
    const ProgramAnswer words = answer_of({"record", "spectrum", triangle.string(), "--count", "3"});
    EXPECT_NE(words.out.find("m/s²"), std::string::npos) << words.out;
}

TEST_F(RecordCommand, ConvertHalvesTheStepAndKeepsTheRecord)
{
    const std::filesystem::path to = folder / "fine.at2";
    const ProgramAnswer answer =
        answer_of({"record", "convert", triangle.string(), "--new-dt", "0.005", "--out", to.string(), "--json"});
    ASSERT_EQ(answer.code, 0) << answer.talk;
    EXPECT_NEAR(Json::parse(answer.out)["record"]["pgv_m_s"].get<double>(), 0.4, 1e-9);
    const Record fine = records::read_record(to, {});
    EXPECT_EQ(fine.dt, 0.005);
    ASSERT_EQ(fine.acceleration.size(), 201u);
    for (std::size_t k = 0; k < fine.acceleration.size();
         ++k) // on the lines between the samples; at2 has seven digits of g
        EXPECT_NEAR(fine.acceleration[k], std::max(0.0, 2.0 - std::abs(0.5 * static_cast<double>(k) - 20.0) * 0.1),
                    1e-5);
    const ProgramAnswer refused = answer_of({"record", "convert", triangle.string(), "--new-dt", "2"});
    EXPECT_EQ(refused.code, 2);
    EXPECT_NE(refused.talk.find("--new-dt 2 is not allowed."), std::string::npos) << refused.talk;
}

// A made record says how near it came, has the PGA that was asked for, and where the bar cannot be met answers with the code of no answer.
TEST_F(RecordCommand, GenerateSaysHowNearItCame)
{
    const std::filesystem::path to = folder / "made.csv";
    const std::vector<std::string> line{"record",     "generate", "--target", "rock", "--duration", "8",
                                        "--pga-m-s2", "1.25",     "--seed",   "3",    "--out",      to.string()};
    ProgramAnswer answer = answer_of(line);
    EXPECT_EQ(answer.code, 0) << answer.talk;
    EXPECT_NE(answer.talk.find("spectrum within"), std::string::npos) << answer.talk;
    EXPECT_NE(answer.talk.find("made.csv: 801 samples, dt = 0.01 s"), std::string::npos) << answer.talk;
    const Record made = records::read_record(to, {});
    double peak = 0.0;
    for (const double a : made.acceleration) peak = std::max(peak, std::abs(a));
    EXPECT_NEAR(peak, 1.25, 1e-6);
    // The rock's shape as a file of 60 periods is met as well: within the 10 % of the match, and 1 % for what lies between its rows.
    std::string shape;
    for (int k = 0; k < 60; ++k) {
        const double period = 0.02 * std::pow(4.0 / 0.02, k / 59.0);
        shape += fmt::format("{},{}\n", period, records::rock_spectrum().amplification(period));
    }
    write_file(folder / "shape.csv", "period_s,sa\n" + shape);
    std::vector<std::string> by_file = line;
    by_file[3] = (folder / "shape.csv").string();
    answer = answer_of(by_file);
    EXPECT_EQ(answer.code, 0) << answer.talk;
    const Record by_shape = records::read_record(to, {});
    const std::vector<double> periods{0.07, 0.3, 1.1};
    const auto spectrum = records::response_spectrum(by_shape.acceleration, by_shape.dt, periods, 0.05);
    for (std::size_t k = 0; k < periods.size(); ++k)
        EXPECT_NEAR(spectrum.points[k].pseudo_acceleration /
                        (1.25 * records::rock_spectrum().amplification(periods[k])),
                    1.0, 0.11)
            << periods[k];
    std::vector<std::string> too_fine = line;
    too_fine.insert(too_fine.end(), {"--tolerance", "0.01", "--quiet"});
    EXPECT_EQ(answer_of(too_fine).code, 4);
    std::vector<std::string> unknown = line;
    unknown[3] = "granite";
    answer = answer_of(unknown);
    EXPECT_NE(answer.code, 0);
    EXPECT_NE(answer.talk.find("granite"), std::string::npos) << answer.talk;
}

} // namespace
} // namespace damslip
