// Wrong command lines of `damslip sweep`, and part files that are none.
#include "cli/program.hpp"

#include "store_changes.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <unistd.h>

namespace damslip::sweep_input {

namespace {

class SweepInput : public testing::Test {
protected:
    void SetUp() override
    {
        folder = std::filesystem::temp_directory_path() / ("damslip_sweep_input_" + std::to_string(::getpid()));
        std::filesystem::create_directories(folder);
        std::ofstream(folder / "pulse.csv") << "time_s,accel_m_s2\n0,0\n1,2\n2,0\n3,0\n";
        std::ofstream(folder / "block.toml")
            << "[section]\nheight_m = 10\nbase_m = 8\n[dam]\ndensity_kg_m3 = 2500\nyoung_modulus_GPa = 25\n"
               "[contact]\nfriction = 0.5\n[reservoir]\nlevel_m = 8\n[uplift]\nmodel = "
               "\"none\"\n[[motion.record]]\nhorizontal = \"pulse.csv\"\n";
    }
    void TearDown() override { std::filesystem::remove_all(folder); }
    std::string path(const std::string& name) const { return (folder / name).string(); }
    std::string content(const std::string& name) const
    {
        std::ifstream in(folder / name);
        return std::string(std::istreambuf_iterator<char>(in), {});
    }
    void write(const std::string& name, const std::string& text) const { std::ofstream(folder / name) << text; }

