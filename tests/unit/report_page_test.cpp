#include "core/file.hpp"
#include "pages/report/answer.hpp"
#include "pages/report/chart.hpp"
#include "pages/report/page.hpp"
#include "source_dir.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <regex>
#include <sstream>

namespace {

using namespace damslip;
using namespace damslip::pages;

std::size_t occurrences(const std::string& text, const std::string& word)
{
    std::size_t n = 0;
    for (std::size_t at = 0; (at = text.find(word, at)) != std::string::npos; at += word.size()) ++n;
    return n;
}

/// A page in which every text that a user can give holds a closing script tag and quotes.
Page hostile_page()
{
    const std::string evil = "</script><img src=x onerror='alert(1)'>\"&";
    Page page;
    page.title = page.subtitle = evil;
    page.headline = {evil, Outcome::pass, evil};
    page.footer = page.title_block.notes = evil;
    page.title_block.entries = page.title_block.signers = {{evil, evil}};
    page.key_figures = page.provenance = {{evil, evil}};
    page.warnings = {evil};
    Table table{evil, {{"a", evil, evil, 4}}, {{Cell(evil)}, {Cell(1.5)}, {Cell()}}, {evil}};
    Chart chart;
    chart.title = chart.note = chart.together = evil;
    chart.x.label = chart.x.unit = chart.y.label = chart.y.unit = evil;
    chart.x.categories = {evil};
    Curve curve;
    curve.name = evil;
    curve.x = {0};
    curve.y = {1};
    chart.curves = {curve};
    chart.horizontal = chart.vertical = {{1.0, evil}};
    chart.moving = Moving{0, evil, evil, {0.0}, {{1.0}}, 0};
    StateMap map{evil, {0.0, 1.0}, {0.0, 1.0}, evil, {"<s", "s<"}, {{'<', evil, 1}, {'s', evil, -1}}, evil};
    MeshView view{evil, {{0, 0}, {1, 0}, {1, 1}}, {{0, 1, 2, -1}}, 3, {{evil, evil}}, {}, evil};
    view.states = {{evil, 0.0, {0, 0, 0}, {0, 0, 0}, 0.0, 0.0, {{1, 2, 3}}}};
    Sketch sketch({0, 0}, {10, 10}, 100);
    sketch.text({1, 1}, evil);
    sketch.level_mark({1, 1}, evil, Align::start);
    page.sections = {{evil,
                      {Paragraph{evil}, TablePart{table, Layout::rows, 1, Fold::open},
                       TablePart{table, Layout::columns, 1, Fold::folded}, chart, map, view,
                       Drawing{evil, sketch.svg(evil), evil}, Listing{evil, evil}},
                      Fold::open},
                     {evil, {}, Fold::folded}};
    return page;
}

TEST(ReportPage, NoTextOfTheUserBecomesMarkup)
{
    const std::string html = page_html(hostile_page());
    EXPECT_EQ(html.find("<img"), std::string::npos);
    // One for the data of chart, map and mesh each, one for the library, one for the page's scripts.
    EXPECT_EQ(occurrences(html, "</script>"), 5u);
    EXPECT_NE(html.find("&lt;/script&gt;&lt;img"), std::string::npos);
    EXPECT_NE(html.find("\\u003c/script>"), std::string::npos);
}

TEST(ReportPage, TheTitleBlockHasRoomForASignatureOfEach)
{
    Page page;
    page.title = "Dam";
    EXPECT_EQ(page_html(page).find("<section class=\"title-block\""), std::string::npos) << "nothing given, no block";
    page.title_block.entries = {{"client", "Owner of the dam"}};
    page.title_block.signers = {{"prepared by", "Name of the engineer"}, {"checked by", "Name of the checker"}};
    page.title_block.notes = "level of 2024";
    const std::string html = page_html(page);
    EXPECT_NE(html.find("<dt>client</dt><dd>Owner of the dam</dd>"), std::string::npos);
    EXPECT_EQ(occurrences(html, "<dd class=\"signature\">"), 2u);
    EXPECT_NE(html.find("<p>level of 2024</p>"), std::string::npos);
}

TEST(ReportPage, TheFooterIsAStringOfTheStyleWhateverItHolds)
{
    Page page;
    page.footer = "Dam \"A\" \\ </style>\nrevision B";
    const std::string html = page_html(page);
    EXPECT_NE(html.find("@bottom-left { content: \"Dam \\\"A\\\" \\\\ \\3c /style>revision B\"; }"), std::string::npos);
    EXPECT_EQ(occurrences(html, "</style>"), 1u);
}

TEST(ReportPage, DefinitionsStandBelowTheirTable)
{
    Page page;
    page.sections = {{"S", {rows_part({"T", {{"a", "a"}}, {{Cell(1.0)}}, {"a note"}}, {"a is <a>"})}}};
    EXPECT_NE(page_html(page).find("<p class=\"note\">a note</p>\n<p class=\"note\">a is &lt;a&gt;</p>"),
              std::string::npos);
}

TEST(ReportPage, TheEmbeddedScriptsEndWhereTheyShould)
{
    EXPECT_EQ(assets().uplot_script.find("</script"), std::string_view::npos);
    for (const std::string_view script : {assets().page_script, assets().state_map_script, assets().mesh_view_script})
        EXPECT_EQ(script.find("</script"), std::string_view::npos);
    EXPECT_EQ(assets().uplot_license.find("*/"), std::string_view::npos);
    EXPECT_EQ(assets().page_style.find("</style"), std::string_view::npos);
    EXPECT_EQ(assets().uplot_style.find("</style"), std::string_view::npos);
}

TEST(ReportPage, NothingIsLoadedFromAnywhere)
{
    const std::string html = page_html(hostile_page());
    std::vector<std::string> urls;
    const std::regex url("[a-z]+://[^ \"'<>)]*");
    for (std::sregex_iterator it(html.begin(), html.end(), url), end; it != end; ++it) urls.push_back(it->str());
    EXPECT_EQ(urls, std::vector<std::string>{"https://github.com/leeoniya/uPlot"}); // the licence comment
    for (const char* word :
         {"<link", "@import", "url(", "<iframe", "<object", "fetch(", "XMLHttpRequest", "sendBeacon"})
        EXPECT_EQ(html.find(word), std::string::npos) << word;
    EXPECT_NE(html.find("default-src 'none'"), std::string::npos);
    EXPECT_NE(html.find("Copyright (c) 2022 Leon Sorokin"), std::string::npos)
        << "the licence of the library stays with it";
}

TEST(ReportPage, TheSamePageGivesTheSameBytes)
{
    EXPECT_EQ(page_html(hostile_page()), page_html(hostile_page()));
}

TEST(ReportPage, TablesShowDigitsUnitsVerdictsAndNothing)
{
    Page page;
    Table table{"t",
                {{"a", "slip", "mm", 3}, {"v", "verdict", "", 4}},
                {{Cell(12.3456), Cell(std::string("FAIL"))}, {Cell(), Cell(std::string("PASS"))}},
                {}};
    page.sections = {{"s", {TablePart{table, Layout::rows, 1, Fold::open}}, Fold::open}};
    const std::string html = page_html(page);
    EXPECT_NE(html.find("slip <span class=\"unit\">mm</span>"), std::string::npos);
    EXPECT_NE(html.find("<td class=\"number\">12.3</td><td class=\"fail\">FAIL</td>"), std::string::npos);
    EXPECT_NE(html.find("<td class=\"number\">–</td><td class=\"pass\">PASS</td>"), std::string::npos);
}

TEST(ReportPage, VendoredFilesAreThoseOfTheirChecksums)
{
    const std::filesystem::path folder = std::filesystem::path(source_dir()) / "src/pages/report/vendor/uplot";
    std::istringstream sums(read_file(folder / "SHA256SUMS"));
    std::string sum, name;
    std::size_t n = 0;
    while (sums >> sum >> name) {
        EXPECT_EQ(sha256(read_file(folder / name)), sum) << name;
        ++n;
    }
    EXPECT_EQ(n, 4u);
    // uPlot 1.6.32 as published; what is in the program is what is in the folder.
    EXPECT_EQ(sha256(assets().uplot_script), "19c8d4c6ad88929a79f4ae49d6f7161566dfd0ba3d15cc495e974f787eb78f1f");
    EXPECT_EQ(sha256(assets().uplot_style), "df630c6a8d6f8eeaff264b50f73ce5b114f646ffd9a0bb74f049b0a00135fa04");
    EXPECT_EQ(assets().page_script, read_file(folder / "../../page.js"));
    EXPECT_EQ(assets().state_map_script, read_file(folder / "../../state_map.js"));
    EXPECT_EQ(assets().mesh_view_script, read_file(folder / "../../mesh_view.js"));
    EXPECT_EQ(assets().page_style, read_file(folder / "../../page.css"));
}

// Runs of a letter are counted; the scripts expand them. Coordinates and triangles as given.
TEST(ReportPicture, DataIsWhatTheScriptsRead)
{
    const StateMap map{"m", {0.0, 0.5}, {0.0, 1.0, 3.0}, "from the heel", {"sss", "sdd"}, {{'s', "sticks", -1}}, ""};
    const auto m = nlohmann::json::parse(state_map_json(map));
    EXPECT_EQ(m["states"], (std::vector<std::string>{"3s", "s2d"}));
    EXPECT_EQ(m["time"][1], 0.5);
    EXPECT_EQ(m["kinds"][0]["colour"], -1);

    MeshView view{"v", {{0, 0}, {2, 0}, {2, 1}}, {{0, 1, 2, -1}}, 3, {{"stress", "MPa"}}, {}, ""};
    view.states = {{"end", 1.5, {0, 0, 0.25}, {0, 0, 0}, 0.125, 0.0, {{1, 2, std::nan("")}}}};
    const auto v = nlohmann::json::parse(mesh_view_json(view));
    EXPECT_EQ(v["elements"], (std::vector<int>{0, 1, 2, -1}));
    EXPECT_EQ(v["x"][2], 2.0);
    EXPECT_EQ(v["states"][0]["shift"][0], 0.125);
    const auto& ux = v["states"][0]["ux"]; // whole multiples of a unit
    EXPECT_NEAR(ux["n"][2].get<double>() * ux["unit"].get<double>(), 0.25, 1e-8 * 0.25);
    EXPECT_TRUE(v["states"][0]["values"][0]["n"][2].is_null());
}

TEST(ReportPicture, AMovingCurveHasItsInstants)
{
    Chart chart;
    chart.curves = {{"a", {0, 1}, {1, 2}, {}, {}, Mark::line, Weight::normal, 0}};
    chart.moving = Moving{0, "time", "s", {0.0, 0.5}, {{1, 2}, {3, 4}}, 1};
    const auto c = nlohmann::json::parse(chart_json(chart, common_abscissae(chart)));
    EXPECT_EQ(c["moving"]["at"][1], 0.5);
    EXPECT_EQ(c["moving"]["y"][1][0], 3.0);
    EXPECT_EQ(c["moving"]["start"], 1);
    chart.moving.reset();
    EXPECT_TRUE(nlohmann::json::parse(chart_json(chart, common_abscissae(chart)))["moving"].is_null());
}

TEST(ReportEscape, HtmlAndJson)
{
    EXPECT_EQ(html_text("a<b>&\"'\x01\n"), "a&lt;b&gt;&amp;&quot;&#39;\n");
    EXPECT_EQ(json_text("</x>\"\\\n"), "\"\\u003c/x>\\\"\\\\\\n\"");
    EXPECT_EQ(nlohmann::json::parse(json_text("\xff<")), "\xEF\xBF\xBD<"); // a byte that is no UTF-8 does not throw
}

// 10 m x 20 m at 100 px: 10 px/m, y turned. The point (2, 5) lies 20 px from the left and 150 px from the top.
TEST(ReportSketch, IsToScaleWithYUp)
{
    Sketch sketch({0, 0}, {10, 20}, 100);
    EXPECT_EQ(sketch.pixels_per_metre(), 10);
    EXPECT_EQ(sketch.metres(25), 2.5);
    sketch.polygon({{0, 0}, {10, 0}, {2, 5}}, "concrete");
    const std::string svg = sketch.svg("a");
    EXPECT_NE(svg.find("viewBox=\"0 0 100 200\""), std::string::npos);
    EXPECT_NE(svg.find("points=\"0.0,200.0 100.0,200.0 20.0,150.0 \""), std::string::npos);
}

TEST(AnswerLine, NamesWhatFailsAndEndsAtAWholeClause)
{
    const auto line = [](const Headline& headline) {
        Answer answer(nlohmann::ordered_json::object());
        answer.headline(headline);
        return answer.line();
    };
    EXPECT_EQ(line({"The dam slides 2.9 mm at most.", Outcome::fail,
                    "Slip: Below the allowable as a rigid block; elasticity not checked; load combinations: FAIL usual 1.2 < 3.0"}),
              "FAIL; Slip: Below the allowable as a rigid block: The dam slides 2.9 mm at most\n");
    EXPECT_EQ(line({"The dam slides 2.9 mm at most.", Outcome::fail, "Slip: PASS; load combinations: FAIL usual 1.2 < 3.0"}),
              "Slip: PASS; load combinations: FAIL usual 1.2 < 3.0: The dam slides 2.9 mm at most\n");
    EXPECT_EQ(line({"The dam slides 377.8 mm at most on clay seam (record A), by rigid blocks. On its base: 20.5 mm at most, by the rigid "
                    "block, which is no bound for an elastic dam.",
                    Outcome::fail, "FAIL on clay seam"}),
              "FAIL on clay seam: The dam slides 377.8 mm at most on clay seam, by rigid blocks. On its base: 20.5 mm at most\n");
    EXPECT_EQ(line({"The dam slides 377.8 mm at most on clay seam. On its base: 20.5 mm at most over three records and both polarities of "
                    "each of them.",
                    Outcome::fail, "FAIL on clay seam"}),
              "FAIL on clay seam: The dam slides 377.8 mm at most on clay seam\n");
}

} // namespace
