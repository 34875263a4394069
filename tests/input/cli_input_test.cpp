// Wrong command lines and the exact words their users read.
#include "cli/input/make_axes.hpp"
#include "cli/program.hpp"
#include "core/input_error.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <unistd.h>

namespace {

using namespace damslip;

struct Answer {
    int code;
    std::string out, talk;
};

Answer run(const std::vector<std::string>& arguments)
{
    std::ostringstream out, talk;
    const int code = cli::run_program(arguments, out, talk, false);
    return {code, out.str(), talk.str()};
}

std::string scene_file(const std::string& text)
{
    const auto path =
        std::filesystem::temp_directory_path() / ("damslip_cli_input_" + std::to_string(::getpid()) + ".toml");
    std::ofstream(path) << text;
    return path.string();
}

const char* const dry_block =
    "[section]\nheight_m = 10\nbase_m = 8\n[dam]\ndensity_kg_m3 = 2500\n[contact]\nfriction = 0.5\n";

TEST(CliInput, UnknownCommandAndFlagGetASuggestion)
{
    const Answer command = run({"sceen"});
    EXPECT_EQ(command.code, 2);
    EXPECT_EQ(command.talk.substr(0, command.talk.find('\n')), "error: unknown command sceen. Did you mean screen?");
    const Answer flag = run({"screen", "x.toml", "--recrod", "a"});
    EXPECT_EQ(flag.code, 2);
    EXPECT_EQ(flag.talk.substr(0, flag.talk.find('\n')),
              "error: unknown flag --recrod of damslip screen. Did you mean --record?");
}

TEST(CliInput, MissingScene)
{
    EXPECT_EQ(run({"screen"}).code, 2);
    const Answer missing = run({"screen", "no_such_scene.toml"});
    EXPECT_EQ(missing.code, 3);
    EXPECT_NE(missing.talk.find("no_such_scene.toml: error: there is no such file."), std::string::npos)
        << missing.talk;
}

TEST(CliInput, ErrorsAreAnObjectWithJson)
{
    const Answer answer = run({"screen", scene_file(std::string(dry_block) + "fricton = 3\n"), "--json"});
    EXPECT_EQ(answer.code, 3);
    const auto j = nlohmann::json::parse(answer.out);
    EXPECT_EQ(j["error"]["code"], 3);
    EXPECT_EQ(j["error"]["diagnostics"][0]["line"], 8);
}

TEST(CliInput, NumberLists)
{
    EXPECT_EQ(cli::number_list("1.00,0.84,0.77", "--friction"), (std::vector<double>{1.0, 0.84, 0.77}));
    EXPECT_EQ(cli::number_list("0.65:1.0:0.05", "--friction"),
              (std::vector<double>{0.65, 0.7, 0.75, 0.8, 0.85, 0.9, 0.95, 1.0}));
    EXPECT_EQ(cli::number_list("3:1:-1,7", "--level"), (std::vector<double>{3, 2, 1, 7}));
    for (const char* bad : {"", "a", "1,", "1:2", "1:2:0", "1:2:-1", "nan", "inf", "0:1e9:1e-9", "1:2:3:4"})
        EXPECT_THROW(cli::number_list(bad, "--friction"), UsageError) << bad;
}

TEST(CliInput, SweepRefusesWhatTheSceneLacks)
{
    const std::string scene = scene_file(dry_block);
    const auto says = [&](std::vector<std::string> more, const std::string& part) {
        more.insert(more.begin(), {"sweep", scene});
        const Answer a = run(more);
        EXPECT_EQ(a.code, 2) << a.talk;
        EXPECT_NE(a.talk.find(part), std::string::npos) << a.talk;
    };
    says({}, "there is no record to sweep over.");
    says({"--level", "3"}, "--level is given, but the scene has no [reservoir].");
    says({"--uplift", "curtain"}, "--uplift curtain: the scene lacks what this profile needs.");
    says({"--uplift", "curtian"}, "Did you mean curtain?");
    says({"--friction", "-1"}, "--friction: -1 is not allowed.");
    says({"--friction", "1", "--friction-deg", "40"}, "both given");
    says({"--polarity", "0"}, "--polarity 0 is not allowed.");
    says({"--method", "rigd"}, "Did you mean rigid?");
}

TEST(CliInput, ScreenFlags)
{
    const std::string scene = scene_file(dry_block);
    EXPECT_EQ(run({"screen", scene, "--vertical", "a.csv"}).code, 2);
    EXPECT_EQ(run({"screen", scene, "--record", "a.csv", "--vertical", "b.csv", "--vertical", "c.csv"}).code, 2);
    EXPECT_EQ(run({"screen", scene, "--friction", "-1"}).code, 2);
    EXPECT_EQ(run({"screen", scene, "--scheme", "newmark"}).code, 2);
    EXPECT_EQ(run({"screen", scene, "--record", "no_such_record.csv"}).code, 3);
}

TEST(CliInput, RecordGenerateNamesTheRange)
{
    const auto says = [](const std::string& flag, const std::string& value, const std::string& part) {
        const Answer a = run({"record", "generate", flag, value});
        EXPECT_EQ(a.code, 2) << a.talk;
        EXPECT_NE(a.talk.find(part), std::string::npos) << a.talk;
    };
    says("--seed", "-1", "a whole number from 0 to 9223372036854775807");
    says("--pga-m-s2", "-1", "0.001 to 50 m/s2");
}

TEST(CliInput, CompletionForAnUnknownShell)
{
    EXPECT_EQ(run({"completion", "tcsh"}).code, 2);
}
TEST(CliInput, ManualPageOfAnUnknownCommand)
{
    EXPECT_EQ(run({"man", "record", "invent"}).code, 2);
    EXPECT_EQ(run({"man", "record", "info"}).code, 0);
}

class Overwriting : public testing::Test {
protected:
    void SetUp() override
    {
        std::filesystem::create_directories(folder);
        std::ofstream(folder / "dam.toml") << dry_block << "[[motion.record]]\nhorizontal = \"h.csv\"\n";
        std::ofstream(folder / "h.csv") << "time_s,accel_m_s2\n0,0\n0.1,2\n0.2,-2\n0.3,0\n";
        std::filesystem::create_symlink(folder / "dam.toml", folder / "link.svg");
    }
    void TearDown() override { std::filesystem::remove_all(folder); }
    std::string in(const std::string& name) const { return (folder / name).string(); }
    std::string text(const std::string& name) const
    {
        std::ifstream file(folder / name);
        return {std::istreambuf_iterator<char>(file), {}};
    }

    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("damslip_overwriting_" + std::to_string(::getpid()));
};

// No output replaces what the same command reads, by whatever name.
TEST_F(Overwriting, IsRefusedForEveryInput)
{
    const std::string scene = text("dam.toml"), record = text("h.csv");
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"sweep", in("dam.toml"), "--out", in("dam.toml")},
          {"sweep", in("dam.toml"), "--out", in("h.csv")},
          {"draw", in("dam.toml"), "--out", in("link.svg")},
          {"mesh", in("dam.toml"), "--out", in("dam.toml")},
          {"explain", in("dam.toml"), "--ablate", "--report", in("h.csv")},
          {"record", "convert", in("h.csv"), "--out", in("h.csv")},
          {"record", "scale", in("h.csv"), "--factor", "2", "--out", in("./h.csv")},
          {"record", "baseline", in("h.csv"), "--out", in("h.csv")}}) {
        const Answer answer = run(words);
        EXPECT_EQ(answer.code, 3) << words.front() << "\n" << answer.talk;
        EXPECT_NE(answer.talk.find("is this file, which is read here: it would be overwritten."), std::string::npos)
            << words.front() << "\n" << answer.talk;
        EXPECT_EQ(text("dam.toml"), scene) << words.front();
        EXPECT_EQ(text("h.csv"), record) << words.front();
    }
    EXPECT_EQ(run({"record", "scale", in("h.csv"), "--factor", "2", "--out", in("twice.csv")}).code, 0);
    EXPECT_EQ(run({"record", "scale", in("h.csv"), "--factor", "2", "--out", in("twice.csv")}).code, 0); // its own, earlier
    EXPECT_EQ(run({"record", "convert", in("twice.csv"), "--out", in("h.at2")}).code, 0);
}

// In a folder, too: an input whose name an output would have stays as it is.
TEST_F(Overwriting, IsRefusedInAFolder)
{
    std::ofstream(folder / "scene.resolved.toml") << text("dam.toml");
    const std::string scene = text("scene.resolved.toml");
    const Answer answer = run({"screen", in("scene.resolved.toml"), "--out", folder.string()});
    EXPECT_EQ(answer.code, 3);
    EXPECT_NE(answer.talk.find("it is an input of this command."), std::string::npos) << answer.talk;
    EXPECT_EQ(text("scene.resolved.toml"), scene);
    EXPECT_EQ(run({"screen", in("dam.toml"), "--out", in("results")}).code, 0);
    EXPECT_EQ(run({"screen", in("results/scene.resolved.toml"), "--out", in("results")}).code, 0); // the same bytes
}

TEST_F(Overwriting, ADrawingIsSvg)
{
    const Answer answer = run({"draw", in("dam.toml"), "--out", in("dam.png")});
    EXPECT_EQ(answer.code, 2);
    EXPECT_NE(answer.talk.find("dam.png is no SVG file."), std::string::npos) << answer.talk;
    EXPECT_EQ(run({"draw", in("dam.toml"), "--out", in("dam.svg")}).code, 0);
}

} // namespace
