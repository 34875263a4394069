// Records of which one file holds several: motion.record.column and vertical_column, --column and --vertical-column.
#include "cli/program.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <unistd.h>

namespace {

using namespace damslip;

/// A dry block on friction 0.1, and the same pulse alone and beside others.
class RecordColumn : public testing::Test {
protected:
    void SetUp() override
    {
        folder = std::filesystem::temp_directory_path() / ("damslip_column_" + std::to_string(::getpid()));
        std::filesystem::create_directories(folder);
        std::ofstream(folder / "alone.csv") << "time_s,accel_m_s2\n0,0\n1,2\n2,0\n3,0\n";
        std::ofstream(folder / "up.csv") << "time_s,accel_m_s2\n0,0\n1,-1\n2,0\n3,0\n";
        std::ofstream(folder / "all.csv") << "time_s,ew_m_s2,ns_m_s2,up_m_s2\n0,0,0,0\n1,9,2,-1\n2,0,0,0\n3,0,0,0\n";
    }
    void TearDown() override { std::filesystem::remove_all(folder); }

    std::string scene(const std::string& record) const
    {
        const std::string file = (folder / "block.toml").string();
        std::ofstream(file) << "[section]\nheight_m = 10\nbase_m = 8\n[dam]\ndensity_kg_m3 = 2500\n[contact]\nfriction "
                               "= 0.1\n[[motion.record]]\nname = \"it\"\n"
                            << record;
        return file;
    }
    /// Displacements of `damslip screen`, or what it says instead.
    std::string displacements(const std::string& record, const std::vector<std::string>& more = {}) const
    {
        std::vector<std::string> arguments{"screen", scene(record), "--json", "--quiet"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        std::ostringstream out, talk;
        if (cli::run_program(arguments, out, talk, false) != 0) return talk.str();
        return nlohmann::json::parse(out.str())["displacements"].dump();
    }
    std::filesystem::path folder;
};

TEST_F(RecordColumn, IsChosenInTheScene)
{
    const std::string alone = displacements("horizontal = \"alone.csv\"\n");
    ASSERT_NE(alone.find("slip_h_mm"), std::string::npos) << alone;
    for (const char* column : {"ns_m_s2", "ns", "3"}) // heading, its name without the unit, number from 1
        EXPECT_EQ(displacements(std::string("horizontal = \"all.csv\"\ncolumn = \"") + column + "\"\n"), alone);
    EXPECT_NE(displacements("horizontal = \"all.csv\"\ncolumn = \"ew\"\n"), alone);
}

TEST_F(RecordColumn, BothComponentsFromOneFile)
{
    const std::string alone = displacements("horizontal = \"alone.csv\"\nvertical = \"up.csv\"\n");
    EXPECT_NE(alone, displacements("horizontal = \"alone.csv\"\n"));
    EXPECT_EQ(
        displacements("horizontal = \"all.csv\"\ncolumn = \"ns\"\nvertical = \"all.csv\"\nvertical_column = \"up\"\n"),
        alone);
    // A column is that of its own file: the other file has one only, and needs none.
    EXPECT_EQ(displacements("horizontal = \"all.csv\"\ncolumn = \"ns\"\nvertical = \"up.csv\"\n"), alone);
}

TEST_F(RecordColumn, IsChosenOnTheCommandLine)
{
    const std::string alone = displacements("horizontal = \"alone.csv\"\nvertical = \"up.csv\"\n");
    const std::string both = "horizontal = \"all.csv\"\nvertical = \"all.csv\"\n";
    EXPECT_EQ(displacements(both, {"--column", "ns", "--vertical-column", "up"}), alone);
    // the scene's choice stands
    EXPECT_EQ(displacements(both + "column = \"ns\"\n", {"--column", "ew", "--vertical-column", "4"}), alone);
}

TEST_F(RecordColumn, OfSeveralNoneIsGuessed)
{
    const std::string said = displacements("horizontal = \"all.csv\"\n");
    EXPECT_NE(said.find("the file holds 3 accelerograms: ew_m_s2, ns_m_s2, up_m_s2."), std::string::npos) << said;
    EXPECT_NE(said.find("motion.record.column"), std::string::npos) << said;
}

TEST_F(RecordColumn, OneThatIsNotThere)
{
    const std::string said = displacements("horizontal = \"all.csv\"\ncolumn = \"north\"\n");
    EXPECT_NE(said.find("there is no column 'north'."), std::string::npos) << said;
    EXPECT_NE(said.find("2 'ew_m_s2', 3 'ns_m_s2'"), std::string::npos) << said;
}

TEST_F(RecordColumn, OfAVerticalFileThatIsNotNamed)
{
    const std::string said = displacements("horizontal = \"all.csv\"\ncolumn = \"ns\"\nvertical_column = \"up\"\n");
    EXPECT_NE(said.find("motion.record[1].vertical_column = \"up\", but no vertical file is named."), std::string::npos)
        << said;
    EXPECT_NE(said.find("write  vertical = \"all.csv\""), std::string::npos) << said;
}

} // namespace
