// The tables of a fragility: one list of keys for the reader, the schema and the page, and every command looks them over.
#include "core/input_error.hpp"
#include "scene/document.hpp"
#include "scene/fragility_input.hpp"
#include "scene/fragility_keys.hpp"
#include "scene/read.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

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
    const bool is_law = fragility_key_table("probability.variable").keys.size() > 0 &&
                        table == "probability.variable" && value.starts_with("{");
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
    for (const FragilityKeyTable& table : fragility_key_tables())
        for (const FragilityKey& key : table.keys) {
            std::vector<std::string> values{key.example};
            for (const std::string& word : key.words) values.push_back("\"" + word + "\"");
            for (const std::string& value : values) {
                const std::vector<std::string> problems = problems_of(block + with_key(table.name, key.name, value));
                EXPECT_TRUE(problems.empty()) << table.name << "." << key.name << " = " << value << ": " << problems[0];
                ++read;
            }
            if (key.value == FragilityValue::word) {
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
    for (const FragilityKeyTable& table : fragility_key_tables()) {
        const std::size_t dot = table.name.find('.');
        nlohmann::json object = dot == std::string::npos
                                    ? schema[table.name]
                                    : schema[table.name.substr(0, dot)]["properties"][table.name.substr(dot + 1)];
        if (table.presence == Presence::list) object = object["items"];
        EXPECT_NE(page.find(table.name), std::string::npos);
        for (const FragilityKey& key : table.keys) {
            EXPECT_TRUE(object["properties"].contains(key.name)) << table.name << "." << key.name;
            EXPECT_NE(page.find("| `" + key.name + "` |"), std::string::npos) << table.name << "." << key.name;
        }
    }
    EXPECT_EQ(schema["probability"]["properties"]["seed"]["type"], "integer");
    EXPECT_EQ(schema["probability"]["properties"]["variable"]["items"]["required"], nlohmann::json({"key"}));
}

} // namespace
