// Audit 3, C, "Report": what a page shows first, and in which words.
#include "pages/accuracy/accuracy_pages.hpp"
#include "pages/assess/assess_pages.hpp"
#include "pages/fe/fe_pages.hpp"
#include "pages/report/table_text.hpp"
#include "pages/scene/scene_pages.hpp"
#include "pages/screen/screen_pages.hpp"
#include "pages/sweep/sweep_pages.hpp"
#include "program_answer.hpp"
#include "scene/read.hpp"
#include "sliding/equilibrium/limit_equilibrium.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <sstream>

namespace damslip {
namespace {

using pages::Page;
using pages::Section;

/// A folder with a strong half-sine pulse and a dam of 40 m whose friction is given.
struct Folder {
    Folder()
    {
        std::filesystem::create_directories(path);
        std::ofstream(path / "pulse.csv") << "time_s,acceleration_m_s2\n0,0\n0.1,1.5\n0.2,3\n0.3,1.5\n0.4,0\n0.5,-2\n"
                                             "0.6,-2\n0.7,0\n0.8,0\n";
    }
    ~Folder() { std::filesystem::remove_all(path); }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    std::string dam(double friction, const std::string& more = "") const
    {
        const std::filesystem::path file = path / fmt::format("dam_{}.toml", friction);
        std::ofstream(file) << "title = \"Dam\"\nsection = { height_m = 40, base_m = 34, crest_m = 5 }\n"
                               "dam = { density_kg_m3 = 2400, young_modulus_GPa = 25, poisson_ratio = 0.2 }\n"
                               "reservoir = { level_m = 37 }\nuplift = { model = \"linear\" }\n"
                            << fmt::format("contact = {{ friction = {} }}\n", friction)
                            << "criteria = { allowable_slip_mm = 20 }\n"
                            << more << "[[motion.record]]\nhorizontal = \"pulse.csv\"\n";
        return file.string();
    }

    /// The page of `screen`.
    Page screened(const std::string& file) const
    {
        const Scene given = read_scene(file);
        const Ready ready = prepare(given, Method::rigid_block);
        const Screening screening = run_screening(ready, 1);
        return pages::screen_page({given, ready.scene, screening, ready.records(), 1});
    }

