// What is wrong in the tables of a fragility: the line of the file, what is expected, a fix; and tables that are put in place of the file's.
#include "cli/program.hpp"

#include "core/file.hpp"
#include "core/input_error.hpp"
#include "scene/fragility_input.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <sstream>
#include <unistd.h>

namespace damslip::fragility_input {

namespace {

const std::string dam =
    "[section]\nheight_m = 10\nbase_m = 8\n[dam]\ndensity_kg_m3 = 2500\nyoung_modulus_GPa = 25\n"
    "[contact]\nfriction = 0.5\ncohesion_kPa = 100\n[reservoir]\nlevel_m = 5\ndensity_kg_m3 = 1000\n"
    "[uplift]\nmodel = \"linear\"\n";
const std::string variable = "[[probability.variable]]\nname = \"mu\"\nkey = \"contact.friction\"\n"
                             "lognormal = { median = 0.5, beta = 0.1 }\n";
const std::string intensity = "[intensity]\nmeasure = \"PGA\"\nlevels_g = [0.1, 0.2]\n";
const std::string limit = "[[limit]]\nquantity = \"slip\"\nabove_mm = 50\n";

/// Line of the text that starts with these words; 0: none.
int line_of(const std::string& text, const std::string& start)
{
    std::istringstream in(text);
    int number = 1;
    for (std::string line; std::getline(in, line); ++number)
        if (line.starts_with(start)) return number;
    return 0;
}

struct Wrong {
    const char* name;
    std::string text, at;          ///< `at`: start of the line that is named; empty: the file as a whole
    std::string problem, expected; ///< parts of the message
};

class FragilityTables : public testing::TestWithParam<Wrong> {};

TEST_P(FragilityTables, NamesTheLineWhatIsExpectedAndAFix)
{
    const Wrong& given = GetParam();
    try {
        fragility_input_of(given.text, "", "dam.toml");
        FAIL() << "nothing was found wrong";
    } catch (const InputError& e) {
        const auto& all = e.diagnostics();
        const auto found = std::find_if(all.begin(), all.end(), [&](const Diagnostic& d) {
            return d.problem.find(given.problem) != std::string::npos;
        });
        ASSERT_NE(found, all.end()) << e.what();
        EXPECT_EQ(found->line, given.at.empty() ? 0 : line_of(given.text, given.at)) << e.what();
        EXPECT_NE(found->expected.find(given.expected), std::string::npos) << e.what();
        EXPECT_FALSE(found->fix.empty());
        EXPECT_EQ(found->file, "dam.toml");
    }
}

Wrong variable_with(const char* name, const std::string& lines, const std::string& at, const std::string& problem,
                    const std::string& expected)
{
    return {name, dam + "[[probability.variable]]\n" + lines + intensity + limit, at, problem, expected};
}

Wrong limit_with(const char* name, const std::string& lines, const std::string& problem, const std::string& expected)
{
    return {name, dam + variable + intensity + "[[limit]]\n" + lines, "[[limit]]", problem, expected};
}

const std::string law = "uniform = { min = 0.4, max = 0.6 }\n";

INSTANTIATE_TEST_SUITE_P(
    All, FragilityTables,
    testing::Values(
        Wrong{"NoIntensity", dam + variable + limit, "", "[intensity] is missing.", "measure and levels"},
        Wrong{"NoLimit", dam + variable + intensity, "", "[[limit]] is missing.", "at least one"},
        Wrong{"TableThatIsNone", "intensity = 3\n" + dam + variable + limit, "intensity", "intensity is no table.",
              "[intensity]"},
        Wrong{"NoLevels", dam + variable + "[intensity]\nmeasure = \"PGA\"\n" + limit, "[intensity]",
              "intensity has 0 lists of levels.", "one"},
        Wrong{"TwoListsOfLevels", dam + variable + intensity + "levels_m_s2 = [1, 2]\n" + limit, "[intensity]",
              "intensity has 2 lists of levels.", "one"},
        Wrong{"LevelsThatFall", dam + variable + "[intensity]\nlevels_g = [0.2, 0.1]\n" + limit, "levels_g",
              "intensity.levels_g is not allowed.", "ascending numbers > 0"},
        Wrong{"LevelsOfAnotherUnit", dam + variable + "[intensity]\nmeasure = \"PGV\"\nlevels_g = [0.1]\n" + limit,
              "levels_g", "intensity.levels_g is not allowed.", "levels_m_s or levels_cm_s of PGV"},
        Wrong{"UnknownMeasure", dam + variable + "[intensity]\nmeasure = \"PGX\"\nlevels_g = [0.1]\n" + limit,
              "measure", "intensity.measure = \"PGX\" is not allowed.", "PGA"},
        Wrong{"PeriodsThatFall",
              dam + variable + "[intensity]\nmeasure = \"avgSA(0.4,0.2)\"\nlevels_g = [0.1]\n" + limit, "measure",
              "intensity.measure = \"avgSA(0.4,0.2)\" is not allowed.", "avgSA"},
        variable_with("NoKey", "name = \"mu\"\n" + law, "[[probability.variable]]",
                      "probability.variable.key is missing.", "a key of the scene"),
        variable_with("EmptyListOfKeys", "key = []\n" + law, "key", "probability.variable.key is not allowed.",
                      "or a list of them"),
        variable_with("NameThatIsNoText", "name = 3\nkey = \"contact.friction\"\n" + law, "name",
                      "probability.variable.name", "a text in quotes"),
        variable_with("UnknownKey", "key = \"contact.fricton\"\n" + law, "key", "contact.fricton", ""),
        Wrong{"TwoOfOneName",
              dam + variable + "[[probability.variable]] # again\nname = \"mu\"\nkey = \"contact.cohesion_kPa\"\n" +
                  law + intensity + limit,
              "[[probability.variable]] # again", "there are two variables \"mu\".", "a name of its own"},
        variable_with("NoLaw", "key = \"contact.friction\"\n", "[[probability.variable]]", "has 0 laws.",
                      "one of lognormal"),
        variable_with("TwoLaws", "key = \"contact.friction\"\n" + law + "normal = { mean = 0.5, sd = 0.1 }\n",
                      "[[probability.variable]]", "has 2 laws.", "one of lognormal"),
        variable_with("LawWithoutBraces", "key = \"contact.friction\"\nuniform = 0.4\n", "uniform", "is not allowed.",
                      "its numbers in braces"),
        variable_with("LawThatMissesANumber", "key = \"contact.friction\"\nuniform = { min = 0.4 }\n", "uniform",
                      "uniform.max is missing.", "all numbers of the law"),
        variable_with("SpreadOfNothing", "key = \"contact.friction\"\nnormal = { mean = 0.4, sd = 0 }\n", "normal",
                      "normal.sd is not allowed.", "a number > 0"),
        variable_with("HalfOfTwoForms", "key = \"contact.friction\"\nlognormal = { median = 0.4, cov = 0.1 }\n",
                      "lognormal", "is not allowed.", "median and beta, or mean and cov"),
        variable_with("FewerWeightsThanValues",
                      "key = \"uplift.model\"\ndiscrete = { values = [\"linear\", \"none\"], weights = [1] }\n",
                      "discrete", "discrete is not allowed.", "as many weights > 0 as values"),
        Wrong{"CorrelationOfAStranger",
              dam + variable + "[[probability.correlation]]\nbetween = [\"mu\", \"c\"]\nspearman = 0.2\n" + intensity +
                  limit,
              "[[probability.correlation]]", "probability.correlation.between is not allowed.",
              "names of two variables"},
        Wrong{"CorrelationOfOne",
              dam + variable +
                  "[[probability.variable]]\nname = \"c\"\nkey = \"contact.cohesion_kPa\"\nuniform = { min = 1, max = "
                  "2 }\n"
                  "[[probability.correlation]]\nbetween = [\"mu\", \"c\"]\nspearman = 1\n" +
                  intensity + limit,
              "[[probability.correlation]]", "probability.correlation.spearman is not allowed.", "between -1 and 1"},
        limit_with("LimitWithoutAValue", "quantity = \"slip\"\n", "limit has 0 values.", "one of above_mm"),
        limit_with("LimitOfTwoUnits", "quantity = \"slip\"\nabove_mm = 50\nabove_cm = 5\n", "limit has 2 values.",
                   "one of above_mm"),
        limit_with("FactorWithoutAValue", "quantity = \"post-seismic-fs\"\nabove_mm = 50\n",
                   "limit post-seismic-fs has no value.", "below, the least factor"),
        limit_with("SlipBelow", "quantity = \"slip\"\nbelow = 1.1\n", "limit has below, which is of factors.",
                   "above_mm"),
        limit_with("FactorAboveAndBelow", "quantity = \"post-seismic-fs\"\nbelow = 1.1\nabove_mm = 50\n",
                   "limit post-seismic-fs has below and above.", "below alone")),
    [](const testing::TestParamInfo<Wrong>& one) { return one.param.name; });

// Keys that another program gives stand in place of those of the file: as if the file had them.
TEST(FragilityTablesInstead, AreThoseOfAFileThatHasThem)
{
    const std::string text = dam + variable + intensity + "design = \"ida\"\n" + limit;
    const FragilityInput by_file = fragility_input_of(
        dam + "[probability]\nseed = 7\n[[probability.variable]]\nname = \"c\"\nkey = \"contact.cohesion_kPa\"\n"
              "uniform = { min = 50, max = 150 }\n[intensity]\nmeasure = \"PGV\"\nlevels_m_s = [0.3, 0.6]\ndesign = "
              "\"ida\"\n"
              "[[limit]]\nquantity = \"largest-slip\"\nabove_cm = 2\n",
        "", "dam.toml");
    const FragilityInput instead = fragility_input_of(
        text,
        "[probability]\nseed = 7\n[[probability.variable]]\nname = \"c\"\nkey = \"contact.cohesion_kPa\"\n"
        "uniform = { min = 50, max = 150 }\n[intensity]\nmeasure = \"PGV\"\nlevels_m_s = [0.3, 0.6]\n"
        "[[limit]]\nquantity = \"largest-slip\"\nabove_cm = 2\n",
        "dam.toml");
    EXPECT_EQ(instead.probability.seed, by_file.probability.seed);
    ASSERT_EQ(instead.probability.variables.size(), 1u);
    EXPECT_EQ(instead.probability.variables[0].name, "c");
    EXPECT_EQ(instead.probability.variables[0].law.parameters, by_file.probability.variables[0].law.parameters);
    EXPECT_EQ(instead.intensity.measure, IntensityMeasure::pgv);
    EXPECT_EQ(instead.intensity.design, FragilityDesign::ida); // kept from the file
    EXPECT_EQ(instead.intensity.levels, by_file.intensity.levels);
    ASSERT_EQ(instead.limits.size(), 1u);
    EXPECT_EQ(instead.limits[0].text, "largest slip > 2 cm");
    EXPECT_EQ(instead.limits[0].value, by_file.limits[0].value);
}

// What only the command finds: laws whose numbers contradict each other, correlations that do, limits that a method does not compute.
class FragilityCommandInput : public testing::Test {
protected:
    void SetUp() override { write_file(folder / "pulse.csv", "# units: m/s2\nt,a\n0,0\n0.1,3\n0.2,3\n0.3,0\n0.4,0\n"); }
    void TearDown() override { std::filesystem::remove_all(folder); }

