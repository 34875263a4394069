#pragma once

#include "program_answer.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <unistd.h>
#include <vector>

/// What the tests of `damslip sweep` share.
namespace damslip::sweep_tests {

using Answer = ProgramAnswer;

inline std::string content_of(const std::filesystem::path& file)
{
    std::ifstream in(file, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
}

/// A folder (its name needs quoting) with a stiff 8 m x 2 m block, water to half its height, two pulses; FE runs of some
/// 150 steps.
class SweepScene : public testing::Test {
protected:
    void SetUp() override
    {
        folder = std::filesystem::temp_directory_path() / ("damslip sweep's " + std::to_string(::getpid()));
        std::filesystem::create_directories(folder);
        write("pulse.csv", "time_s,accel_m_s2\n0,0\n1,2\n2,0\n3,0\n");
        write("late.csv", "time_s,accel_m_s2\n0,0\n1,0\n2,2.5\n3,0\n4,0\n");
        write("block.toml",
              "[section]\npolygon_m = [[0, 0], [8, 0], [8, 2], [0, 2]]\n[dam]\ndensity_kg_m3 = 2500\n"
              "young_modulus_GPa = 2500\n[contact]\nfriction = 0.1\n[reservoir]\nlevel_m = 1\nmodel = "
              "\"added-mass\"\n[uplift]\n"
              "model = \"linear\"\n[mesh]\nsize_m = 1\ncontact_size_m = 1\n[time]\ndt_s = 0.02\nsubsteps = 0\n"
              "[[motion.record]]\nhorizontal = \"pulse.csv\"\n[[motion.record]]\nhorizontal = \"late.csv\"\n");
    }
    void TearDown() override { std::filesystem::remove_all(folder); }

    std::string path(const std::string& name) const { return (folder / name).string(); }
    void write(const std::string& name, const std::string& text) const { std::ofstream(folder / name) << text; }
    std::string content(const std::string& name) const { return content_of(folder / name); }

    /// `damslip sweep block.toml` and more.
    Answer sweep(std::vector<std::string> more) const
    {
        more.insert(more.begin(), {"sweep", path("block.toml")});
        return answer_of(more);
    }
    static std::vector<std::string> with(std::vector<std::string> a, const std::vector<std::string>& more)
    {
        a.insert(a.end(), more.begin(), more.end());
        return a;
    }

    std::filesystem::path folder;
    /// 2 variants x 4 motions x 3 frictions x (rigid, regression, fe, reduced fe) = 96 rows
    const std::vector<std::string> grid{"--friction", "0.01,0.1,0.15", "--size",   "1,2",
                                        "--polarity", "1,-1",          "--method", "rigid,jibson-1998,fe,fe-reduced",
                                        "--uplift",   "linear"};
};

} // namespace damslip::sweep_tests