    void says(const std::vector<std::string>& arguments, int code, const std::string& part) const
    {
        std::ostringstream out, talk;
        std::vector<std::string> all{"sweep"};
        all.insert(all.end(), arguments.begin(), arguments.end());
        EXPECT_EQ(cli::run_program(all, out, talk, false), code) << talk.str();
        EXPECT_NE(talk.str().find(part), std::string::npos) << talk.str();
        if (code != 0 && all.back() != "--json") { // with --json the error is an object there
            EXPECT_TRUE(out.str().empty());
        }
    }
    std::filesystem::path folder;
};

TEST_F(SweepInput, FlagsThatDoNotGoTogether)
{
    const std::string scene = path("block.toml"), out = path("r.csv");
    says({}, 2, "SCENE is missing.");
    says({scene, "--merge", path("parts")}, 3, "there is no such file."); // the scene is for the report
    says({scene, "--resume"}, 2, "--resume without --out.");
    says({scene, "--shard", "0/2"}, 2, "--shard without --out.");
    says({scene, "--plan"}, 2, "--plan without --out.");
    says({scene, "--slurm-array", path("job.sh")}, 2, "--slurm-array without --out.");
    says({scene, "--out", out, "--parts", "3"}, 2, "--parts without --plan or --slurm-array.");
    says({scene, "--out", out, "--plan", "--shard", "0/2"}, 2, "--shard together with --plan or --slurm-array.");
    says({scene, "--out", out, "--shard", "0/2", "--json"}, 2, "--shard with --json.");
    EXPECT_FALSE(std::filesystem::exists(out));
}

TEST_F(SweepInput, PartsAreCountedFromZero)
{
    for (const char* bad : {"2/2", "-1/2", "1", "1/", "/2", "1/0", "1/2/3", "0.5/2", "a/b", "0/9999999999999999999999"})
        says({path("block.toml"), "--out", path("r.csv"), "--shard", bad}, 2,
             std::string("--shard ") + bad + " is not allowed.");
}

TEST_F(SweepInput, AxesAndMethods)
{
    const std::string scene = path("block.toml");
    says({scene, "--size", "0"}, 2, "--size: 0 is not allowed.");
    says({scene, "--size", "1,x"}, 2, "\"x\" is not a number.");
    says({scene, "--friction", "0.5,0.7,0.5"}, 2, "--friction: 0.5 is given twice.");
    says({scene, "--method", "rigid,rigid"}, 2, "--method: rigid is given twice.");
    says({scene, "--method", "fe-exakt"}, 2, "Did you mean fe-exact?");
    says({scene, "--reservoir", "westergard"}, 2, "Did you mean westergaard?");
    says({scene, "--method", "fe-penalty"}, 2, "neither scene nor command line give the stiffness of sticking.");
    says({scene, "--penalty-stiffness", "1e11"}, 2, "fe-penalty is not among the methods.");
    says({scene, "--modes", "8"}, 2, "fe-reduced is not among the methods.");
    says({scene, "--method", "fe-reduced", "--modes", "0"}, 2, "--modes");
    says({scene, "--truncation-error"}, 2, "fe-reduced is not among the methods.");
}

/// The part file 0/2 with `what` replaced, merged with the good part 1/2.
TEST_F(SweepInput, PartFilesThatAreNone)
{
    const std::string scene = path("block.toml"), out = path("r.csv");
    for (const char* shard : {"0/2", "1/2"})
        says({scene, "--friction", "0.5,0.6", "--out", out, "--shard", shard}, 0, "1 rows in");
    const std::string first = path("r.0-of-2.sqlite"), second = path("r.1-of-2.sqlite"), whole = path("whole.csv");
    says({"--merge", first, second, "--out", whole}, 0, "2 rows of 2 parts");
    const std::string table = content("whole.csv");
    const std::string good = content("r.0-of-2.sqlite");
    const auto merged_says = [&](const std::string& change, int code, const std::string& part) {
        sql(first, change);
        says({"--merge", first, second, "--out", whole}, code, part);
        std::ofstream(first, std::ios::binary) << good;
    };
    merged_says("UPDATE rows SET slip_m = slip_m + 1e-9", 3, "1 rows are damaged.");
    merged_says("DELETE FROM rows", 3, "the parts have 1 rows, the sweep 2.");
    merged_says("UPDATE sweep SET done = 0", 3, "this part is not finished.");
    merged_says("UPDATE sweep SET scene = 'other'", 3, "this database is damaged");
    merged_says("PRAGMA user_version = 6", 3, "this is not a database of a sweep");
    for (const char* text : {"", "# a\n# b\n# c\n# d\nid\n"}) {
        write("r.0-of-2.sqlite", text);
        says({"--merge", first, second}, 3, "this is not a database of a sweep");
    }
    write("r.0-of-2.sqlite", good.substr(0, good.size() / 2));
    says({"--merge", first, second}, 3, "this database is damaged");
    std::ofstream(first, std::ios::binary) << content("r.1-of-2.sqlite");
    says({"--merge", first, second}, 3, "part 1/2 is given twice");
    says({scene, "--friction", "0.5,0.7", "--out", path("o.csv"), "--shard", "0/2"}, 0, "1 rows in");
    says({"--merge", path("o.0-of-2.sqlite"), second}, 3, "is not of the same sweep as");
    std::ofstream(first, std::ios::binary) << good;
    says({"--merge", first}, 3, "1 of 2 parts are missing: 1/2.");
    says({"--merge", first, second, "--out", path("r.0-of-2.csv")}, 3, "this part is where the whole would be.");
    says({"--merge", path("nothing.sqlite")}, 3, "there is no such file.");
    std::filesystem::create_directories(path("empty"));
    says({"--merge", path("empty")}, 3, "there is no part of a sweep in this folder.");
    says({"--merge", path("block.toml")}, 3, "this is not a database of a sweep");
    says({"--merge", first, second, "--out", whole}, 0, "2 rows of 2 parts");
    EXPECT_EQ(content("whole.csv"), table);
}

TEST_F(SweepInput, AnUnfinishedSweepIsNotBegunAgain)
{
    const std::string scene = path("block.toml"), out = path("r.csv");
    says({scene, "--friction", "0.5,0.6", "--out", out}, 0, "2 rows in");
    sql(path("r.sqlite"), "UPDATE sweep SET done = 0; UPDATE rows SET slip_m = 1 WHERE id = 1"); // stopped, and damaged
    const std::string table = content("r.csv");
    std::filesystem::remove(out);
    says({scene, "--friction", "0.5,0.6", "--out", out}, 3, "1 rows of this sweep are finished here.");
    says({scene, "--friction", "0.5,0.6", "--out", out, "--resume"}, 0,
         "1 damaged rows of the database are computed again");
    EXPECT_EQ(content("r.csv"), table);
}

} // namespace

} // namespace damslip::sweep_input
