// What comes in and goes out by the doors of the program: names, lines, files, flags.
#include "cli/command.hpp"
#include "cli/verifier.hpp"
#include "core/csv.hpp"
#include "core/file.hpp"
#include "core/text.hpp"
#include "program_answer.hpp"
#include "source_dir.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <unistd.h>

namespace damslip::audit3_doors {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr const char* pulse = "time_s,accel_m_s2\n0,0\n0.1,2\n0.2,2\n0.3,0\n0.4,-2\n0.5,0\n0.6,0\n";

/// A folder with a stiff block on a coarse mesh and one record, gone at the end.
struct Doors {
    Doors()
    {
        fs::create_directories(folder);
        write("pulse.csv", pulse);
        write("block.toml", block + "[[motion.record]]\nhorizontal = \"pulse.csv\"\n");
    }
    ~Doors() { fs::remove_all(folder); }

    std::string path(const std::string& name) const { return (folder / name).string(); }
    void write(const std::string& name, const std::string& text) const
    {
        fs::create_directories((folder / name).parent_path());
        std::ofstream(folder / name, std::ios::binary) << text;
    }
    std::set<std::string> files(const std::string& name, const std::string& start) const
    {
        std::set<std::string> found;
        for (const auto& entry : fs::directory_iterator(folder / name))
            if (entry.path().filename().string().starts_with(start)) found.insert(entry.path().filename().string());
        return found;
    }
    std::vector<Json> worker(const std::string& lines) const
    {
        std::ostringstream out, talk;
        std::istringstream in(lines), answers;
        cli::worker({path("block.toml"), {}, {}, {}, {}}, {out, talk, cli::Form::text, true}, in);
        answers.str(out.str());
        std::vector<Json> list;
        for (std::string line; std::getline(answers, line);) list.push_back(Json::parse(line));
        return list;
    }