    /// @param at  start of the line that is named; empty: none
    void refused(const std::string& tables, const std::string& at, const std::vector<std::string>& words,
                 const std::vector<std::string>& flags = {}) const
    {
        const std::string text = dam + tables + "[[motion.record]]\nname = \"pulse\"\nhorizontal = \"pulse.csv\"\n";
        write_file(folder / "dam.toml", text);
        std::ostringstream out, talk;
        std::vector<std::string> line{"fragility", (folder / "dam.toml").string(), "--samples", "16"};
        line.insert(line.end(), flags.begin(), flags.end());
        EXPECT_NE(cli::run_program(line, out, talk, false), 0) << out.str();
        for (const std::string& word : words) EXPECT_NE(talk.str().find(word), std::string::npos) << talk.str();
        if (!at.empty()) {
            EXPECT_NE(talk.str().find(fmt::format("dam.toml:{}:", line_of(text, at))), std::string::npos) << talk.str();
        }
        EXPECT_EQ(out.str(), "");
    }

    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / fmt::format("damslip fragility input {}", ::getpid());
};

// As every other command: what is wrong in the scene itself has its line, too.
TEST_F(FragilityCommandInput, KeysOfTheSceneHaveTheirLine)
{
    refused("[time]\nsubstep = 1\n" + variable + intensity + limit, "substep", {"unknown key time.substep", "fix:"});
    refused("[criteria]\nallowable_slip_mm = -5\n" + variable + intensity + limit, "allowable_slip_mm",
            {"criteria.allowable_slip_mm = -5 is not allowed.", "fix:"});
}

TEST_F(FragilityCommandInput, LawsThatContradictThemselves)
{
    refused(
        "[[probability.variable]]\nname = \"mu\"\nkey = \"contact.friction\"\nuniform = { min = 0.6, max = 0.4 }\n" +
            intensity + limit,
        "uniform", {"is not allowed.", "expected:", "fix:"});
    refused("[[probability.variable]]\nname = \"mu\"\nkey = \"contact.friction\"\n"
            "triangular = { min = 0.4, mode = 0.9, max = 0.6 }\n" +
                intensity + limit,
            "triangular", {"mode", "is not allowed."});
}

TEST_F(FragilityCommandInput, CorrelationsThatContradictOneAnother)
{
    std::string three;
    for (const auto& [name, key] :
         {std::pair{"a", "contact.friction"}, {"b", "contact.cohesion_kPa"}, {"c", "dam.density_kg_m3"}})
        three += fmt::format("[[probability.variable]]\nname = \"{}\"\nkey = \"{}\"\nkind = \"aleatory\"\n"
                             "lognormal = {{ median = 0.5, beta = 0.1 }}\nfactor = true\n",
                             name, key);
    const auto pair = [](const char* x, const char* y, double r) {
        return fmt::format("[[probability.correlation]]\nbetween = [\"{}\", \"{}\"]\nspearman = {}\n", x, y, r);
    };
    refused(
        three + pair("a", "b", 0.9) + pair("b", "c", 0.9) + pair("a", "c", -0.9) + intensity + limit, "",
        {"the correlations contradict one another", "a positive definite matrix", "leave out one of the correlations"});
}

TEST_F(FragilityCommandInput, LimitsThatAMethodDoesNotCompute)
{
    refused(variable + intensity + "[[limit]]\nquantity = \"post-seismic-fs\"\nbelow = 1.1\n", "",
            {"limit \"factor after the earthquake < 1.1\" is not computed by rigid.", "--method fe"});
    refused(variable +
                "[intensity]\nlevels_g = [0.1]\ndesign = \"cloud\"\n[[limit]]\nquantity = \"lift-off\"\nabove_mm = 1\n",
            "", {"with design = \"cloud\".", "design = \"stripes\""}, {"--method", "fe"});
}

} // namespace
} // namespace damslip::fragility_input
