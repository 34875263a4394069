// Estimates by finite elements, and what their intervals cost, by the program. The dam is stiff and coarse, so that a
// run takes 0.4 ms: 2,048 runs of it in a Latin hypercube say what every estimate has to find. Replicates of 512 runs miss P by 1/512 at most but for
// draws that are not monotone, of which a stiff block has none.
#include "pulse_study.hpp"

#include <nlohmann/json.hpp>

namespace damslip {
namespace {

using Json = nlohmann::json;

class FragilityModels : public pulse::Study {
protected:
    void SetUp() override
    {
        Study::SetUp();
        write_scene({.intensity = "measure = \"PGA\"\nlevels_m_s2 = [4]\n"});
    }

    /// P by finite elements alone.
    double reference() const
    {
        const ProgramAnswer answer =
            fragility({"--method", "fe", "--samples", "2048", "--conditioning", "off", "--json"});
        return Json::parse(answer.out)["probabilities"][0]["probability"];
    }
};

// Every estimator of `accuracy --probability` finds P within three times its half-width, six standard errors, as an interval from
// eight replicates is rough itself. Plain sampling of fewer runs is the first of them, so that its time is less. The sentence names the estimator with the largest gain
// of the longest runs; the page draws it.
TEST_F(FragilityModels, WhatTheIntervalCosts)
{
    const double p = reference();
    const ProgramAnswer answer =
        ask("accuracy", {"--probability", "--method", "fe", "--samples", "256", "--out", out("cost")});
    ASSERT_EQ(answer.code, 0) << answer.talk;
    const Json summary = Json::parse(bytes("cost", "summary.json"));
    EXPECT_EQ(summary["limit"], "slip > 200 mm");
    EXPECT_EQ(summary["level"].get<double>(), 4.0);
    EXPECT_EQ(summary["unit"], "m/s2");
    std::map<std::string, int> points;
    std::string best;
    double gain = 1.0, seconds = 0.0;
    std::string last;
    for (const Json& row : summary["estimates"]) {
        const std::string name = row["estimator"];
        ++points[name];
        ASSERT_FALSE(row["probability"].is_null()) << row;
        EXPECT_NEAR(row["probability"].get<double>(), p, 3.0 * row["half_width"].get<double>()) << name << row["runs"];
        if (name == last && name == "plain") {
            EXPECT_GT(row["seconds"].get<double>(), seconds) << name;
        }
        last = name;
        seconds = row["seconds"];
        if (row["runs"] == 256 && !row["gain"].is_null() && row["gain"].get<double>() > gain) {
            gain = row["gain"];
            best = name;
        }
    }
    for (const char* name : {"plain", "Latin hypercube", "Sobol'"}) EXPECT_EQ(points[name], 3) << name;
    EXPECT_NE(answer.out.find(best.empty() ? "nothing beats plain Monte Carlo here" : best + " does with 1/"),
              std::string::npos)
        << answer.out;
    const std::string page = bytes("cost", "report.html");
    EXPECT_NE(page.find("What the accuracy of a probability costs"), std::string::npos);
    EXPECT_NE(page.find("<svg"), std::string::npos);
    EXPECT_NE(bytes("cost", "accuracy.csv").find("Sobol'"), std::string::npos);
}

// A budget that pays for no estimate: no number, a word on each, exit code of no answer. The same page is asked for alone.
TEST_F(FragilityModels, ABudgetThatPaysForNothingSaysSo)
{
    const std::filesystem::path page = folder / "cost.html";
    const ProgramAnswer answer = ask("accuracy", {"--probability", "--samples", "1048576", "--budget", "0.000001",
                                                  "--json", "--report", page.string()});
    EXPECT_EQ(answer.code, 4) << answer.talk << answer.out;
    for (const Json& row : Json::parse(answer.out)["estimates"]) {
        EXPECT_TRUE(row["probability"].is_null());
        EXPECT_FALSE(row["remark"].is_null());
    }
    EXPECT_NE(read_file(page).find("no estimate within the budget"), std::string::npos);
}

TEST_F(FragilityModels, FlagsOfSlipsAreRefused)
{
    for (const char* flag : {"--quick", "--all-records"}) {
        const ProgramAnswer answer = ask("accuracy", {"--probability", flag});
        EXPECT_EQ(answer.code, 2);
        EXPECT_NE(answer.talk.find(fmt::format("--probability together with {}.", flag)), std::string::npos)
            << answer.talk;
    }
}

// Capacities of incremental analyses: each draw's level where it first slides too far. The slip falls with friction, so that the share of capacities
// up to a level is the P of that level, and none survives above a level that it failed.
TEST_F(FragilityModels, CapacitiesOfIncrementalAnalyses)
{
    write_scene({.intensity = "measure = \"PGA\"\ndesign = \"ida\"\nlevels_m_s2 = [3, 3.5, 4, 4.5, 5]\n"});
    const ProgramAnswer answer = fragility({"--samples", "256", "--conditioning", "off", "--out", out("ida")});
    ASSERT_EQ(answer.code, 0) << answer.talk;
    const Json summary = Json::parse(bytes("ida", "summary.json"));
    const Json& curve = summary["curves"][0];
    // mu*(A) by hand and ln mu ~ N(ln 0.3, 0.2): the median capacity has mu*(A) = 0.3.
    double low = 3.0, high = 5.0;
    for (int i = 0; i < 60; ++i)
        (pulse::friction(pulse::limit, 0.5 * (low + high)) < 0.3 ? low : high) = 0.5 * (low + high);
    EXPECT_NEAR(curve["capacity_median"].get<double>(), low, 0.03 * low); // 256 draws: 0.16 / 16 = 1 % standard error
    EXPECT_EQ(curve["came_back"].get<int>(), 0);
    const double beyond = 1.0 - pulse::probability_by_hand(5.0);
    EXPECT_NEAR(curve["censored"].get<double>() / 256.0, beyond, 4.0 / 64.0); // four replicates of 64
    EXPECT_NE(answer.out.find("capacities are the slip's own roots between two levels"), std::string::npos)
        << answer.out;
}

} // namespace
} // namespace damslip