    fs::path folder = fs::temp_directory_path() / fmt::format("damslip_doors_{}", ::getpid());
    const std::string block = "[section]\npolygon_m = [[0, 0], [8, 0], [8, 2], [0, 2]]\n[dam]\ndensity_kg_m3 = 2500\n"
                              "young_modulus_GPa = 2500\n[contact]\nfriction = 0.12\n[mesh]\nsize_m = "
                              "1\ncontact_size_m = 1\n[time]\nsubsteps = 1\n";
};

/// A test of the suite Audit3 with the members of Doors.
#define DOORS_TEST(name)                                                                                               \
    struct name : Doors {                                                                                              \
        void run();                                                                                                    \
    };                                                                                                                 \
    TEST(Audit3, name)                                                                                                 \
    {                                                                                                                  \
        name().run();                                                                                                  \
    }                                                                                                                  \
    void name::run()

constexpr const char* no_number = "(^|[^[:alnum:]_])-?(inf|nan)([^[:alnum:]_]|$)";

DOORS_TEST(D3_RecordsWhoseNamesFoldAlikeHaveFilesOfTheirOwn)
{
    std::string two = block;
    for (const char* name : {"Tōhoku 一", "Tōhoku 二", "A+B 1", "A+B_1", "Plain"})
        two += fmt::format("[[motion.record]]\nname = \"{}\"\nhorizontal = \"pulse.csv\"\n", name);
    write("two.toml", two);
    using Words = std::vector<std::string>;
    for (const Words& more : {Words{"--frames", "2"}, Words{"--reduced"}, Words{"--base", "tied"}}) {
        Words words{"fe", path("two.toml"), "--polarity", "1", "--no-mesh-error", "--out", path("out"), "-q"};
        words.insert(words.end(), more.begin(), more.end());
        fs::remove_all(folder / "out");
        EXPECT_EQ(answer_of(words).code, 0);
        EXPECT_EQ(files("out", "history_").size(), 5u) << more.front();
        EXPECT_TRUE(files("out", "history_").contains("history_Plain.csv"));
        EXPECT_EQ(files("out", "frames_").size(), more.front() == "--frames" ? 10u : 0u); // a folder and its list each
    }
    EXPECT_NE(file_word("a b", {"a b", "A_B"}), file_word("A_B", {"a b", "A_B"}));
    EXPECT_EQ(file_word("a b", {"a b", "c"}), "a_b");
}

DOORS_TEST(D3_RecordsOfOneNameAreToldApart)
{
    write("a/x.csv", pulse);
    write("b/x.csv", pulse);
    write("same.toml",
          block + "[[motion.record]]\nhorizontal = \"a/x.csv\"\n[[motion.record]]\nhorizontal = \"b/x.csv\"\n");
    write("list.csv", "horizontal\na/x.csv\nb/x.csv\n");
    write("nul.csv", std::string("horizontal\npulse.csv\0.csv\n", 26));
    EXPECT_EQ(answer_of({"screen", path("block.toml"), "--records", path("nul.csv")}).code, 3);
    using Words = std::vector<std::string>;
    for (const Words& more : {Words{path("same.toml")}, Words{path("block.toml"), "--records", path("list.csv")},
                              Words{path("block.toml"), "--record", path("a/x.csv"), path("b/x.csv")}}) {
        Words words{"screen", "--json"};
        words.insert(words.end(), more.begin(), more.end());
        std::set<std::string> names;
        const Json answer = Json::parse(answer_of(words).out);
        for (const Json& row : answer["displacements"]) names.insert(row["record"]);
        EXPECT_EQ(names, (std::set<std::string>{"x", "x (2)"}));
    }
}

DOORS_TEST(D4_NamesThatAreNoUtf8AreRefusedBeforeAnythingIsWritten)
{
    const std::string name = "a\377";
    write(name + "/dam.toml", block + "[[motion.record]]\nhorizontal = \"../pulse.csv\"\n");
    write("suite/b\377.csv", pulse);
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"screen", path(name + "/dam.toml"), "--json"},
          {"fe", path("block.toml"), "--out", path(name + "/out")},
          {"sweep", path(name + "/dam.toml"), "--out", path("rows.csv")},
          {"screen", path("block.toml"), "--records", path("suite"), "--out", path("screened")},
          {"record", "suite", path("suite"), "--json"}}) {
        const ProgramAnswer answer = answer_of(words);
        EXPECT_EQ(answer.code, 3) << words[0] << answer.talk;
        EXPECT_NE(answer.talk.find("is not UTF-8"), std::string::npos) << answer.talk;
        EXPECT_NE(answer.talk.find("fix:      rename"), std::string::npos) << answer.talk;
        EXPECT_TRUE(is_utf8(answer.talk) && is_utf8(answer.out));
    }
    EXPECT_FALSE(fs::exists(folder / name / "out") || fs::exists(folder / "rows.csv") ||
                 fs::exists(folder / "screened"));
}

DOORS_TEST(D4_OldHeadersAreReadAsLatin1)
{
    write("latin.csv", "# event: Friul\355 \374ber 1976\n# units: m/s2\n" + std::string(pulse));
    const ProgramAnswer info = answer_of({"record", "info", path("latin.csv"), "--json"});
    EXPECT_EQ(info.code, 0) << info.talk;
    EXPECT_TRUE(Json::accept(info.out));
    const CsvTable list = parse_csv("horizontal,event\nx.csv,\374ber\n");
    EXPECT_EQ(list.rows[0].cells[1], "\303\274ber");
    EXPECT_EQ(utf8_text("plain \303\274"), "plain \303\274");
    for (const char* wrong : {"\300\200", "\355\240\200", "\364\220\200\200", "\342\202", "\200"})
        EXPECT_FALSE(is_utf8(wrong));
    for (const char* right : {"", "a", "\303\274", "\342\202\254", "\360\237\230\200"}) EXPECT_TRUE(is_utf8(right));
}

