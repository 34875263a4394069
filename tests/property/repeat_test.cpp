// The same bytes from the same scene: run again, and on any number of threads. (`sweep`: tests/unit/sweep_test.cpp; random
// scenes: tests/random.)
#include "cli/program.hpp"
#include "core/file.hpp"

#include <gtest/gtest.h>

#include <sstream>
#include <unistd.h>

namespace {

class Repeat : public testing::Test {
protected:
    void SetUp() override
    {
        folder_ = std::filesystem::temp_directory_path() / ("damslip-repeat-" + std::to_string(::getpid()));
        std::string records;
        for (int k = 0; k < 5; ++k) {
            const std::string name = "pulse" + std::to_string(k) + ".csv", top = std::to_string(2 + k);
            damslip::write_file(folder_ / name, "time_s,accel_m_s2\n0,0\n0.2," + top + "\n0.4,-" + top +
                                                    "\n0.6,0\n0.8," + top + "\n1,0\n");
            records += "[[motion.record]]\nhorizontal = \"" + name + "\"\n";
        }
        damslip::write_file(
            folder_ / "dam.toml",
            "[section]\nheight_m = 12\nbase_m = 9\ncrest_m = 3\n[dam]\ndensity_kg_m3 = 2400\nyoung_modulus_GPa = 25\n"
            "[contact]\nfriction = 0.7\n[foundation]\nyoung_modulus_GPa = 30\nwidth_m = 40\ndepth_m = 15\n"
            "mass = \"massless\"\n[curtain]\ndistance_m = 2\ndepth_m = 5\nthickness_m = 0.7\n[reservoir]\nlevel_m = 9\n"
            "model = \"acoustic\"\nmesh_size_m = 2\n[uplift]\nmodel = \"seepage\"\n[mesh]\nsize_m = 3\n"
            "contact_size_m = 1.5\ngrowth = 2\n[time]\ndt_s = 0.02\nsubsteps = 1\n" +
                records);
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    /// Answer without the lines that carry measured seconds.
    std::string answer(const std::string& command, const std::vector<std::string>& more = {})
    {
        std::vector<std::string> arguments{command, (folder_ / "dam.toml").string(), "--json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        std::ostringstream out, talk;
        EXPECT_EQ(damslip::cli::run_program(arguments, out, talk, false), 0) << talk.str();
        std::istringstream in(out.str());
        std::string kept;
        for (std::string line; std::getline(in, line);)
            if (line.find("seconds\":") == std::string::npos) kept += line + "\n";
        EXPECT_GT(kept.size(), 500u);
        return kept;
    }

    const std::filesystem::path& folder() const { return folder_; }

private:
    std::filesystem::path folder_;
};

TEST_F(Repeat, ScreenOnAnyNumberOfThreads)
{
    const std::string one = answer("screen", {"--jobs", "1"});
    EXPECT_EQ(answer("screen", {"--jobs", "1"}), one);
    EXPECT_EQ(answer("screen", {"--jobs", "2"}), one);
    EXPECT_EQ(answer("screen", {"--jobs", "4"}), one);
}

TEST_F(Repeat, FiniteElementRunsAndModes)
{
    EXPECT_EQ(answer("fe"), answer("fe"));
    EXPECT_EQ(answer("fe", {"--base", "tied"}), answer("fe", {"--base", "tied"}));
    EXPECT_EQ(answer("modes"), answer("modes"));
}

TEST_F(Repeat, ReducedRuns)
{
    EXPECT_EQ(answer("fe", {"--reduced"}), answer("fe", {"--reduced"}));
}

} // namespace
