// The command `fragility` on a one-way block under one pulse (pulse_scene.hpp), so that P = F_mu(mu*) by hand: runs that are spread over parts, stopped
// and gone on with, bought by a budget, written for a cluster; and what does not go together.
#include "pulse_study.hpp"
#include "store_changes.hpp"

#include <nlohmann/json.hpp>

#include <map>

namespace damslip {
namespace {

using FragilityCommand = pulse::Study;

const char* const results[] = {"samples.csv", "fragility.csv", "summary.json", "report.html"};

// 1,024 draws in a Latin hypercube: one in each of 1,024 equal parts of F, so that a replicate of 256 misses P by 1/256 at most.
TEST_F(FragilityCommand, ProbabilitiesAreThoseByHand)
{
    const ProgramAnswer answer = fragility({"--samples", "1024", "--conditioning", "off", "--json"});
    ASSERT_EQ(answer.code, 0) << answer.talk;
    const auto found = nlohmann::json::parse(answer.out)["probabilities"];
    ASSERT_EQ(found.size(), 3u);
    for (const auto& row : found) {
        const double p = pulse::probability_by_hand(row["intensity_m_s2"].get<double>());
        EXPECT_NEAR(row["probability"].get<double>(), p, 1.0 / 256.0);
    }
}

// Both by default, also where the scene has a motion.polarity, which is for fe and sweep.
TEST_F(FragilityCommand, TheTableNamesThePolaritiesBehindIt)
{
    for (const auto& [suite, more, words] :
         {std::tuple{"polarity = \"as-recorded\"\n", "", "polarity +1 alone"},
          std::tuple{"polarity = \"reversed\"\n", "", "polarity -1 alone"},
          std::tuple{"max_scale = 4\n", "[motion]\npolarity = 1\n", "both polarities"}}) {
        Tables tables;
        tables.suite = suite;
        tables.more = more;
        write_scene(tables);
        const ProgramAnswer answer = fragility({"--samples", "16", "--conditioning", "off"});
        EXPECT_NE(answer.out.find(std::string("each record with ") + words), std::string::npos)
            << answer.out << answer.talk;
    }
}

TEST_F(FragilityCommand, PartsPutTogetherHaveTheBytesOfOneRun)
{
    const std::vector<std::string> size{"--samples", "64", "--conditioning", "off"};
    const auto sized = [&](std::vector<std::string> more) {
        more.insert(more.end(), size.begin(), size.end());
        return fragility(more);
    };
    ASSERT_EQ(sized({"--out", out("one")}).code, 0);
    std::filesystem::create_directories(folder / "parts");
    ProgramAnswer answer = sized({"--out", out("parts"), "--merge"});
    EXPECT_EQ(answer.code, 3);
    EXPECT_NE(answer.talk.find("there is no part of a fragility here."), std::string::npos) << answer.talk;
    for (const char* part : {"0/3", "1/3"}) {
        answer = sized({"--out", out("parts"), "--shard", part});
        ASSERT_EQ(answer.code, 0) << answer.talk;
        EXPECT_NE(answer.talk.find(fmt::format("part {}: 64 runs; when all parts are there:  --merge", part)),
                  std::string::npos)
            << answer.talk;
    }
    answer = sized({"--out", out("parts"), "--merge"});
    EXPECT_EQ(answer.code, 3);
    EXPECT_NE(answer.talk.find("this part is missing."), std::string::npos) << answer.talk;
    EXPECT_NE(answer.talk.find("run  --shard 2/3"), std::string::npos) << answer.talk;

    // The third part loses rows, as where the machine fails.
    ASSERT_EQ(sized({"--out", out("parts"), "--shard", "2/3"}).code, 0);
    leave_unfinished(folder / "parts" / "samples.2-of-3.sqlite", 2);
    answer = sized({"--out", out("parts"), "--merge"});
    EXPECT_EQ(answer.code, 3);
    EXPECT_NE(answer.talk.find("of 192 runs are finished."), std::string::npos) << answer.talk;
    EXPECT_NE(answer.talk.find("run the parts again with --resume"), std::string::npos) << answer.talk;

    answer = sized({"--out", out("parts"), "--shard", "2/3", "--resume"});
    ASSERT_EQ(answer.code, 0) << answer.talk;
    EXPECT_NE(answer.talk.find("runs were finished before"), std::string::npos) << answer.talk;
    answer = sized({"--out", out("parts"), "--merge"});
    ASSERT_EQ(answer.code, 0) << answer.talk;
    for (const char* file : results) EXPECT_EQ(bytes("parts", file), bytes("one", file)) << file;
}

TEST_F(FragilityCommand, GoingOnGivesTheBytesOfOneRunAndOtherRunsAreRefused)
{
    ASSERT_EQ(fragility({"--samples", "64", "--conditioning", "off", "--out", out("one")}).code, 0);
    std::map<std::string, std::string> before;
    for (const char* file : results) before[file] = bytes("one", file);
    leave_unfinished(folder / "one" / "samples.sqlite", 3);
    ProgramAnswer answer = fragility({"--samples", "64", "--conditioning", "off", "--out", out("one"), "--resume"});
    ASSERT_EQ(answer.code, 0) << answer.talk;
    for (const char* file : results) EXPECT_EQ(bytes("one", file), before[file]) << file;
    answer = fragility({"--samples", "32", "--conditioning", "off", "--out", out("one"), "--resume"});
    EXPECT_EQ(answer.code, 3) << answer.talk;
    for (const char* file : results) EXPECT_EQ(bytes("one", file), before[file]) << file << " lost by a refused run";
}

// The number that the pilot names gives the same answer without a pilot, whose draws are none of the run's.
TEST_F(FragilityCommand, ABudgetNamesTheRunsThatRepeatIt)
{
    const ProgramAnswer bought = fragility({"--method", "fe", "--budget", "1", "--conditioning", "off", "--json"});
    ASSERT_NE(bought.code, 3) << bought.talk;
    const std::size_t at = bought.talk.find("--samples ");
    ASSERT_NE(at, std::string::npos) << bought.talk;
    EXPECT_NE(bought.talk.find("pilot: 6 runs, "), std::string::npos) << bought.talk; // two a level
    const std::string samples = bought.talk.substr(at + 10, bought.talk.find('\n', at) - at - 10);
    const ProgramAnswer repeated =
        fragility({"--method", "fe", "--samples", samples, "--conditioning", "off", "--json"});
    EXPECT_EQ(repeated.code, bought.code);
    EXPECT_EQ(nlohmann::json::parse(repeated.out)["probabilities"], nlohmann::json::parse(bought.out)["probabilities"]);
}

TEST_F(FragilityCommand, TheClustersScriptRunsWhatTheCommandWould)
{
    const std::filesystem::path script = folder / "parts.sh";
    const ProgramAnswer answer =
        fragility({"--method", "fe", "--samples", "96", "--aim-at", "0.01", "--conditioning", "on", "--allow-scaling",
                   "--out", out("parts"), "--parts", "5", "--slurm-array", script.string()});
    ASSERT_EQ(answer.code, 0) << answer.talk;
    const std::string line =
        fmt::format("damslip fragility '{}' --method fe --samples 96 --aim-at 0.01 --conditioning on "
                    "--share-rows 0 --allow-scaling --out '{}'",
                    scene.string(), out("parts"));
    EXPECT_NE(answer.talk.find("5 parts; afterwards:  " + line + " --merge"), std::string::npos) << answer.talk;
    const std::string text = read_file(script);
    EXPECT_NE(text.find("#SBATCH --array=0-4\n"), std::string::npos) << text;
    EXPECT_NE(text.find("exec " + line + " --jobs"), std::string::npos) << text;
    EXPECT_NE(text.find("--shard \"$SLURM_ARRAY_TASK_ID/5\"\n"), std::string::npos) << text;
    EXPECT_FALSE(std::filesystem::exists(folder / "parts")); // nothing was run
}

TEST_F(FragilityCommand, WhatDoesNotGoTogetherIsRefusedBeforeItRuns)
{
    struct Refused {
        std::vector<std::string> flags;
        std::string problem, fix;
    };
    const std::string to = out("refused");
    for (const Refused& r :
         {Refused{{"--resume"}, "--resume without --out.", "add  --out results/fragility"},
          {{"--merge"}, "--merge without --out.", "add  --out results/fragility"},
          {{"--out", to, "--merge", "--shard", "0/2"}, "--merge together with --shard.", "leave one out"},
          {{"--budget", "5", "--samples", "8"}, "--budget together with --samples.", "leave one out"},
          {{"--out", to, "--budget", "5", "--resume"},
           "--budget together with --resume.",
           "write the  --samples  that the run with --budget prints"},
          {{"--method", "jibson2007"}, "--method jibson2007 is not one of a fragility.", "--method rigid-v"}}) {
        const ProgramAnswer answer = fragility(r.flags);
        EXPECT_EQ(answer.code, 2) << r.problem << answer.talk;
        EXPECT_NE(answer.talk.find(r.problem), std::string::npos) << answer.talk;
        EXPECT_NE(answer.talk.find(r.fix), std::string::npos) << answer.talk;
        EXPECT_EQ(answer.out, "") << r.problem;
    }
    EXPECT_FALSE(std::filesystem::exists(to));
}

} // namespace
} // namespace damslip
