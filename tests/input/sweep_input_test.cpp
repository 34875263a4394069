// Wrong command lines of `damslip sweep`, and part files that are none.
#include "cli/program.hpp"

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
    const std::string good = content("r.0-of-2.csv");
    const auto merged_says = [&](const std::string& text, int code, const std::string& part) {
        write("r.0-of-2.csv", text);
        says({"--merge", path("r.0-of-2.csv"), path("r.1-of-2.csv")}, code, part);
    };
    merged_says(good, 0, "2 rows of 2 parts");
    merged_says("", 3, "this is not a part of a sweep.");
    merged_says("# a\n# b\n# c\n# d\nid\n", 3, "this is not a part of a sweep.");
    std::string changed = good;
    changed[changed.size() - 3] = 'x';
    merged_says(changed, 3, "the checksum differs.");
    merged_says(good.substr(0, good.size() - 5), 3, "the checksum differs.");
    merged_says(content("r.1-of-2.csv"), 3, "part 1/2 is given twice");
    std::string foreign = good;
    foreign.replace(foreign.find("# scene ") + 8, 4, "0000");
    merged_says(foreign, 3, "is not of the same sweep as");
    write("r.0-of-2.csv", good);
    says({"--merge", path("r.0-of-2.csv")}, 3, "1 of 2 parts are missing: 1/2.");
    says({"--merge", path("nothing.csv")}, 3, "there is no such file.");
    std::filesystem::create_directories(path("empty"));
    says({"--merge", path("empty")}, 3, "there is no part of a sweep in this folder.");
    ASSERT_EQ(0, std::system(("cp " + path("block.toml") + " " + path("whole.csv")).c_str()));
    says({"--merge", path("whole.csv")}, 3, "this is not a part of a sweep.");
}

TEST_F(SweepInput, AnUnfinishedSweepIsNotBegunAgain)
{
    const std::string scene = path("block.toml"), out = path("r.csv");
    says({scene, "--friction", "0.5,0.6", "--out", out}, 0, "2 rows in");
    std::string journal = content("r.csv.journal");
    journal.resize(journal.find("done\n")); // as if it had been stopped before the table
    journal.resize(journal.size() - 3);     // within a line
    write("r.csv.journal", journal);
    const std::string table = content("r.csv");
    std::filesystem::remove(out);
    says({scene, "--friction", "0.5,0.6", "--out", out}, 3, "1 rows of this sweep are finished here.");
    says({scene, "--friction", "0.5,0.6", "--out", out, "--resume"}, 0, "1 torn line of the journal left aside");
    EXPECT_EQ(content("r.csv"), table);
}

} // namespace

} // namespace damslip::sweep_input
