// `assess` from scene to page on a small dam under one pulse: every finite-element number in it is that of `fe` on the scene so changed, to the last
// digit, and its words name the numbers that its tables hold.
#include "program_answer.hpp"
#include "pulse_scene.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>

namespace damslip {
namespace {

using Json = nlohmann::json;

class AssessRun : public testing::Test {
protected:
    void SetUp() override
    {
        std::filesystem::create_directories(folder);
        write_file(folder / "pulse.csv", pulse::record_text());
    }
    void TearDown() override { std::filesystem::remove_all(folder); }

    std::string scene(const std::string& uplift = "linear", const std::string& reservoir = "",
                      double friction = 0.7) const
    {
        const std::filesystem::path file = folder / "dam.toml";
        write_file(file,
                   fmt::format("title = \"small dam\"\n[section]\nheight_m = 20\nbase_m = 16\ncrest_m = 3\n[dam]\n"
                               "density_kg_m3 = 2400\nyoung_modulus_GPa = 25\npoisson_ratio = 0.2\n[foundation]\n"
                               "young_modulus_GPa = 25\npoisson_ratio = 0.2\nwidth_m = 80\ndepth_m = 32\n[reservoir]\n"
                               "level_m = 16\ndensity_kg_m3 = 1000\nbulk_modulus_MPa = 2200\nlength_m = 40\n{}"
                               "[uplift]\nmodel = \"{}\"\n[contact]\nfriction = {}\n[mesh]\nsize_m = 4\n"
                               "contact_size_m = 4\nrock_size_m = 8\n[time]\ndt_s = 0.01\n[[motion.record]]\n"
                               "name = \"pulse\"\nhorizontal = \"pulse.csv\"\nunit = \"m/s2\"\n"
                               "[criteria]\nallowable_slip_mm = 800\n",
                               reservoir, uplift, friction));
        return file.string();
    }