DOORS_TEST(D5_AssessTakesThePeriodOfItsModes)
{
    write("modes.toml", "section = { height_m = 30, base_m = 26, crest_m = 5 }\n"
                        "dam = { density_kg_m3 = 2500, young_modulus_GPa = 20 }\ncontact = { friction = 0.2 }\n"
                        "flexible_block = { period_s = \"modes\" }\nmesh = { size_m = 6, contact_size_m = 4 }\n"
                        "[[motion.record]]\nhorizontal = \"pulse.csv\"\n");
    const ProgramAnswer answer = answer_of({"assess", path("modes.toml"), "--budget", "1", "--json"});
    EXPECT_NE(answer.code, 3) << answer.talk;
    const Json assessed = Json::parse(answer.out);
    EXPECT_NE(assessed.dump().find("flexible block"), std::string::npos);
    EXPECT_EQ(assessed.dump().find("period 0 s"), std::string::npos);
}

DOORS_TEST(D6_DeepLinesAndKeysAreRefused)
{
    const std::string deep = std::string(80'000, '[') + std::string(80'000, ']');
    const std::string held = std::string(60, '[') + std::string(60, ']');
    const std::vector<Json> answers = worker("{\"id\":" + deep + ",\"set\":{}}\n{\"id\":" + held + "}\n");
    ASSERT_EQ(answers.size(), 3u);
    EXPECT_NE(answers[1].dump().find("nested deeper than 64 levels"), std::string::npos) << answers[1];
    EXPECT_TRUE(answers[2].contains("slip_mm")) << answers[2];

    const auto joined = [](int parts) {
        std::string key = "a";
        for (int k = 1; k < parts; ++k) key += ".a";
        return key;
    };
    for (const std::string& line : {"[" + joined(60'000) + "]", joined(60'000) + " = 1", "\"x\"." + joined(70) + " = 1",
                                    "x = " + std::string(100, '[') + std::string(100, ']')}) {
        write("deep.toml", "title = \"\"\"a.b [[[\n\"\"\"\n" + line + "\n");
        const ProgramAnswer answer = answer_of({"screen", path("deep.toml")});
        EXPECT_EQ(answer.code, 3);
        EXPECT_NE(answer.talk.find("deep.toml:3:"), std::string::npos) << answer.talk.substr(0, 300);
        EXPECT_NE(answer.talk.find("deeper than 64 levels"), std::string::npos) << answer.talk.substr(0, 300);
    }
    write("deep.toml", joined(40) + " = 1\n");
    EXPECT_EQ(answer_of({"screen", path("deep.toml")}).talk.find("deeper"), std::string::npos);
}

DOORS_TEST(D9_ANulInAValueDoesNotEndItsMessage)
{
    std::string scene = block;
    scene.replace(scene.find("[mesh]"), 0, "sliding = \"a\\u0000b\"\n");
    write("nul.toml", scene);
    const ProgramAnswer answer = answer_of({"screen", path("nul.toml"), "--json"});
    EXPECT_EQ(answer.code, 3);
    EXPECT_NE(answer.talk.find("a\u2400b"), std::string::npos) << answer.talk;
    EXPECT_NE(answer.talk.find("fix:"), std::string::npos) << answer.talk;
    EXPECT_NE(Json::parse(answer.out)["error"]["message"].get<std::string>().find("fix:"), std::string::npos);
}

DOORS_TEST(D9_NothingThatDrivesIsSaidInWords)
{
    const std::string still = block + "[regressions]\nperiod_s = 0.3\n[[motion.record]]\nhorizontal = \"pulse.csv\"\n";
    write("still.toml", still);
    write("run_out.toml", still + "[sliding]\nrun_out_max_s = 0\n");
    write("floats.toml", "section = { height_m = 30, base_m = 24, crest_m = 5 }\n"
                         "dam = { density_kg_m3 = 24.0, young_modulus_GPa = 20 }\ncontact = { friction = 0.7 }\n"
                         "reservoir = { level_m = 27, model = \"added-mass\" }\nuplift = { model = \"linear\" }\n"
                         "mesh = { size_m = 6, contact_size_m = 4 }\n[[motion.record]]\nhorizontal = \"pulse.csv\"\n");
    using Words = std::vector<std::string>;
    for (const Words& words :
         {Words{"assess", path("still.toml"), "--budget", "1"}, Words{"assess", path("floats.toml"), "--budget", "1"},
          Words{"fe", path("run_out.toml"), "--no-mesh-error"}, Words{"screen", path("floats.toml")},
          Words{"explain", path("floats.toml"), "--ablate"}}) {
        const ProgramAnswer answer = answer_of(words);
        EXPECT_FALSE(std::regex_search(answer.out + answer.talk, std::regex(no_number)))
            << words[0] << words[1] << answer.out;
    }
    EXPECT_NE(answer_of({"assess", path("floats.toml"), "--budget", "1"}).out.find("no friction would hold it"),
              std::string::npos);
}

DOORS_TEST(D9_JsonIsOneObjectWhereverItIsAskedFor)
{
    const std::string scene = path("block.toml");
    using Words = std::vector<std::string>;
    for (Words words : {Words{"draw", scene}, Words{"draw", scene, "--out", path("a.svg")}, Words{"mesh", scene},
                        Words{"mesh", scene, "--out", path("a.msh")}, Words{"man", "fe"},
                        Words{"man", "--out", path("man")}, Words{"completion", "bash"}, Words{"schema"},
                        Words{"schema", "--markdown"}, Words{"init", path("own.toml"), "--height", "30"},
                        Words{"sweep", scene, "--plan", "--out", path("parts.csv")},
                        Words{"sweep", scene, "--slurm-array", path("job.sh"), "--out", path("parts.csv")},
                        Words{"sweep", scene, "--out", path("rows.csv")}, Words{"record", "info", path("pulse.csv")},
                        Words{"record", "convert", path("pulse.csv"), "--out", path("pulse.at2")},
                        Words{"slide", "--yield-g", "0.05", "--record", path("pulse.csv")},
                        Words{"regress", "--yield-g", "0.08", "--pga-g", "0.35"}, Words{"explain", scene}}) {
        words.insert(words.end(), {"--json", "-q"});
        const ProgramAnswer answer = answer_of(words);
        EXPECT_EQ(answer.code, 0) << words[0] << answer.talk;
        EXPECT_TRUE(Json::parse(answer.out, nullptr, false).is_object()) << words[0] << answer.out.substr(0, 200);
    }
    EXPECT_TRUE(read_file(path("rows.csv")).find("\nid,") != std::string::npos); // the table stays a table
}

DOORS_TEST(D9_EveryNameOfASuiteComesBackFromItsList)
{
    const std::set<std::string> names{"#a_h.csv", "=x_h.csv", "comma, and \"quotes\"_h.csv", "'=y_h.csv",
                                      " blank _h.csv"};
    for (const std::string& name : names) write("suite/" + name, pulse);
    ASSERT_EQ(
        answer_of({"record", "suite", path("suite"), "--target-pga-m-s2", "2", "--out", path("suite/list.csv")}).code,
        0);
    std::set<std::string> read;
    const CsvTable list = parse_csv(read_file(path("suite/list.csv")));
    for (const CsvLine& row : list.rows) read.insert(row.cells[0]);
    EXPECT_EQ(read, names);
    EXPECT_NE(read_file(path("suite/list.csv")).find(",'=x,"), std::string::npos); // its event
    const ProgramAnswer screened =
        answer_of({"screen", path("block.toml"), "--records", path("suite/list.csv"), "--json"});
    ASSERT_EQ(screened.code, 0) << screened.talk;
    EXPECT_EQ(Json::parse(screened.out)["records"].size(), names.size());
}

DOORS_TEST(D9_WhatHasNoEndIsNotReadToIt)
{
    EXPECT_EQ(answer_of({"sweep", "--merge", "/dev/zero", "--out", path("m.csv")}).code, 3);
    write("huge.csv", "");
    fs::resize_file(folder / "huge.csv", std::uintmax_t{3} << 30);
    EXPECT_EQ(answer_of({"sweep", "--merge", path("huge.csv"), "--out", path("m.csv")}).code, 3);
    EXPECT_EQ(answer_of({"screen", "/dev/zero"}).code, 3);
    const std::vector<Json> answers = worker(std::string(20u << 20, ' ') + "{}\n{}\n");
    ASSERT_EQ(answers.size(), 3u);
    EXPECT_NE(answers[1].dump().find("longer than 16 MB"), std::string::npos) << answers[1];
    EXPECT_TRUE(answers[2].contains("slip_mm"));
}

/// A browser of the path that does what a script says.
class Browser {
public:
    Browser(const fs::path& folder, const std::string& script)
    {
        write_file(folder / "bin" / "chromium", "#!/bin/sh\n" + script);
        fs::permissions(folder / "bin" / "chromium", fs::perms::owner_all);
        fs::create_directories(folder / "t#x?%41");
        ::setenv("PATH", ((folder / "bin").string() + ":" + path_).c_str(), 1);
        ::setenv("TMPDIR", (folder / "t#x?%41").c_str(), 1);
    }
    ~Browser()
    {
        ::setenv("PATH", path_.c_str(), 1);
        ::unsetenv("TMPDIR");
    }

private:
    std::string path_ = std::getenv("PATH");
};

DOORS_TEST(D9_PagesArePrintedFromAnyFolderAndNothingStaysThere)
{
    const fs::path scratch = folder / "t#x?%41";
    {
        const Browser echo(
            folder,
            "for word; do case $word in --print-to-pdf=*) out=${word#*=} ;; file://*) page=$word ;; esac; done\n"
            "echo \"$page\" > \"$out\"\n");
        cli::print_pdf("<p>page</p>", folder / "printed");
        EXPECT_NE(read_file(folder / "printed").find("/t%23x%3F%2541/damslip-print-"), std::string::npos);
        EXPECT_TRUE(fs::is_empty(scratch));
    }
    const Browser slow(folder, "kill -TERM $PPID\nexec sleep 30\n");
    const auto begin = std::chrono::steady_clock::now();
    const ProgramAnswer ended = answer_of({"screen", path("block.toml"), "--pdf", path("ended.pdf"), "-q"});
    EXPECT_EQ(ended.code, 4) << ended.talk;
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(15));
    EXPECT_TRUE(fs::is_empty(scratch));
    EXPECT_FALSE(fs::exists(folder / "ended.pdf"));
}

