// Planes in `screen` and `sweep`: the dam "D" on a seam, and lifts through a dam.
#include "core/csv.hpp"
#include "program_answer.hpp"
#include "source_dir.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>

namespace {

using namespace damslip;

std::string seam_scene()
{
    const std::string records = std::string(source_dir()) + "/records/data/ec8_3.0";
    return "[section]\nheight_m = 62.5\nbase_m = 45\ncrest_m = 12\nneck_m = 11\n[dam]\ndensity_kg_m3 = 2500\n"
           "[contact]\nfriction = 0.9\n[reservoir]\nlevel_m = 62.5\n[uplift]\nmodel = \"drains\"\n"
           "[drains]\ndistance_m = 6\nefficiency = 0.8\ndepth_m = 12\n"
           "[foundation]\nyoung_modulus_GPa = 20\ndensity_kg_m3 = 2650\n"
           "[lifts]\nspacing_m = 20\nfriction = 0.75\n"
           "[[seam]]\nname = \"clay\"\ndepth_m = 8\nfriction = 0.7\n[seam.wedge]\nfriction_deg = 40\n"
           "[criteria]\nallowable_slip_mm = 100\n"
           "[[motion.record]]\nname = \"ec8\"\nhorizontal = \"" +
           records + "_h.csv\"\nvertical = \"" + records + "_v.csv\"\n";
}

class PlaneScreen : public testing::Test {
protected:
    void SetUp() override
    {
        file = std::filesystem::temp_directory_path() / "damslip_plane_screen.toml";
        std::ofstream(file) << seam_scene();
    }
    void TearDown() override { std::filesystem::remove(file); }

    std::filesystem::path file;
};

TEST_F(PlaneScreen, SaysWhichPlaneGoverns)
{
    const ProgramAnswer answer = answer_of({"screen", file.string(), "--json"});
    ASSERT_EQ(answer.code, 0) << answer.talk;
    const auto j = nlohmann::json::parse(answer.out);
    ASSERT_EQ(j["planes"].size(), 5u); // base, lifts at 20, 40 and 60 m, seam
    EXPECT_EQ(j["planes"][0]["plane"], "base");
    EXPECT_EQ(j["planes"][1]["plane"], "lift at 20 m");
    EXPECT_EQ(j["planes"][4]["plane"], "clay");
    EXPECT_EQ(j["lifts"].size(), 3u);
    EXPECT_EQ(j["blocks"].size(), 2u);
    // Closed forms of a level seam with one smooth wedge, searched.
    EXPECT_NEAR(j["seams"][0]["factor"].get<double>(), 1.235701938, 1e-9);
    EXPECT_NEAR(j["seams"][0]["alpha_deg"].get<double>(), 13.0894, 1e-3);
    EXPECT_NEAR(j["seams"][0]["factor_without_wedge"].get<double>(), 1.187663694, 1e-9);
    EXPECT_EQ(j["verdict"].get<std::string>().rfind("FAIL on ", 0), 0u) << j["verdict"];
    EXPECT_NE(j["headline"].get<std::string>().find("lift at 20 m by slip"), std::string::npos) << j["headline"];
}

/// The sweep slides the same stages by the same function.
TEST_F(PlaneScreen, SweepsThePlane)
{
    const ProgramAnswer screened = answer_of({"screen", file.string(), "--json"});
    const ProgramAnswer swept =
        answer_of({"sweep", file.string(), "--plane", "base,lift at 20 m,clay", "--method", "rigid-v"});
    ASSERT_EQ(swept.code, 0) << swept.talk;
    const CsvTable rows = parse_csv(swept.out.substr(swept.out.find("id,")));
    const auto at = [&](const std::string& key) {
        return std::size_t(std::find(rows.heading.cells.begin(), rows.heading.cells.end(), key) - rows.heading.cells.begin());
    };
    std::map<std::string, double> largest, friction;
    for (const CsvLine& row : rows.rows) {
        if (row.cells.size() < rows.heading.cells.size()) continue;
        double& slip = largest[row.cells[at("plane")]];
        slip = std::max(slip, std::stod(row.cells[at("max_slip_m")]));
        friction[row.cells[at("plane")]] = std::stod(row.cells[at("friction")]);
    }
    ASSERT_EQ(largest.size(), 3u) << swept.out;
    EXPECT_EQ(friction["clay"], 0.7);
    EXPECT_EQ(friction["lift at 20 m"], 0.75);
    for (const auto& plane : nlohmann::json::parse(screened.out)["planes"])
        if (largest.contains(plane["plane"])) EXPECT_EQ(plane["slip_m"].get<double>(), largest[plane["plane"]]) << plane;
    const ProgramAnswer wrong = answer_of({"sweep", file.string(), "--plane", "clai"});
    EXPECT_NE((wrong.talk + wrong.out).find("Did you mean clay?"), std::string::npos) << wrong.talk;
}

} // namespace
