// The commands that print what is verified, and the one that prints a mesh.
#include "core/file.hpp"
#include "verification/pages/manual.hpp"
#include "verifier_answer.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <unistd.h>

namespace {

using namespace damslip;
using nlohmann::json;

TEST(CliVerify, CountsItsChecks)
{
    const ProgramAnswer a = verifier_answer({"verify", "records.measure.triangle", "--json"});
    ASSERT_EQ(a.code, 0) << a.talk;
    const json j = json::parse(a.out);
    EXPECT_EQ(j["cases"], 1);
    EXPECT_EQ(j["failed"], 0);
    EXPECT_EQ(j["checks"].get<std::size_t>(), j["results"].size());
    EXPECT_GT(j["results"].size(), 5u);
    const ProgramAnswer text = verifier_answer({"verify", "records.measure.triangle"});
    EXPECT_NE(text.out.find("1 cases, "), std::string::npos);
    EXPECT_NE(text.out.find(", 0 failed"), std::string::npos);
}

TEST(CliVerify, MarkdownHasClaimSourceAndTolerance)
{
    const ProgramAnswer a = verifier_answer({"verify", "records.measure.triangle", "--markdown"});
    ASSERT_EQ(a.code, 0) << a.talk;
    for (const char* words : {"## records.measure.triangle", "Source: ", "Tolerance: ", "| quantity | unit |"})
        EXPECT_NE(a.out.find(words), std::string::npos) << words;
}

TEST(CliVerify, HardCasesShowBothAnswers)
{
    const ProgramAnswer a = verifier_answer({"verify", "--hard", "one-spike", "--json"});
    ASSERT_EQ(a.code, 0) << a.talk;
    const json row = json::parse(a.out)["results"].at(0);
    EXPECT_NEAR(row["value_a"].get<double>(), row["value_b"].get<double>(), row["tolerance"].get<double>());
    EXPECT_NE(row["value_a"], row["value_b"]);
    EXPECT_NE(verifier_answer({"verify", "--hard", "one-spike"}).out.find("hard.record.one-spike"), std::string::npos);
}

TEST(CliVerify, AFilterThatFindsNothingIsRefused)
{
    for (const char* kind : {"--markdown", "--hard"}) {
        const ProgramAnswer a = verifier_answer({"verify", "no.such.case", kind});
        EXPECT_EQ(a.code, 2);
        EXPECT_NE(a.talk.find("no case has \"no.such.case\" in its name"), std::string::npos) << a.talk;
    }
}

// The manual has every case in a class, references apart from our values, and a digest that a reference, a tolerance or a verdict moves
// and the last bits of a value do not.
TEST(CliVerify, TheManualKeepsReferencesAndOurValuesApart)
{
    const verification::Registry cases = verification::all_cases();
    std::vector<pages::CaseOutcome> outcomes;
    std::array<int, 3> of_basis{};
    for (const verification::Case& c : cases) {
        ++of_basis[static_cast<std::size_t>(pages::basis_of(c))];
        if (c.id == "sliding.block.pulses" || c.id == "sliding.empirical.values" || c.id == "sliding.equilibrium.mirror")
            outcomes.push_back({&c, c.run(), 0.0});
    }
    ASSERT_EQ(outcomes.size(), 3u);
    EXPECT_EQ(of_basis[1], 18); // every id of the lists is one of a case
    EXPECT_EQ(of_basis[2], 48);
    EXPECT_EQ(pages::cases_with_sheet().size(), 20u);
    for (const std::string& id : pages::cases_with_sheet())
        EXPECT_TRUE(std::any_of(cases.begin(), cases.end(), [&](const verification::Case& c) { return c.id == id; })) << id;

    const pages::Page page = pages::manual_page(outcomes, {}, {}, "none known");
    EXPECT_EQ(page.headline.outcome, pages::Outcome::fail); // three cases are not the record of the release
    const std::string html = pages::page_html(page);
    for (const char* words : {"published figure", "another method of our own", "Values of this build", "ERRATA.md", "none known"})
        EXPECT_NE(html.find(words), std::string::npos) << words;
    const std::string digest = pages::record_digest(outcomes);
    verification::Check& first = outcomes.front().checks.front();
    const double computed = first.computed;
    first.computed = std::nextafter(computed, 1e300);
    EXPECT_EQ(pages::record_digest(outcomes), digest);
    first.computed = 2.0 * computed + 1.0;
    EXPECT_NE(pages::record_digest(outcomes), digest);
    first.computed = computed;
    first.tolerance *= 2.0;
    EXPECT_NE(pages::record_digest(outcomes), digest);
}

/// A block on rock, 4 m by 4 m, and a folder for it.
class CliMesh : public testing::Test {
protected:
    void SetUp() override
    {
        folder = std::filesystem::temp_directory_path() / ("damslip_cli_mesh_" + std::to_string(::getpid()));
        std::filesystem::create_directories(folder);
    }
    void TearDown() override { std::filesystem::remove_all(folder); }
    std::string scene(const std::string& mesh)
    {
        const std::filesystem::path file = folder / "block.toml";
        write_file(file, "[section]\nheight_m = 4\nbase_m = 4\ncrest_m = 4\n[dam]\ndensity_kg_m3 = 2500\n"
                         "young_modulus_GPa = 25\n[foundation]\nyoung_modulus_GPa = 30\nwidth_m = 20\n"
                         "depth_m = 8\nmass = \"massless\"\n"
                         "[contact]\nfriction = 0.7\n[mesh]\n" +
                             mesh);
        return file.string();
    }
    std::filesystem::path folder;
};

TEST_F(CliMesh, SaysWhatTheMeshIs)
{
    const ProgramAnswer a = answer_of({"mesh", scene("size_m = 1\ncontact_size_m = 1\n"), "--json"});
    ASSERT_EQ(a.code, 0) << a.talk;
    const json row = json::parse(a.out)["mesh"].at(0);
    EXPECT_EQ(row["dam_elements"], 16);
    EXPECT_EQ(row["base_nodes_dam"], 5);
    EXPECT_EQ(row["base_nodes_rock"], 5);
    EXPECT_NEAR(row["smallest_edge_m"].get<double>(), 1.0, 1e-12);
    EXPECT_NE(answer_of({"mesh", scene("size_m = 1\n")}).out.find("face each other along the base"), std::string::npos);
}

TEST_F(CliMesh, WhatIsWrittenIsReadAgain)
{
    const std::string own = scene("size_m = 1\ncontact_size_m = 1\nelement = \"q8\"\n");
    const std::string file = (folder / "block.msh").string();
    const json made = json::parse(answer_of({"mesh", own, "--json"}).out)["mesh"];
    for (const std::vector<std::string>& more :
         {std::vector<std::string>{"--format", "2.2"}, {"--format", "4.1", "--base", "shared"}}) {
        std::vector<std::string> arguments{"mesh", own, "--out", file};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const ProgramAnswer written = answer_of(arguments);
        ASSERT_EQ(written.code, 0) << written.talk;
        EXPECT_NE(written.out.find("written: " + file), std::string::npos);
        const std::string imported = scene("file = \"block.msh\"\nelement = \"q8\"\n");
        const ProgramAnswer read = answer_of({"mesh", imported, "--json"});
        ASSERT_EQ(read.code, 0) << read.talk;
        for (const char* count : {"nodes", "quadrilaterals", "triangles", "dam_elements", "base_nodes_dam"})
            EXPECT_EQ(json::parse(read.out)["mesh"].at(0)[count], made.at(0)[count]) << count;
        EXPECT_NE(answer_of({"mesh", imported}).out.find("clockwise elements turned"), std::string::npos);
        scene("size_m = 1\ncontact_size_m = 1\nelement = \"q8\"\n");
    }
}

TEST_F(CliMesh, OneNodeForBothSidesNeedsSidesThatMatch)
{
    const ProgramAnswer a = answer_of({"mesh", scene("size_m = 1\ncontact_size_m = 1\nrock_contact_size_m = 0.5\n"),
                                       "--out", (folder / "block.msh").string(), "--base", "shared"});
    EXPECT_EQ(a.code, 2);
    EXPECT_NE(a.talk.find("write  --base twice"), std::string::npos) << a.talk;
    EXPECT_FALSE(std::filesystem::exists(folder / "block.msh"));
}

} // namespace
