#include "cli/command.hpp"
#include "core/input_error.hpp"
#include "scene/scene_text.hpp"
#include "sweep_scene.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace damslip::sweep_tests {

namespace {

using Json = nlohmann::json;

class WorkerTest : public SweepScene {
protected:
    /// One worker over block.toml; its lines.
    std::vector<Json> talk_to(const std::vector<std::string>& questions, const std::string& record = "pulse") const
    {
        std::stringstream in, out, talk;
        for (const std::string& q : questions) in << q << "\n";
        cli::WorkerArguments arguments;
        arguments.scene = path("block.toml");
        arguments.record = record;
        const cli::Streams streams{out, talk};
        EXPECT_EQ(cli::worker(arguments, streams, in), 0);
        std::vector<Json> lines;
        for (std::string line; std::getline(out, line);) lines.push_back(Json::parse(line));
        EXPECT_EQ(lines.size(), questions.size() + 1);
        return lines;
    }

    double swept_slip(const std::vector<std::string>& more) const
    {
        const Answer answer = sweep(with({"--json", "--polarity", "1"}, more));
        const Json j = Json::parse(answer.out);
        for (const Json& row : j["rows"])
            if (row["record"] == "pulse") return row["slip_m"];
        ADD_FAILURE() << answer.out.substr(0, 500) << answer.talk;
        return -1.0;
    }

