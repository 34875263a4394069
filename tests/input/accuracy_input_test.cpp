// Wrong command lines of `damslip accuracy`, scenes without some kinds of model levels, and what it writes.
#include "cli/program.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <unistd.h>

namespace damslip::accuracy_input {

namespace {

class AccuracyInput : public testing::Test {
protected:
    void SetUp() override
    {
        folder = std::filesystem::temp_directory_path() / ("damslip_accuracy_input_" + std::to_string(::getpid()));
        std::filesystem::create_directories(folder);
        write("pulse.csv", "time_s,accel_m_s2\n0,0\n1,7\n2,0\n3,0\n");
        const std::string block = "[section]\nheight_m = 10\nbase_m = 8\n[contact]\nfriction = 0.5\n";
        const std::string record = "[[motion.record]]\nname = \"pulse\"\nhorizontal = \"pulse.csv\"\n";
        write("rigid.toml", block + "[dam]\ndensity_kg_m3 = 2500\n" + record);
        write("still.toml", block + "[dam]\ndensity_kg_m3 = 2500\n");
        write("elastic.toml", block +
                                  "[dam]\ndensity_kg_m3 = 2500\nyoung_modulus_GPa = 25\n[mesh]\nsize_m = 2\n"
                                  "contact_size_m = 1\n[time]\ndt_s = 0.02\n" +
                                  record);
    }
    void TearDown() override { std::filesystem::remove_all(folder); }
    std::string path(const std::string& name) const { return (folder / name).string(); }
    void write(const std::string& name, const std::string& text) const { std::ofstream(folder / name) << text; }
    std::string content(const std::string& name) const
    {
        std::ifstream in(folder / name);
        return std::string(std::istreambuf_iterator<char>(in), {});
    }

    /// @returns what went to standard output
    std::string run(const std::vector<std::string>& arguments, int code, const std::string& talk_part = "") const
    {
        std::ostringstream out, talk;
        std::vector<std::string> all{"accuracy"};
        all.insert(all.end(), arguments.begin(), arguments.end());
        EXPECT_EQ(cli::run_program(all, out, talk, false), code) << out.str() << talk.str();
        EXPECT_NE(talk.str().find(talk_part), std::string::npos) << talk.str();
        return out.str();
    }
    std::filesystem::path folder;
};

TEST_F(AccuracyInput, OptionsOutsideTheirRange)
{
    const std::string scene = path("rigid.toml");
    run({scene, "--tolerance", "0"}, 2, "for 2 % write  --tolerance 0.02");
    run({scene, "--tolerance", "-0.1"}, 2, "--tolerance -0.1 is not allowed");
    run({scene, "--repeats", "0"}, 2, "--repeats 0 is not allowed");
    run({scene, "--budget", "0"}, 2, "--budget 0 is not allowed");
    run({scene, "--rung", "fe:dt"}, 2, "--model-level fe:dt is not known");
    run({scene, "--model-level", "fe-acoustic:dt/3"}, 2, "a model level as the table names it");
    run({path("still.toml")}, 3, "the scene has no record");
}

TEST_F(AccuracyInput, ASceneWithoutElasticityHasNoFiniteElementsAndSaysSo)
{
    const std::string out = run({path("rigid.toml")}, 0);
    EXPECT_NE(out.find("No finite elements: dam.young_modulus_GPa is not given."), std::string::npos);
    EXPECT_NE(out.find("No model level with vertical motion"), std::string::npos);
    EXPECT_EQ(out.find("fe-"), std::string::npos);
    EXPECT_NE(out.find("Cheapest model level within 2 %: rigid:h"), std::string::npos);
}

TEST_F(AccuracyInput, AModelLevelThatTheSceneCannotRunIsRefused)
{
    for (const char* part : {"rigid.toml: error: --model-level fe-dry:dt is refused", "young_modulus", "expected:", "fix:"})
        run({path("rigid.toml"), "--rung", "fe-dry:dt"}, 3, part);
}

TEST_F(AccuracyInput, WritesReportTableFigureAndTheScenesOfItsModelLevels)
{
    run({path("elastic.toml"), "--quick", "--repeats", "1", "--tolerance", "0.9", "--out", path("out"), "--svg",
         path("own.svg")},
        0, "report: " + path("out/report.html"));
    for (const char* file : {"report.html", "accuracy.csv", "accuracy.svg", "summary.json", "scene_resolved.toml",
                             "rungs/fe-dry_dt.toml", "rungs/fe-dry_dt_2.toml"})
        EXPECT_TRUE(std::filesystem::exists(folder / "out" / file)) << file;
    EXPECT_EQ(content("own.svg"), content("out/accuracy.svg"));
    EXPECT_NE(content("out/accuracy.csv").find("\nfe-dry:dt/4,"), std::string::npos) << content("out/accuracy.csv");
    EXPECT_NE(content("out/rungs/fe-dry_dt_2.toml").find("substeps = 1"), std::string::npos);
}

} // namespace

} // namespace damslip::accuracy_input
