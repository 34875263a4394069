// `screen` with the elastic dam: the slip it judges by, and what it says where that dam cannot be run.
#include "program_answer.hpp"
#include "source_dir.hpp"

#include "core/file.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <fmt/format.h>
#include <unistd.h>

namespace damslip {
namespace {

using nlohmann::json;

class ElasticScreening : public testing::Test {
protected:
    ElasticScreening() { std::filesystem::create_directories(folder); }
    ~ElasticScreening() override { std::filesystem::remove_all(folder); }

    /// The shipped dam, with `more` below it. @param allowable  [mm]
    std::string dam(double allowable, const std::string& more = "") const
    {
        std::string text = read_file(examples / "own_dam.toml");
        const auto replace = [&](const std::string& old, const std::string& by) {
            const std::size_t at = text.find(old);
            ASSERT_NE(at, std::string::npos) << old;
            text.replace(at, old.size(), by);
        };
        replace("allowable_slip_mm = 50", fmt::format("allowable_slip_mm = {:g}", allowable));
        for (const char* component : {"h", "v"})
            replace(fmt::format("../records/data/rock_1.0_{}.csv", component),
                    (examples.parent_path() / fmt::format("records/data/rock_1.0_{}.csv", component)).string());
        write_file(folder / "dam.toml", text + more);
        return (folder / "dam.toml").string();
    }
    static json screened(std::vector<std::string> arguments)
    {
        arguments.insert(arguments.begin(), "screen");
        arguments.push_back("--json");
        return json::parse(answer_of(arguments).out);
    }

    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / fmt::format("damslip_elastic_{}", ::getpid());
    const std::filesystem::path examples = std::filesystem::path(source_dir()) / "examples";
};

/// The slip is that of the reduced run, whose step goes on until it is within a hundredth: both lie within their ±.
TEST_F(ElasticScreening, AgreesWithTheReducedRun)
{
    const std::string scene = dam(50.0);
    const json quick = screened({scene})["elastic"];
    const json fine =
        json::parse(answer_of({"fe", scene, "--reduced", "--no-mesh-error", "--json"}).out)["runs"];
    ASSERT_EQ(quick.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
        const double error = quick[i]["total_error_mm"];
        EXPECT_NEAR(quick[i]["slip_mm"].get<double>(), fine[i]["slip_mm"].get<double>(), error);
        EXPECT_LT(error, 0.15 * quick[i]["slip_mm"].get<double>());
    }
}

/// The rigid block slips 2.9 mm, the elastic dam 27.5 mm: between both the dam fails, and by the block alone it never passes.
TEST_F(ElasticScreening, TheLargerSlipDecides)
{
    EXPECT_EQ(screened({dam(10.0)})["verdict"], "FAIL");
    const json block = screened({dam(10.0), "--rigid-only"});
    EXPECT_EQ(block["verdict"], "Below the allowable as a rigid block; elasticity not checked.");
    EXPECT_FALSE(block.contains("elastic"));
    for (const json& row : block["displacements"]) EXPECT_EQ(row["verdict"], "below");
    EXPECT_EQ(screened({dam(2.0), "--rigid-only"})["verdict"], "FAIL");
    EXPECT_EQ(screened({dam(28.0)})["verdict"].get<std::string>().find("undecided"), 0u); // within ±
}

/// A dam that slides without an earthquake has no elastic answer to wait for. Light, soft water whose waves are a few
/// centimetres long would take minutes to reduce: the reason is given instead.
TEST_F(ElasticScreening, RunsNoDamThatDoesNotStandAndNoWaterThatCannotBeReduced)
{
    const json fallen = screened({dam(10.0), "--friction", "0.5"});
    EXPECT_FALSE(fallen.contains("elastic"));
    EXPECT_EQ(fallen["verdict"], "FAIL");

    std::string text = read_file(dam(10.0));
    const std::string level = "level_m = 60";
    const std::size_t at = text.find(level);
    ASSERT_NE(at, std::string::npos);
    text.insert(at + level.size(), ", model = \"acoustic\", density_kg_m3 = 2000, bulk_modulus_MPa = 0.6");
    text.replace(at, level.size(), "level_m = 20");
    write_file(folder / "dam.toml", text);
    const json wavy = screened({(folder / "dam.toml").string()});
    EXPECT_NE(wavy["elastic_not_run"].get<std::string>().find("snapshots"), std::string::npos) << wavy["elastic_not_run"];
}

TEST_F(ElasticScreening, LeavesTheRigidBlockAsItWas)
{
    EXPECT_EQ(screened({dam(50.0)})["displacements"], screened({dam(50.0), "--rigid-only"})["displacements"]);
}

TEST_F(ElasticScreening, SaysWhatItCannotRun)
{
    const json lifts = screened({dam(50.0, "[[lift_joint]]\nelevation_m = 20\nfriction = 0.8\n")});
    EXPECT_EQ(lifts["elastic"], json::array());
    EXPECT_NE(lifts["elastic_not_run"].get<std::string>().find("[[lift_joint]]"), std::string::npos);
    EXPECT_EQ(lifts["verdict"].get<std::string>().find("PASS"), std::string::npos) << lifts["verdict"];
    std::string text = read_file(dam(50.0));
    const std::string uplift = "uplift     = { model = \"linear\"";
    ASSERT_NE(text.find(uplift), std::string::npos);
    text.insert(text.find(uplift) + uplift.size(), ", opening = \"reynolds\", wet_end = \"with-waves\"");
    write_file(folder / "dam.toml", text);
    const json waves = screened({(folder / "dam.toml").string()});
    EXPECT_NE(waves["elastic_not_run"].get<std::string>().find("with-waves"), std::string::npos) << waves;
}

/// Bars that hold the dam back hold it on few modes, too.
TEST_F(ElasticScreening, HasTheLawsOfTheJoint)
{
    const std::string bars = "[[anchor]]\nname = \"bars\"\ndistance_m = 4\ninclination_deg = 30\nfree_length_m = 10\n"
                             "area_m2_m = 0.004\nyield_strength_MPa = 500\n";
    const json with = screened({dam(50.0, bars)})["elastic"], without = screened({dam(50.0)})["elastic"];
    ASSERT_EQ(with.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i)
        EXPECT_LT(with[i]["slip_mm"].get<double>(), 0.8 * without[i]["slip_mm"].get<double>());
}

} // namespace
} // namespace damslip
