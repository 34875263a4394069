// The tables of a fragility: one list of keys for the reader, the schema and the page, and every command looks them over.
#include "program_answer.hpp"

#include "core/file.hpp"
#include "core/input_error.hpp"
#include "scene/fragility_input.hpp"
#include "scene/keys.hpp"
#include "scene/read.hpp"
#include "scene/scene_text.hpp"
#include "source_dir.hpp"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

namespace {

using namespace damslip;

const std::string block =
    "[section]\nheight_m = 10\nbase_m = 8\n[dam]\ndensity_kg_m3 = 2500\n[contact]\nfriction = 0.5\n"
    "cohesion_kPa = 100\n";

std::vector<std::string> problems_of(const std::string& text)
{
    try {
        parse_scene(text, "dam.toml");
    } catch (const InputError& error) {
        std::vector<std::string> problems;
        for (const Diagnostic& d : error.diagnostics()) problems.push_back(std::to_string(d.line) + ": " + d.problem);
        return problems;
    }
    return {};
}

/// A table with one key, and beside it what the table cannot do without.
std::string with_key(const std::string& table, const std::string& key, const std::string& value)
{
    const bool is_law = table == "probability.variable" && value.starts_with("{");
    const std::string line = key + " = " + value + "\n";
    if (table == "probability.variable")
        return "[[probability.variable]]\n" + std::string(key == "key" ? "" : "key = \"contact.friction\"\n") + line +
               (is_law ? "" : "uniform = { min = 0.4, max = 0.6 }\n");
    if (table == "probability.correlation") {
        const char* const variables = "[[probability.variable]]\nname = \"mu\"\nkey = \"contact.friction\"\n"
                                      "uniform = { min = 0.4, max = 0.6 }\n[[probability.variable]]\nname = \"c\"\n"
                                      "key = \"contact.cohesion_kPa\"\nuniform = { min = 0, max = 200 }\n";
        return variables + std::string("[[probability.correlation]]\n") +
               (key == "between" ? "" : "between = [\"mu\", \"c\"]\n") + (key == "spearman" ? "" : "spearman = 0.1\n") +
               line;
    }
    if (table == "intensity") {
        const bool level = key.starts_with("levels_"), velocity = key == "levels_m_s" || key == "levels_cm_s";
        return "[intensity]\n" + std::string(velocity ? "measure = \"PGV\"\n" : "") + line +
               (level ? "" : "levels_g = [0.1]\n");
    }
    if (table == "limit") {
        const bool factor = key == "below" || value == "\"post-seismic-fs\"";
        return "[[limit]]\n" + line + (key == "below" ? "quantity = \"post-seismic-fs\"\n" : "") +
               (key == "plane" ? "above_mm = 50\n" : "") +
               (key != "quantity" ? ""
                : factor          ? "below = 1.1\n"
                                  : "above_mm = 50\n");
    }
    if (table == "hazard") return "[hazard]\n" + line + (key == "curve" ? "" : "curve = \"h.csv\"\n");
    return "[" + table + "]\n" + line;
}

TEST(FragilityKeys, TheReaderTakesEveryKeyOfTheListWithItsExampleAndItsWords)
{
    int read = 0;
    for (const KeyGroup& table : fragility_key_tables())
        for (const Key& key : table.keys) {
            std::vector<std::string> values{key.example};
            for (const std::string& word : key.value.words) values.push_back("\"" + word + "\"");
            for (const std::string& value : values) {
                const std::vector<std::string> problems = problems_of(block + with_key(table.name, key.name, value));
                EXPECT_TRUE(problems.empty()) << table.name << "." << key.name << " = " << value << ": " << problems[0];
                ++read;
            }
            if (key.value.kind == ValueKind::word) {
                EXPECT_EQ(problems_of(block + with_key(table.name, key.name, "\"no-such-word\"")).size(), 1u)
                    << table.name << "." << key.name;
            }
        }
    EXPECT_GT(read, 50);
}

TEST(FragilityKeys, EveryCommandSaysWhatIsMisspelt)
{
    using Problems = std::vector<std::string>;
    EXPECT_EQ(problems_of(block + "[probability]\nsede = 1\n"),
              Problems{"10: unknown key probability.sede. Did you mean seed?"});
    EXPECT_EQ(problems_of(block + "[suite]\nmax_scale = 0\nallow_scaling = 1\n"),
              (Problems{"10: suite.max_scale is not allowed.", "11: suite.allow_scaling is not allowed."}));
    EXPECT_EQ(problems_of(block + "[hazard]\nall_events = 1\n"), Problems{"9: hazard.curve is missing."});
    EXPECT_EQ(problems_of(block + "[limit]\nabove_mm = 1\n"), Problems{"9: limit is no list of tables."});
    EXPECT_EQ(problems_of(block + "cohesoin_kPa = 1\n[probability]\nseed = -1\n"),
              (Problems{"9: unknown key contact.cohesoin_kPa. Did you mean contact.cohesion_kPa?",
                        "11: probability.seed is not allowed."}));
}

TEST(FragilityKeys, OtherCommandsNeedNoneOfThem)
{
    EXPECT_TRUE(problems_of(block).empty());
    EXPECT_TRUE(problems_of(block + "[probability]\nseed = 7\n").empty())
        << "no levels and limits: fragility asks for them";
}

TEST(FragilityKeys, StandInTheSchemaAndOnThePage)
{
    const auto schema = nlohmann::json::parse(scene_schema())["properties"];
    const std::string page = scene_keys_markdown();
    for (const KeyGroup& table : fragility_key_tables()) {
        const std::size_t dot = table.name.find('.');
        nlohmann::json object = dot == std::string::npos
                                    ? schema[table.name]
                                    : schema[table.name.substr(0, dot)]["properties"][table.name.substr(dot + 1)];
        if (table.presence == Presence::list) object = object["items"];
        EXPECT_NE(page.find(table.name), std::string::npos);
        for (const Key& key : table.keys) {
            EXPECT_TRUE(object["properties"].contains(key.name)) << table.name << "." << key.name;
            EXPECT_NE(page.find("| `" + key.name + "` |"), std::string::npos) << table.name << "." << key.name;
        }
    }
    EXPECT_EQ(schema["probability"]["properties"]["seed"]["type"], "integer");
    EXPECT_EQ(schema["probability"]["properties"]["variable"]["items"]["required"], nlohmann::json({"key"}));
}

/// The example with another hazard curve and levels, in a folder of its own.
class FragilityCommandRefuses : public testing::Test {
protected:
    void SetUp() override { std::filesystem::create_directories(folder_); }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    /// What `damslip fragility` says of it. The talk tells of runs, too: there must be none.
    ProgramAnswer answer(const std::string& curve, const std::string& levels, const std::string& out = "") const
    {
        const std::filesystem::path example = std::filesystem::path(source_dir()) / "examples/fragility";
        std::string scene = read_file(example / "dam.toml");
        const auto put = [&scene](const std::string& old, const std::string& text) {
            for (std::size_t at = scene.find(old); at != std::string::npos; at = scene.find(old, at + text.size()))
                scene.replace(at, old.size(), text);
        };
        put("../../records", std::string(source_dir()) + "/records");
        put("levels_g = [0.05, 0.075, 0.1, 0.125, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4]", "levels_g = " + levels);
        std::ofstream(folder_ / "dam.toml") << scene;
        if (!curve.empty()) std::ofstream(folder_ / "hazard.csv") << curve;
        std::vector<std::string> command{"fragility", (folder_ / "dam.toml").string(), "--samples", "64"};
        if (!out.empty()) command.insert(command.end(), {"--out", out});
        return answer_of(command);
    }
    void expect_refuses(const ProgramAnswer& a, const std::string& problem) const
    {
        EXPECT_EQ(a.code, 3) << a.talk;
        EXPECT_NE(a.talk.find(problem), std::string::npos) << a.talk;
        EXPECT_EQ(a.talk.find("100 %"), std::string::npos) << a.talk;
    }

