// A document of criteria: its load combinations and required values judge the scene that names it.
#include "program_answer.hpp"
#include "source_dir.hpp"

#include "core/file.hpp"
#include "core/input_error.hpp"
#include "scene/read.hpp"
#include "sliding/equilibrium/limit_equilibrium.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <fmt/format.h>
#include <unistd.h>

namespace damslip {
namespace {

class CriteriaDocument : public testing::Test {
protected:
    CriteriaDocument() { std::filesystem::create_directories(folder); }
    ~CriteriaDocument() override { std::filesystem::remove_all(folder); }

    std::filesystem::path scene(const std::string& document, const std::string& more = "") const
    {
        write_file(folder / "mine.toml", document);
        write_file(folder / "dam.toml",
                   "[section]\nheight_m = 10\nbase_m = 8\n[dam]\ndensity_kg_m3 = 2400\n[contact]\nfriction = 0.7\n"
                   "[criteria]\ndocument = \"mine.toml\"\n" +
                       more);
        return folder / "dam.toml";
    }

    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / fmt::format("damslip_criteria_{}", ::getpid());
};

const char* const document = "title = \"Rules\"\nedition = \"2nd\"\nsource = \"table 4\"\n[criteria]\nallowable_slip_mm = 20\n"
                             "[[combination]]\nname = \"normal\"\nkind = \"usual\"\nrequired_sliding_factor = 3\n"
                             "required_residual_factor = 1.5\nrequired_resultant = \"kern\"\n"
                             "[[combination]]\nname = \"shaken\"\nkind = \"extreme\"\nk_h = 0.1\nrequired_sliding_factor = 1.3\n";

TEST_F(CriteriaDocument, GivesTheCombinationsOfASceneThatHasNone)
{
    const Scene read = read_scene(scene(document));
    ASSERT_EQ(read.combinations.size(), 2u);
    EXPECT_EQ(read.combinations[1].k_h, 0.1);
    EXPECT_EQ(read.combinations[0].source, "Rules, 2nd, table 4");
    EXPECT_EQ(read.criteria.allowable_slip, 0.02);
    const sliding::Requirements required = sliding::requirements(read, read.combinations[0]);
    EXPECT_EQ(required.sliding, 3.0);
    EXPECT_EQ(required.sliding_residual, 1.5);
    EXPECT_EQ(required.resultant, sliding::ResultantZone::kern);
}

// The scene's own combinations stay, and so do its own values; by kind the document says what they require.
TEST_F(CriteriaDocument, JudgesTheCombinationsOfAScene)
{
    const Scene read = read_scene(scene(document, "allowable_slip_mm = 5\n[[combination]]\nname = \"flood\"\nreservoir_level_m = 9\n"
                                                  "[[combination]]\nname = \"own\"\nrequired_sliding_factor = 2\nsource = \"us\"\n"
                                                  "[reservoir]\nlevel_m = 8\n[uplift]\nmodel = \"linear\"\n"));
    ASSERT_EQ(read.combinations.size(), 2u);
    EXPECT_EQ(read.combinations[0].required_sliding_factor, 3.0);
    EXPECT_EQ(read.combinations[0].reservoir_level, 9.0);
    EXPECT_EQ(read.combinations[1].required_sliding_factor, 2.0);
    EXPECT_EQ(read.combinations[1].source, "us");
    EXPECT_EQ(read.criteria.allowable_slip, 0.005);
}

TEST_F(CriteriaDocument, SaysWhatIsWrongWithFileAndLine)
{
    const auto problem = [&](const std::string& text) {
        try {
            read_scene(scene(text));
        } catch (const InputError& error) {
            return error.diagnostics().front();
        }
        return Diagnostic{};
    };
    EXPECT_EQ(problem("title = \"x\"\n").problem, "this document of criteria has no [[combination]].");
    const Diagnostic odd = problem("[dam]\ndensity_kg_m3 = 2400\n[[combination]]\nname = \"a\"\n");
    EXPECT_EQ(odd.problem, "dam has no place in a document of criteria.");
    EXPECT_EQ(odd.line, 1);
    const Diagnostic value = problem("[[combination]]\nname = \"a\"\nrequired_sliding_factor = -1\n");
    EXPECT_EQ(value.file, (folder / "mine.toml").string());
    EXPECT_EQ(value.line, 3);
    std::filesystem::remove(folder / "mine.toml");
    try {
        read_scene(folder / "dam.toml");
        FAIL();
    } catch (const InputError& error) {
        EXPECT_EQ(error.diagnostics().front().problem, "criteria.document = \"mine.toml\": there is no such file.");
        EXPECT_EQ(error.diagnostics().front().line, 9);
    }
}

TEST_F(CriteriaDocument, TheShippedExampleIsJudged)
{
    const std::string example = (std::filesystem::path(source_dir()) / "examples/judged_dam.toml").string();
    const auto answer = nlohmann::json::parse(answer_of({"screen", example, "--rigid-only", "--json"}).out);
    ASSERT_FALSE(answer["criteria"].empty());
    for (const auto& row : answer["criteria"]) {
        EXPECT_NE(row["source"].get<std::string>().find("CDSA 1999"), std::string::npos);
        EXPECT_GT(row["ratio"].get<double>(), 0.0);
    }
    EXPECT_EQ(answer["criteria"][0]["combination"], "usual");
    EXPECT_EQ(answer["criteria"][0]["required"], 3.0);
    // Two checks of one combination on sliding: the words say which is which.
    EXPECT_NE(answer_of({"screen", example, "--rigid-only"}).out.find("usual residual 1.2 < 1.5"), std::string::npos);
}

} // namespace
} // namespace damslip