    const std::filesystem::path path =
        std::filesystem::temp_directory_path() /
        ("damslip_audit3_report_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
};

std::vector<std::string> titles(const Page& page)
{
    std::vector<std::string> list;
    for (const Section& section : page.sections) list.push_back(section.title);
    return list;
}

std::ptrdiff_t place(const Page& page, const std::string& title)
{
    const std::vector<std::string> all = titles(page);
    return std::find(all.begin(), all.end(), title) - all.begin();
}

std::string read(const std::filesystem::path& file)
{
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
}

bool has(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}

constexpr const char* cadam = "[[combination]]\nname = \"usual\"\nkind = \"usual\"\nrequired_sliding_factor = 1.5\n"
                              "required_flotation_factor = 1.2\n[[combination]]\nname = \"quake\"\nkind = \"extreme\"\n"
                              "k_h = 0.2\nrequired_sliding_factor = 1.1\n";

TEST(Audit3, C_EquilibriumFirstWhereTheSlipIsZero)
{
    const Folder f;
    const Page still = f.screened(f.dam(2.5)), sliding = f.screened(f.dam(0.9));
    EXPECT_TRUE(has(still.headline.sentence, "does not slide")) << still.headline.sentence;
    EXPECT_LT(place(still, "Limit equilibrium"), place(still, "Slip"));
    EXPECT_GT(place(sliding, "Limit equilibrium"), place(sliding, "Slip"));
    EXPECT_LT(place(sliding, "Limit equilibrium"), place(sliding, "Records"));
}

TEST(Audit3, C_ChecksAreOneMatrix)
{
    const Folder f;
    const Scene given = read_scene(f.dam(0.9, cadam));
    const Ready ready = prepare(given, Method::rigid_block);
    const auto combinations = run_screening(ready, 1).combinations;
    const Table matrix = pages::check_matrix(combinations);
    ASSERT_EQ(combinations.size(), 3u);
    ASSERT_EQ(matrix.rows.size(), 3u); // a row for each combination, and for the crack that the earthquake opens
    EXPECT_EQ(matrix.rows[2][0], Cell("quake, cracked"));
    ASSERT_EQ(matrix.columns.size(), 4u);
    EXPECT_EQ(matrix.columns[2].heading, "sliding, peak strength");
    EXPECT_EQ(matrix.columns[3].heading, "flotation");
    for (std::size_t i = 0; i < 3; ++i) {
        const double required = i == 0 ? 1.5 : 1.1, value = combinations[i].sliding_factor;
        EXPECT_EQ(matrix.rows[i][2],
                  Cell(fmt::format("{} {:.4g} / {:.4g}", value >= required ? "PASS" : "FAIL", value, required)));
    }
    for (const std::size_t i : {1, 2}) EXPECT_EQ(matrix.rows[i][3], Cell()); // no criterion
    for (const std::string& note : matrix.notes) EXPECT_FALSE(has(note, "Required by")) << note; // but by the scene
    const std::string html =
        pages::page_html(pages::screen_page({given, ready.scene, run_screening(ready, 1), ready.records(), 1}));
    EXPECT_TRUE(has(html, "<td class=\"fail\">FAIL "));
    EXPECT_LT(html.find("Load combinations: value / required"), html.find("Quantities of each combination"));
    const std::string out = answer_of({"screen", f.dam(0.9, cadam)}).out;
    EXPECT_TRUE(has(out, "Load combinations: value / required")) << out;
}

TEST(Audit3, C_VerdictIsTheSecondColumn)
{
    const Folder f;
    const Scene given = read_scene(f.dam(0.9));
    const Ready ready = prepare(given, Method::rigid_block);
    const std::string html =
        pages::page_html(pages::screen_page({given, ready.scene, run_screening(ready, 1), ready.records(), 1}));
    EXPECT_TRUE(has(html, "<th scope=\"col\">record</th><th scope=\"col\">verdict</th>"));
}

// Four runs of two records: the milder polarity of each is folded at the end.
TEST(Audit3, C_WorsePolarityInFullTheOtherInAnAppendix)
{
    std::vector<ContactRun> runs;
    std::vector<Section> sections;
    for (const auto& [record, polarity, slip] :
         {std::tuple{"a", 1, 0.010}, {"a", -1, -0.030}, {"b", 1, 0.005}, {"b", -1, 0.001}}) {
        ContactRun& run = runs.emplace_back();
        run.record = record;
        run.polarity = polarity;
        run.both = true;
        run.fe.status = Status::at_rest;
        run.fe.max_slip = slip;
        sections.push_back({"Record " + run.label(), {}, pages::Fold::open});
    }
    Page page;
    const std::vector<Section> appendix = pages::add_worse_polarities(runs, sections, page);
    EXPECT_EQ(titles(page), (std::vector<std::string>{"Record a, polarity -1", "Record b, polarity +1"}));
    ASSERT_EQ(appendix.size(), 2u);
    EXPECT_EQ(appendix[0].title, "Appendix: Record a, polarity +1");
    EXPECT_EQ(appendix[1].title, "Appendix: Record b, polarity -1");
    for (const Section& section : appendix) EXPECT_EQ(section.fold, pages::Fold::folded);
    for (const Section& section : page.sections) EXPECT_EQ(section.fold, pages::Fold::open);
}

TEST(Audit3, C_SweepIsLedByTheFrictionNeeded)
{
    const Folder f;
    const std::string scene = f.dam(0.9), out = (f.path / "sweep.csv").string();
    ASSERT_EQ(answer_of({"sweep", scene, "--friction", "0.9,1.0,1.1,1.4,2.0", "--method", "rigid", "--out", out}).code,
              0);
    const std::string html = read(f.path / "sweep.html");
    const std::size_t needs = html.find("A slip of 20 mm at most needs a friction of");
    ASSERT_NE(needs, std::string::npos);
    EXPECT_LT(needs, html.find("the largest slip is"));
    EXPECT_TRUE(has(html.substr(needs, 200), "governed by record pulse, polarity"));
    EXPECT_LT(html.find("<h2>Friction needed</h2>"), html.find("<h2>Slip over friction</h2>"));
    EXPECT_LT(html.find("<dt>Friction needed, rigid</dt>"), html.find("<dt>Rows</dt>"));
}

TEST(Audit3, C_AssessHasTheLimitsOfValidity)
{
    const Folder f;
    std::filesystem::create_directories(f.path / "out");
    const ProgramAnswer answer =
        answer_of({"assess", f.dam(0.9), "--budget", "0.1", "--out", (f.path / "out").string()});
    const std::string html = read(f.path / "out" / "report.html");
    ASSERT_FALSE(html.empty()) << answer.talk;
    EXPECT_TRUE(has(html, "<h2>Limits of validity</h2>"));
    for (const char* heading : {"aspect", "assumption", "invalid when", "do instead"})
        EXPECT_TRUE(has(html, fmt::format("<th scope=\"col\">{}</th>", heading))) << heading;
    EXPECT_TRUE(has(html, "this is no upper bound"));
}

TEST(Audit3, C_TablesAreNoWiderThanTheTerminal)
{
    const Folder f;
    for (const std::string& file : {f.dam(0.9, cadam), f.dam(2.5)}) {
        std::istringstream lines(answer_of({"screen", file}).out);
        bool answered = false; // the sentences of the answer and its notes follow the tables
        for (std::string line; std::getline(lines, line);) {
            answered = answered || line.starts_with("The dam ");
            if (answered) continue;
            const auto shown = std::count_if(line.begin(), line.end(), [](char c) { return (c & 0xC0) != 0x80; });
            EXPECT_LE(shown, 110) << line;
        }
    }
    Table wide{"Wide", {{"record", "record"}, {"polarity", "polarity"}}, {{std::string("r"), std::int64_t{-1}}}, {}};
    for (int i = 0; i < 12; ++i) {
        wide.columns.push_back({fmt::format("c{}", i), fmt::format("a long heading {}", i)});
        wide.rows[0].push_back(1.0 * i);
    }
    wide.columns.push_back({"verdict", "verdict"});
    wide.rows[0].push_back(std::string("PASS"));
    const std::string out = pages::text(wide);
    std::istringstream lines(out);
    std::string line;
    std::getline(lines, line);
    std::getline(lines, line);
    EXPECT_TRUE(line.starts_with("record  polarity  verdict  a long heading 0")) << out;
    std::size_t again = 0;
    for (std::size_t at = 0; (at = out.find("record  polarity", at)) != std::string::npos; ++at) ++again;
    EXPECT_EQ(again, 3u) << out;
    for (int i = 0; i < 12; ++i) EXPECT_TRUE(has(out, fmt::format("a long heading {}", i)));
}

TEST(Audit3, C_WordsOfTheTables)
{
    const Folder f;
    const std::string tall = f.dam(0.9, "[[combination]]\nname = \"quake\"\nkind = \"extreme\"\nk_h = 0.1\n");
    const std::string out = answer_of({"screen", tall}).out;
    for (const char* heading : {"k_h / PGA", "overturning at", "full base opening at"})
        EXPECT_TRUE(has(out, heading)) << heading << "\n" << out;
    for (const char* old : {"k_h of the PGA", "a tips", "a opens base"}) EXPECT_FALSE(has(out, old)) << old;
    // No water, but cohesion: nothing to hold statically.
    std::ofstream(f.path / "bonded.toml") << "section = { height_m = 10, base_m = 8 }\ndam = { density_kg_m3 = 2400 }\n"
                                             "reservoir = { level_m = 9 }\nuplift = { model = \"none\" }\ncontact = { "
                                             "friction = 0.8, cohesion_kPa = 900 }\n";
    EXPECT_TRUE(has(answer_of({"screen", (f.path / "bonded.toml").string()}).out, "cohesion alone suffices"));
}

} // namespace
} // namespace damslip