DOORS_TEST(D10_KeysOfALineAreGivenOnceAndInNumbersThatEnd)
{
    std::string many = "{\"set\":{";
    for (int k = 0; k < 200'000; ++k) many += fmt::format("{}\"k{}\":1", k ? "," : "", k);
    const auto begin = std::chrono::steady_clock::now();
    const std::vector<Json> answers = worker(many + "}}\n{\"set\":{\"contact.friction\":0.1,\"contact.friction\":0.2}}"
                                                    "\n{\"id\":1,\"id\":2}\n{\"id\":{\"a\":1,\"b\":2}}\n");
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(10));
    ASSERT_EQ(answers.size(), 5u);
    EXPECT_NE(answers[1].dump().find("more than 1000 members"), std::string::npos) << answers[1];
    EXPECT_NE(answers[2].dump().find("contact.friction\\\" stands twice"), std::string::npos) << answers[2];
    EXPECT_NE(answers[3].dump().find("id\\\" stands twice"), std::string::npos) << answers[3];
    EXPECT_TRUE(answers[4].contains("slip_mm")) << answers[4];
}

DOORS_TEST(D10_EveryWrongCommandLineSaysWhatIsExpected)
{
    const std::string scene = path("block.toml");
    using Words = std::vector<std::string>;
    for (const auto& [words, expected] :
         {std::pair{Words{"screen"}, "SCENE"},
          std::pair{Words{"screen", scene, "--friction", "much"}, "--friction FLOAT"},
          std::pair{Words{"fe", scene, "--polarity", "3"}, "--polarity INT"},
          std::pair{Words{"fe", scene, "--out"}, "--out TEXT"},
          std::pair{Words{"screen", scene, "another"}, "damslip screen SCENE"},
          std::pair{Words{"fe", scene, "--frames", "5"}, "--frames INT"},
          std::pair{Words{"fe", scene, "--base", "tied", "--reduced"}, "--base TEXT"},
          std::pair{Words{"record"}, "info"}, std::pair{Words{"-q"}, "screen"},
          std::pair{Words{"modes", scene, "--count", "0"}, "--count INT"},
          std::pair{Words{"regress"}, "--yield-g FLOAT"}, std::pair{Words{"sweep", scene, "-j", "x"}, "--jobs INT"},
          std::pair{Words{"screen", scene, "--frictoin", "1"}, "--friction"}, std::pair{Words{"scren"}, "screen"}}) {
        const ProgramAnswer answer = answer_of(words);
        EXPECT_EQ(answer.code, 2) << words.back() << answer.talk;
        const std::size_t at = answer.talk.find("  expected: ");
        EXPECT_NE(at, std::string::npos) << answer.talk;
        EXPECT_NE(answer.talk.find(expected, std::min(at, answer.talk.size())), std::string::npos) << answer.talk;
        EXPECT_NE(answer.talk.find("  fix:      "), std::string::npos) << answer.talk;
    }
}

