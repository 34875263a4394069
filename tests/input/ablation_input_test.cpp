// Wrong ways to ask for an ablation, and what their users read.
#include "cli/program.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <unistd.h>

namespace {

using namespace damslip;

struct AblationAnswer {
    int code;
    std::string out, talk;
};

AblationAnswer explained(std::vector<std::string> arguments)
{
    const auto file =
        std::filesystem::temp_directory_path() / ("damslip_ablation_" + std::to_string(::getpid()) + ".toml");
    std::ofstream(file) << "[section]\nheight_m = 10\nbase_m = 8\n[dam]\ndensity_kg_m3 = 2500\nyoung_modulus_GPa = "
                           "25\n[contact]\nfriction = 0.5\n";
    arguments.insert(arguments.begin(), {"explain", file.string()});
    std::ostringstream out, talk;
    const int code = cli::run_program(arguments, out, talk, false);
    std::filesystem::remove(file);
    return {code, out.str(), talk.str()};
}

TEST(AblationInput, FiniteElementsWantARecord)
{
    const AblationAnswer a = explained({"--ablate", "--method", "fe"});
    EXPECT_EQ(a.code, 2);
    EXPECT_NE(a.talk.find("--ablate --method fe without a record."), std::string::npos) << a.talk;
    EXPECT_NE(a.talk.find("add  --record FILE  or a [[motion.record]]"), std::string::npos) << a.talk;
    EXPECT_TRUE(a.out.empty());
}

TEST(AblationInput, RigidBlockWithoutARecordHasYieldAccelerations)
{
    const AblationAnswer a = explained({"--ablate"});
    EXPECT_EQ(a.code, 0) << a.talk;
    EXPECT_NE(a.out.find("Yield acceleration"), std::string::npos);
    EXPECT_NE(a.out.find("no record is given"), std::string::npos);
}

TEST(AblationInput, ReportAndJobsBelongToAblate)
{
    for (const std::vector<std::string>& more :
         {std::vector<std::string>{"--report", "page.html"}, std::vector<std::string>{"--jobs", "2"}}) {
        const AblationAnswer a = explained(more);
        EXPECT_EQ(a.code, 2);
        EXPECT_NE(a.talk.find("requires --ablate"), std::string::npos) << a.talk;
    }
}

TEST(AblationInput, WrongWordsAndNumbers)
{
    EXPECT_EQ(explained({"--ablate", "--method", "regression"}).code, 2);
    EXPECT_EQ(explained({"--ablate", "--jobs", "-1"}).code, 2);
    const AblationAnswer misspelt = explained({"--ablat"});
    EXPECT_EQ(misspelt.code, 2);
    EXPECT_NE(misspelt.talk.find("Did you mean --ablate?"), std::string::npos) << misspelt.talk;
    const AblationAnswer folder = explained({"--ablate", "--report", "/"}); // found before anything is computed
    EXPECT_EQ(folder.code, 2) << folder.talk;
}

} // namespace
