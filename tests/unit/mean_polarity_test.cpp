#include "program_answer.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

namespace damslip {
namespace {

/// A dry block on friction 0.1 under two pulses of different size, one each way.
class MeanPolarity : public testing::Test {
protected:
    void SetUp() override
    {
        folder = std::filesystem::temp_directory_path() / ("damslip_mean_" + std::to_string(::getpid()));
        std::filesystem::create_directories(folder);
        std::ofstream(folder / "pulse.csv") << "time_s,accel_m_s2\n0,0\n1,2\n2,0\n3,-1.5\n4,0\n5,0\n";
        std::ofstream(folder / "block.toml")
            << "[section]\nheight_m = 10\nbase_m = 8\n[dam]\ndensity_kg_m3 = 2500\n[contact]\nfriction = 0.1\n"
               "[sliding]\ntwo_way = false\n[[motion.record]]\nhorizontal = \"pulse.csv\"\n";
    }
    void TearDown() override { std::filesystem::remove_all(folder); }
    nlohmann::json json(std::vector<std::string> words) const
    {
        words.insert(words.begin() + 1, (folder / "block.toml").string());
        words.push_back("--json");
        const ProgramAnswer a = answer_of(words);
        EXPECT_EQ(a.code, 0) << a.talk;
        return nlohmann::json::parse(a.out);
    }
    std::filesystem::path folder;
};

TEST_F(MeanPolarity, ScreenHasItWhereItIsAskedFor)
{
    const auto with = json({"screen", "--mean-polarity"}), without = json({"screen"});
    const double one = with["displacements"][0]["slip_h_mm"], other = with["displacements"][1]["slip_h_mm"];
    EXPECT_GT(one, 0.0);
    EXPECT_NE(one, other);
    EXPECT_NEAR(with["mean_of_polarities"][0]["mean_slip_h_mm"].get<double>(), 0.5 * (one + other), 1e-12 * one);
    EXPECT_FALSE(without.contains("mean_of_polarities"));
    EXPECT_EQ(with["displacements"], without["displacements"]);
}

TEST_F(MeanPolarity, SweepHasAColumn)
{
    const auto rows = json({"sweep", "--friction", "0.08,0.1", "--polarity", "1,-1", "--mean-polarity"})["rows"];
    ASSERT_EQ(rows.size(), 4u);
    for (const std::size_t first : {0u, 2u}) {
        const double one = rows[first]["slip_m"], other = rows[first + 1]["slip_m"];
        EXPECT_NE(one, other);
        for (const std::size_t i : {first, first + 1})
            EXPECT_NEAR(rows[i]["mean_slip_m"].get<double>(), 0.5 * (one + other), 1e-12 * std::abs(one));
    }
    EXPECT_FALSE(json({"sweep", "--polarity", "1,-1"})["rows"][0].contains("mean_slip_m"));
}

TEST_F(MeanPolarity, OnePolarityHasNoMean)
{
    const ProgramAnswer a =
        answer_of({"sweep", (folder / "block.toml").string(), "--polarity", "1", "--mean-polarity"});
    EXPECT_EQ(a.code, 2);
    EXPECT_NE(a.talk.find("--polarity 1,-1"), std::string::npos) << a.talk;
}

} // namespace
} // namespace damslip