    const std::string curve_ = "pga_g,annual_rate\n0.02,1e-2\n0.5,1e-5\n";

private:
    std::filesystem::path folder_ =
        std::filesystem::temp_directory_path() / ("damslip fragility " + std::to_string(::getpid()));
};

TEST_F(FragilityCommandRefuses, HazardThatDoesNotFitTheLevelsBeforeAnyRun)
{
    expect_refuses(answer("", "[0.1]"), "hazard.csv: error: there is no such file.");
    expect_refuses(answer("# imt='PGV'\nim,annual_rate\n0.02,1e-2\n0.5,1e-5\n", "[0.1]"),
                   "the hazard curve is of PGV, the levels are of PGA.");
    const std::string apart = "the hazard curve goes from 0.02 to 0.5 g, the levels from ";
    expect_refuses(answer(curve_, "[0.001, 0.01]"), apart + "0.001 to 0.01 g: no rate comes of them.");
    expect_refuses(answer(curve_, "[0.6, 1.2]"), apart + "0.6 to 1.2 g: no rate comes of them.");
    EXPECT_EQ(answer(curve_, "[0.01, 0.1]").code, 0);
}

// A quarter slides more than 50 mm at both levels: the median lies far beyond, and that is said.
TEST_F(FragilityCommandRefuses, NoMedianBeyondTheLevelsWithoutAWord)
{
    const std::string text = answer(curve_, "[0.13, 0.16]").out;
    EXPECT_NE(text.find(", extrapolated from levels of 0.13 to 0.16 g"), std::string::npos) << text;
    EXPECT_NE(text.find("the median is extrapolated from the levels, 0.13 to 0.16 g"), std::string::npos) << text;
    EXPECT_EQ(answer(curve_, "[0.1, 0.12]").code, 0); // the same share at both: no curve
    EXPECT_EQ(answer(curve_, "[0.13, 0.4]").out.find("extrapolated"), std::string::npos);
}

TEST_F(FragilityCommandRefuses, AFolderThatCannotBeMade)
{
    expect_refuses(answer(curve_, "[0.1]", "/proc/nowhere"), "/proc/nowhere");
}

} // namespace