    /// Slip of the worse polarity [mm].
    double slip_by_fe(const std::string& of, const std::vector<std::string>& more = {}) const
    {
        std::vector<std::string> line{"fe", of, "--json", "--quiet"};
        line.insert(line.end(), more.begin(), more.end());
        const Json answer = Json::parse(answer_of(line).out);
        double slip = 0.0;
        for (const Json& run : answer["runs"]) slip = std::max(slip, std::abs(run["slip_mm"].get<double>()));
        return slip;
    }

    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / fmt::format("damslip assess run {}", ::getpid());
};

double slip_of(const Json& list, const std::string& assumption)
{
    for (const Json& row : list)
        if (row["assumption"] == assumption) return row["slip_mm"];
    ADD_FAILURE() << assumption << " was not run";
    return 0.0;
}

TEST_F(AssessRun, EveryAssumptionIsARunOfTheSceneSoChanged)
{
    const std::string out = (folder / "out").string();
    const ProgramAnswer answer = answer_of({"assess", scene(), "--budget", "100", "--out", out, "--quiet"});
    ASSERT_EQ(answer.code, 0) << answer.talk;
    const Json all = Json::parse(read_file(folder / "out" / "assess.json"));
    const double slip = all["recommended"]["slip_mm"];
    EXPECT_EQ(slip, slip_by_fe(scene()));
    EXPECT_EQ(slip_of(all["assumptions"], "without uplift"), slip_by_fe(scene("none")));
    EXPECT_EQ(slip_of(all["assumptions"], "massless rock"), slip_by_fe(scene(), {"--rock", "massless"}));
    EXPECT_EQ(slip_of(all["assumptions"], "added mass"), slip_by_fe(scene("linear", "model = \"added-mass\"\n")));
    double most = 0.0;
    std::string name;
    for (const Json& row : all["assumptions"]) {
        EXPECT_NEAR(row["change_mm"].get<double>(), row["slip_mm"].get<double>() - slip, 1e-9) << row;
        if (std::abs(row["change_mm"].get<double>()) > std::abs(most))
            most = row["change_mm"], name = row["assumption"];
    }
    EXPECT_NE(answer.out.find(fmt::format("{} moves the answer most: {:.4g} mm in place of {:.4g} mm ({:+.0f} %).",
                                          name, slip + most, slip, 100.0 * most / slip)),
              std::string::npos)
        << answer.out;
    EXPECT_EQ(all["verdict"], "PASS"); // 726 mm of 800, massless rock apart
    const Json& spectrum = all["response_spectrum"];
    EXPECT_FALSE(spectrum.empty());
    const std::string page = read_file(folder / "out" / "report.html");
    EXPECT_NE(page.find("Change of the slip with each assumption changed"), std::string::npos);
    EXPECT_NE(page.find("PASS"), std::string::npos);
}

// The plan names what will run and in which order, without a slip; the report of the run repeats it with what came out.
TEST_F(AssessRun, ThePlanIsWhatRuns)
{
    const std::string out = (folder / "out").string();
    const ProgramAnswer planned = answer_of({"assess", scene(), "--budget", "100", "--plan", "--json", "--quiet", "--out", out});
    ASSERT_EQ(planned.code, 0) << planned.talk;
    const Json plan = Json::parse(planned.out);
    EXPECT_EQ(Json::parse(read_file(folder / "out" / "plan.json")), plan);
    std::vector<std::string> order;
    std::map<std::string, int> motions;
    double seconds = 0.0;
    for (const Json& row : plan["models"]) {
        order.push_back(row["model"]);
        motions[row["model"]] = row["motions"];
        EXPECT_EQ(row["fits"], "yes") << row;
        EXPECT_GT(row["estimated_s"].get<double>(), 0.0) << row;
        seconds += row["estimated_s"].get<double>();
    }
    EXPECT_EQ(order, (std::vector<std::string>{"limit equilibrium, regressions, rigid block", "flexible block", "finite elements",
                                               "response spectrum", "rigid block without each effect",
                                               "finite elements, one assumption changed"}));
    EXPECT_NEAR(plan["seconds"].get<double>(), seconds, 1e-9 * seconds);
    EXPECT_EQ(plan["judged"][0]["required"], "≤ 800 mm");
    EXPECT_EQ(planned.out.find("slip_mm"), std::string::npos);
    bool friction = false;
    for (const Json& row : plan["values"]) friction = friction || (row["key"] == "contact.friction" && row["value"] == "0.7");
    EXPECT_TRUE(friction) << plan["values"];

    const ProgramAnswer run = answer_of({"assess", scene(), "--budget", "100", "--json", "--quiet", "--out", out});
    const Json all = Json::parse(run.out);
    EXPECT_EQ(motions["finite elements"], 2);
    EXPECT_EQ(static_cast<std::size_t>(motions["finite elements, one assumption changed"]), all["assumptions"].size());
    const std::string page = read_file(folder / "out" / "report.html");
    EXPECT_NE(page.find("Work plan, and what came of it"), std::string::npos);
    EXPECT_NE(page.find(fmt::format("{:.4g} mm", all["recommended"]["slip_mm"].get<double>())), std::string::npos);
    EXPECT_NE(read_file(folder / "out" / "plan.html").find("What is judged by what"), std::string::npos);
}

TEST_F(AssessRun, APlanSaysWhatTheBudgetDoesNotHold)
{
    const ProgramAnswer planned = answer_of({"assess", scene(), "--budget", "0.001", "--plan", "--json", "--quiet"});
    const Json plan = Json::parse(planned.out);
    EXPECT_EQ(plan["models"].back()["fits"], "not whole");
    EXPECT_NE(answer_of({"assess", scene(), "--budget", "0.001", "--plan", "--full"}).out.find("raise --budget"), std::string::npos);
}

// What cannot be estimated is no part of the price, and that is printed.
TEST_F(AssessRun, ThePlanOfADamThatDoesNotStandSaysWhatIsNotEstimated)
{
    const Json plan = Json::parse(answer_of({"assess", scene("linear", "", 0.05), "--plan", "--json", "--quiet"}).out);
    for (const Json& row : plan["models"])
        EXPECT_EQ(row["fits"] == "not known", row["estimated_s"].is_null() && row["fits"] != "cannot run") << row;
    const bool unknown = std::any_of(plan["models"].begin(), plan["models"].end(), [](const Json& row) { return row["fits"] == "not known"; });
    EXPECT_EQ(answer_of({"assess", scene("linear", "", 0.05), "--plan", "--full"}).out.find("Not estimated") != std::string::npos, unknown);
    EXPECT_TRUE(unknown);
}

// The block does not hold without an earthquake: no level has a slip, which is no pass.
TEST_F(AssessRun, ADamThatDoesNotStandHasNoSlipAndFails)
{
    const ProgramAnswer answer =
        answer_of({"assess", scene("linear", "", 0.3), "--budget", "100", "--json", "--quiet"});
    const Json all = Json::parse(answer.out);
    EXPECT_TRUE(all["recommended"].is_null());
    EXPECT_EQ(all["verdict"], "FAIL");
    EXPECT_EQ(answer.code, 0); // that it does not stand is an answer
    EXPECT_NE(all["verdict_reason"].get<std::string>().find("does not stand without any earthquake: friction 0.3"),
              std::string::npos)
        << all["verdict_reason"];
}

// What the budget does not hold is named, and nothing of it is given.
TEST_F(AssessRun, ABudgetOfNothingNamesWhatItLeavesOut)
{
    const ProgramAnswer answer = answer_of({"assess", scene(), "--budget", "0.001", "--json", "--quiet"});
    const Json all = Json::parse(answer.out);
    for (const Json& row : all["levels"]) EXPECT_NE(row["level"], "finite elements");
    EXPECT_NE(all["verdict"], "PASS");
    EXPECT_NE(all["notes"].dump().find("finite elements"), std::string::npos) << all["notes"];
}

} // namespace
} // namespace damslip