    Answer with_dakota(const std::string& parameters) const
    {
        write("params.in", parameters);
        return answer_of(
            {"worker", path("block.toml"), "--record", "pulse", "--dakota", path("params.in"), path("results.out")});
    }
};

TEST_F(WorkerTest, NamesItsKeysFirst)
{
    const Json hello = talk_to({}).front();
    EXPECT_TRUE(hello["ready"].get<std::string>().starts_with("damslip "));
    EXPECT_EQ(hello["records"], (std::vector<std::string>{"pulse", "late"}));
    const auto keys = hello["keys"].get<std::vector<std::string>>();
    for (const char* key : {"contact.friction", "reservoir.level_m", "uplift.model", "motion.scale", "time.substeps",
                            "motion.record[1].scale"})
        EXPECT_NE(std::find(keys.begin(), keys.end(), key), keys.end()) << key;
    EXPECT_EQ(std::find(keys.begin(), keys.end(), "drains.efficiency"), keys.end()) << "the scene has no [drains]";
}

TEST_F(WorkerTest, GivesTheBitsOfASweep)
{
    const auto lines =
        talk_to({R"({"id": 1, "set": {"contact.friction": 0.12}})", R"({"id": 2, "set": {"motion.scale": 1.5}})",
                 R"({"id": 3, "set": {"contact.friction": 0.12}, "method": "fe"})",
                 R"({"id": 4, "set": {"reservoir.level_m": 0.5, "contact.friction": 0.15}})"});
    EXPECT_EQ(lines[1]["slip_mm"], swept_slip({"--friction", "0.12"}) * 1e3);
    EXPECT_EQ(lines[2]["slip_mm"], swept_slip({"--scale", "1.5"}) * 1e3);
    EXPECT_EQ(lines[3]["slip_mm"], swept_slip({"--friction", "0.12", "--method", "fe"}) * 1e3);
    EXPECT_EQ(lines[3]["method"], "fe");
    EXPECT_EQ(lines[4]["slip_mm"], swept_slip({"--friction", "0.15", "--level", "0.5"}) * 1e3);
    EXPECT_GT(lines[1]["slip_mm"], 0.0);
    EXPECT_GT(lines[2]["slip_mm"], lines[1]["slip_mm"]);
    for (int id = 1; id <= 4; ++id) EXPECT_EQ(lines[static_cast<std::size_t>(id)]["id"], id);
}

TEST_F(WorkerTest, OutlivesWhateverIsWrongWithALine)
{
    const auto lines = talk_to({R"({"id": "a", "set": {"contact.frction": 0.12}})", "not JSON", "[1]",
                                R"({"set": {"contact.friction": -1}})", R"({"set": {"contact.friction": "rough"}})",
                                R"({"method": "fee"})", R"({"record": "none such"})", R"({"friction": 0.1})",
                                R"({"set": {"drains.efficiency": 0.5}})", R"({"method": "fe-penalty"})",
                                R"({"id": 9, "set": {"contact.friction": 0.12}})"});
    EXPECT_EQ(lines[1]["id"], "a");
    EXPECT_NE(lines[1]["error"][0]["message"].get<std::string>().find("Did you mean contact.friction?"),
              std::string::npos);
    for (std::size_t i = 1; i <= 10; ++i) {
        EXPECT_TRUE(lines[i].contains("error")) << lines[i];
        EXPECT_FALSE(lines[i].contains("slip_mm")) << lines[i];
    }
    EXPECT_EQ(lines[11]["id"], 9);
    EXPECT_EQ(lines[11]["status"], "at rest");
}

TEST_F(WorkerTest, GivesNoSlipOfADamThatDoesNotStand)
{
    const Json answer = talk_to({R"({"set": {"contact.friction": 0.001}})"})[1];
    EXPECT_TRUE(answer["slip_mm"].is_null());
    EXPECT_EQ(answer["status"], "static failure");
    EXPECT_GT(answer["critical_friction"], 0.001);
}

TEST_F(WorkerTest, SetsAnotherUnitInPlaceOfTheFiles)
{
    const SceneText text = SceneText::read(path("block.toml"));
    const std::vector<KeyChange> in_feet{
        {"reservoir.level_ft", 1.0}, {"time.substeps", 3.0}, {"motion.record[2].scale", 2.0}};
    const Scene scene = text.with(in_feet);
    EXPECT_DOUBLE_EQ(scene.reservoir->level, 0.3048);
    EXPECT_EQ(scene.time.substeps, 3);
    EXPECT_EQ(scene.motion.records[1].scale, 2.0);
    EXPECT_EQ(scene.motion.records[0].scale, 1.0);
    EXPECT_EQ(text.scene().reservoir->level, 1.0) << "the text itself stays";
    EXPECT_EQ(text.canonical("reservoir.level_ft"), "reservoir.level_m");
    EXPECT_THROW(text.with(std::vector<KeyChange>{{"time.substeps", 2.5}}), InputError);
    EXPECT_THROW(text.with(std::vector<KeyChange>{{"reservoir.level_m", 1.0}, {"reservoir.level_ft", 3.0}}),
                 InputError);
    EXPECT_THROW(text.with(std::vector<KeyChange>{{"motion.record[3].scale", 2.0}}), InputError);
}

TEST_F(WorkerTest, AnswersDakota)
{
    const double slip = talk_to({R"({"set": {"contact.friction": 0.12}})"})[1]["slip_mm"];
    const auto first_number = [&] { return std::stod(content("results.out")); };
    EXPECT_EQ(with_dakota("  1 variables\n  1.2e-01 contact.friction\n  2 functions\n  1 ASV_1:slip_mm\n  0 "
                          "ASV_2:max_slip_mm\n  1 derivative_variables\n  1 DVV_1:contact.friction\n  0 "
                          "analysis_components\n")
                  .code,
              0);
    EXPECT_EQ(first_number(), slip);
    EXPECT_EQ(content("results.out").find("max_slip_mm"), std::string::npos) << "not asked for";
    EXPECT_EQ(
        with_dakota("{ DAKOTA_VARS = 1 }\n{ contact.friction = 1.2e-01 }\n{ DAKOTA_FNS = 1 }\n{ ASV_1:slip_mm = 1 "
                    "}\n")
            .code,
        0);
    EXPECT_EQ(first_number(), slip);
    with_dakota("1 variables\n 0.001 contact.friction\n1 functions\n1 ASV_1:slip_mm\n");
    EXPECT_TRUE(content("results.out").starts_with("FAIL\n")) << "the dam does not stand";
}

TEST_F(WorkerTest, RefusesWhatDakotaCannotHave)
{
    const Answer gradient = with_dakota("1 variables\n 0.12 contact.friction\n1 functions\n2 ASV_1:slip_mm\n");
    EXPECT_EQ(gradient.code, 3);
    EXPECT_NE(gradient.talk.find("params.in:4: error: 2 ASV_1:slip_mm asks for gradients."), std::string::npos)
        << gradient.talk;
    EXPECT_EQ(with_dakota("1 variables\n 0.12 contact.friction\n").code, 3) << "cut short";
    EXPECT_EQ(with_dakota("1 variables\n 0.12 contact.friction\n1 functions\n1 ASV_1:slipp\n").code, 2);
    EXPECT_EQ(with_dakota("").code, 3);
    EXPECT_FALSE(std::filesystem::exists(path("results.out")));
}

TEST_F(WorkerTest, AnswersQuofem)
{
    write("params.in", "2\ncontact.friction 0.12\nmotion.scale 1.5\n");
    const std::vector<std::string> command{"worker",   path("block.toml"), "--record",         "pulse",
                                           "--quofem", path("params.in"),  path("results.out")};
    EXPECT_EQ(answer_of(command).code, 0);
    const double slip = talk_to({R"({"set": {"contact.friction": 0.12, "motion.scale": 1.5}})"})[1]["slip_mm"];
    EXPECT_EQ(std::stod(content("results.out")), slip);
    std::filesystem::remove(path("results.out"));
    write("params.in", "1\ncontact.friction 0.001\n");
    EXPECT_EQ(answer_of(command).code, 4) << "a dam that does not stand has no slip, and quoFEM no word for it";
    EXPECT_FALSE(std::filesystem::exists(path("results.out")));
    write("params.in", "2\ncontact.friction 0.12\n");
    EXPECT_EQ(answer_of(command).code, 3);
}

} // namespace
} // namespace damslip::sweep_tests