DOORS_TEST(C_FeTakesJobs)
{
    const std::vector<std::string> fe{"fe", path("block.toml"), "--no-mesh-error", "--json", "-q"};
    const auto with = [&](const char* jobs) {
        std::vector<std::string> words = fe;
        words.insert(words.end(), {"-j", jobs});
        const ProgramAnswer answer = answer_of(words);
        EXPECT_EQ(answer.code, 0) << answer.talk;
        return Json::parse(answer.out)["runs"][0]["slip_mm"];
    };
    EXPECT_EQ(with("1"), with("2"));
}

DOORS_TEST(C_ModesPrintsAsManyAsAreAskedFor)
{
    const std::string dam = (fs::path(source_dir()) / "examples" / "reference_dam.toml").string();
    const Json four = Json::parse(answer_of({"modes", dam, "--count", "4", "--json", "-q"}).out);
    EXPECT_EQ(four["modes"].size(), 4u);
    EXPECT_EQ(Json::parse(answer_of({"modes", path("block.toml"), "--count", "3", "--json", "-q"}).out)["modes"].size(),
              3u);
}

DOORS_TEST(C_TheTablesOfEquilibriumAreFilesToo)
{
    ASSERT_EQ(answer_of({"screen", path("block.toml"), "--out", path("out"), "-q"}).code, 0);
    for (const char* name : {"equilibrium.csv", "verdicts.csv", "yield.csv"}) {
        const CsvTable table = parse_csv(read_file(path(std::string("out/") + name)));
        ASSERT_FALSE(table.rows.empty()) << name;
        for (const CsvLine& row : table.rows) EXPECT_EQ(row.cells.size(), table.heading.cells.size()) << name;
    }
}

