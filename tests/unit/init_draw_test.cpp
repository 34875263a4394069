// A scene of one's own dam from a few numbers, and its section as a file.
#include "program_answer.hpp"

#include "scene/read.hpp"
#include "source_dir.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <unistd.h>

namespace {

using namespace damslip;

class InitDraw : public testing::Test {
protected:
    void SetUp() override
    {
        folder = std::filesystem::temp_directory_path() / ("damslip-init-" + std::to_string(::getpid()));
        std::filesystem::create_directories(folder);
    }
    void TearDown() override { std::filesystem::remove_all(folder); }
    std::string path(const std::string& name) const { return (folder / name).string(); }
    std::string content(const std::string& name) const
    {
        std::ifstream in(folder / name);
        return {std::istreambuf_iterator<char>(in), {}};
    }

    std::filesystem::path folder;
    const std::string record = std::string(source_dir()) + "/records/data/rock_1.0_h.csv";
};

TEST_F(InitDraw, AFewNumbersMakeASceneThatRuns)
{
    const ProgramAnswer made = answer_of({"init", path("dam.toml"), "--height", "103", "--base", "72", "--level", "95",
                                          "--title", "Dam \"A\"", "--record", record, "--quiet"});
    ASSERT_EQ(made.code, 0) << made.talk;
    const Scene scene = read_scene(path("dam.toml"));
    EXPECT_EQ(scene.title, "Dam \"A\"");
    EXPECT_EQ(scene.reservoir->level, 95.0);
    EXPECT_EQ(scene.contact.friction, 0.8);
    const std::string text = content("dam.toml");
    EXPECT_NE(text.find("base_m = 72                # length"), std::string::npos) << text; // given: not assumed
    EXPECT_NE(text.find("ASSUMED, check: width of the crest"), std::string::npos) << text;
    EXPECT_NE(content("dam.svg").find("class=\"concrete\""), std::string::npos);
    const ProgramAnswer screened = answer_of({"screen", path("dam.toml")});
    EXPECT_EQ(screened.code, 0) << screened.talk;
}

TEST_F(InitDraw, AFileIsNotReplacedUnasked)
{
    ASSERT_EQ(answer_of({"init", path("dam.toml"), "--height", "50", "--quiet"}).code, 0);
    const ProgramAnswer again = answer_of({"init", path("dam.toml"), "--height", "60", "--quiet"});
    EXPECT_EQ(again.code, 2);
    EXPECT_NE(again.talk.find("--force"), std::string::npos) << again.talk;
    EXPECT_NE(content("dam.toml").find("height_m = 50"), std::string::npos);
    EXPECT_EQ(answer_of({"init", path("dam.toml"), "--height", "60", "--quiet", "--force"}).code, 0);
    EXPECT_NE(content("dam.toml").find("height_m = 60"), std::string::npos);
}

TEST_F(InitDraw, WhatIsMissingIsNamed)
{
    const ProgramAnswer none = answer_of({"init", path("dam.toml"), "--quiet"});
    EXPECT_EQ(none.code, 2);
    EXPECT_NE(none.talk.find("--height"), std::string::npos) << none.talk;
    const ProgramAnswer odd = answer_of({"init", path("dam.toml"), "--height", "50", "--vertical", record, "--quiet"});
    EXPECT_NE(odd.code, 0);
    EXPECT_FALSE(std::filesystem::exists(path("dam.toml")));
}

TEST_F(InitDraw, AbsurdNumbersAreRefusedWithTheirRange)
{
    for (const char* height : {"-3", "0", "nan", "1e9"}) {
        const ProgramAnswer a = answer_of({"init", path("dam.toml"), "--height", height, "--quiet"});
        EXPECT_EQ(a.code, 2) << height;
        EXPECT_NE(a.talk.find("--height"), std::string::npos) << a.talk;
        EXPECT_FALSE(std::filesystem::exists(path("dam.toml"))) << height;
    }
}

TEST_F(InitDraw, TheSectionIsAFileOfItsOwn)
{
    const ProgramAnswer drawn =
        answer_of({"draw", std::string(source_dir()) + "/examples/reference_dam.toml", "--out", path("d.svg")});
    ASSERT_EQ(drawn.code, 0) << drawn.talk;
    const std::string svg = content("d.svg");
    EXPECT_EQ(svg.rfind("<svg", 0), 0u);
    EXPECT_NE(svg.find("xmlns="), std::string::npos);
    EXPECT_NE(svg.find("svg { --paper") == std::string::npos ? svg.find("--paper:") : 0, std::string::npos);
    EXPECT_NE(svg.find("class=\"water\""), std::string::npos);
}

} // namespace