/// The words of "damslip screen dam.toml > x", without quotes.
std::vector<std::string> words_of(const std::string& example)
{
    const std::size_t begin = example.find("damslip ");
    std::istringstream line(example.substr(begin + 8, example.find_first_of("|>)", begin) - begin - 8));
    std::vector<std::string> words;
    for (std::string word; line >> word;) {
        std::erase(word, '\'');
        words.push_back(word);
    }
    return words;
}

void check_example(const cli::Command& command, const std::string& example)
{
    const std::vector<std::string> words = words_of(example);
    EXPECT_NO_THROW(cli::parse_arguments(words, cli::commands())) << example;
    std::string before;
    for (const std::string& word : words) {
        const bool output = before == "--out" || before == "--report" || command.name == "init";
        const bool file =
            word.find('*') == std::string::npos && std::regex_match(word, std::regex(".*\\.(toml|csv|at2)"));
        EXPECT_TRUE(output || !file || fs::exists(fs::path(source_dir()) / word)) << example;
        before = word;
    }
    for (const cli::Command& below : command.below) check_example(below, below.example);
}

DOORS_TEST(C_TheExamplesOfEveryHelpAreThere)
{
    const fs::path here = fs::current_path();
    fs::current_path(folder); // what an example would write is checked against this folder
    for (const cli::Command& command : cli::commands()) check_example(command, command.example);
    fs::current_path(here);
}

} // namespace
} // namespace damslip::audit3_doors
