// What is shown of results of others: shares and quantiles against counts by hand, the figure's points against their logarithms, and
// the command on a set whose numbers are closed forms.
#include "verification/pages/evidence.hpp"
#include "verifier_answer.hpp"
#include "slammer_files.hpp"

namespace damslip::slammer_tests {

namespace {

using external::Result;
using pages::SourceOutcome;

/// 21 slips of 10 cm, ours -10 ... +10 % of it; 2 % of them allowed: 5 within.
SourceOutcome percent_steps(const external::Source& source)
{
    SourceOutcome outcome{&source, {}, 0.0};
    for (int k = -10; k <= 10; ++k) {
        Result r;
        r.group = "slips";
        r.what = fmt::format("case {}", k);
        r.unit = "cm";
        r.theirs = 10.0;
        r.ours = 10.0 * (1.0 + 0.01 * k);
        r.accuracy = 0.2 + 1e-9;
        r.reproduced = k % 2 == 0;
        r.reason = r.within() ? "" : "on purpose";
        outcome.results.push_back(r);
    }
    return outcome;
}

external::Source named(std::string id, std::string folder)
{
    external::Source source;
    source.id = std::move(id);
    source.citation = "Somebody (2000), Slips";
    source.subject = "blocks";
    source.accuracy = "two digits";
    source.folder = std::move(folder);
    return source;
}

template <class T>
T cell(const Table& table, std::size_t row, const std::string& column)
{
    for (std::size_t j = 0; j < table.columns.size(); ++j)
        if (table.columns[j].key == column) return std::get<T>(table.rows.at(row).at(j));
    throw std::out_of_range(column);
}

TEST(EvidencePage, CountsAndQuantilesOfAGroup)
{
    const external::Source source = named("somebody", "");
    SourceOutcome outcome = percent_steps(source);
    Result small; // far below the others: within, but not among the ratios
    small.group = "slips";
    small.unit = "cm";
    small.theirs = 1e-3;
    small.ours = 2e-3;
    small.accuracy = 0.1;
    outcome.results.push_back(small);
    const Table table = pages::evidence_table({outcome});
    ASSERT_EQ(table.rows.size(), 1u);
    EXPECT_EQ(cell<std::int64_t>(table, 0, "count"), 22);
    EXPECT_EQ(cell<std::int64_t>(table, 0, "within"), 6);
    EXPECT_EQ(cell<std::int64_t>(table, 0, "reproduced"), 11);
    EXPECT_NEAR(cell<double>(table, 0, "share_within"), 100.0 * 6 / 22, 1e-9);
    EXPECT_NEAR(cell<double>(table, 0, "low_percent"), -9.0, 1e-9); // 5 % of 20 steps
    EXPECT_NEAR(cell<double>(table, 0, "median_percent"), 0.0, 1e-9);
    EXPECT_NEAR(cell<double>(table, 0, "high_percent"), 9.0, 1e-9);
    const Table outside = pages::missed_table({outcome});
    ASSERT_EQ(outside.rows.size(), 16u);
    EXPECT_EQ(cell<std::string>(outside, 0, "what"), "case -10");
    EXPECT_EQ(cell<std::string>(outside, 15, "reason"), "on purpose");
}

// One group, of 10 cm: x of all points is (1 + 3)/6.5 of 460 beside the margin of 56; the largest lies log10(1.1) of a decade higher.
TEST(EvidencePage, FigureHasOnePointForEachSlip)
{
    const external::Source source = named("somebody", "set.gz");
    const std::string svg = pages::evidence_figure({percent_steps(source)});
    const double x = 56.0 + 4.0 / 6.5 * 460.0;
    std::size_t points = 0;
    for (std::size_t at = svg.find(fmt::format("M{:.1f} ", x)); at != std::string::npos;
         at = svg.find(fmt::format("M{:.1f} ", x), at + 1))
        points += svg.compare(svg.find_first_of("hVML", at + 1), 2, "h0") == 0;
    EXPECT_EQ(points, 21u);
    EXPECT_NE(svg.find(fmt::format("M{:.1f} {:.1f}h0", x, 470.0 - (std::log10(11.0) + 3.0) / 6.5 * 460.0)),
              std::string::npos);
    EXPECT_NE(svg.find(">slips</text>"), std::string::npos);
    SourceOutcome frequencies = percent_steps(source);
    for (Result& r : frequencies.results) r.unit = "Hz";
    EXPECT_EQ(pages::evidence_figure({frequencies}), ""); // no slips, no figure
    SourceOutcome nothing = percent_steps(source);
    for (Result& r : nothing.results) r.ours = 0.0; // has no logarithm
    EXPECT_EQ(pages::evidence_figure({nothing}), "");
}

// A source in the program is shown number by number, one of a folder by its groups and the figure; one that was not run says why.
TEST(EvidencePage, MarkdownShowsEachKindOfSource)
{
    const external::Source own = named("printed", ""), large = named("large", "set.gz"),
                           missing = named("absent", "other.gz");
    const std::string page =
        pages::evidence_markdown({percent_steps(own), percent_steps(large), {&missing, {}, 0.0}}, "figures/slips.svg");
    const auto part = [&](const std::string& id) {
        const auto from = page.find("\n## " + id + "\n");
        return from == std::string::npos ? "" : page.substr(from, page.find("\n## ", from + 1) - from);
    };
    EXPECT_NE(part("printed").find("| case 7 | cm | 10 | 10.7 | 0.2 |"), std::string::npos) << part("printed");
    EXPECT_EQ(part("printed").find("figures/slips.svg"), std::string::npos);
    EXPECT_NE(part("large").find("(figures/slips.svg)"), std::string::npos);
    EXPECT_EQ(part("large").find("| case 2 |"), std::string::npos);
    EXPECT_NE(part("large").find("16 of 21 lie outside:"), std::string::npos);
    EXPECT_NE(part("large").find("Somebody (2000), Slips."), std::string::npos);
    EXPECT_NE(part("absent").find("Not run: other.gz is not in the folder."), std::string::npos) << part("absent");
    EXPECT_NE(page.find("## What could not be had"), std::string::npos);
}

class EvidenceCommand : public SlammerFolder {
protected:
    std::vector<Json> forty(double wrong) const
    {
        std::vector<Json> all;
        for (int k = 0; k < 40; ++k)
            all.push_back(rigid(k, 0.3 + 0.05 * (k % 5), 0.06 + 0.005 * (k / 5), k < 8 ? wrong : 1.0));
        return all;
    }
};

// 80 closed forms beside the numbers in the program: more than 97 % within, exit code 0. The figure has their points on the line from
// corner to corner.
using ThoroughEvidenceCommand = EvidenceCommand; // each runs all sources

TEST_F(ThoroughEvidenceCommand, PageAndFigureOfAFolder)
{
    write_set(forty(1.0));
    const std::filesystem::path svg = folder / "slips.svg";
    const ProgramAnswer page =
        verifier_answer({"verify", folder.string(), "--external", "--markdown", "--svg", svg.string()});
    EXPECT_EQ(page.code, 0) << page.talk;
    EXPECT_NE(page.out.find("\n## slammer\nJibson, Rathje, Jibson & Lee (2013)"), std::string::npos);
    EXPECT_NE(page.out.find("| rigid block, slip | 80 | 80 |"), std::string::npos) << page.out;
    EXPECT_NE(page.out.find("(figures/slips.svg)"), std::string::npos);
    const std::string figure = read_file(svg);
    for (int k = 0; k < 40; ++k) {
        const double slip =
            slip_by_hand(accel_of(0.3 + 0.05 * (k % 5)), (0.06 + 0.005 * (k / 5)) * units::standard_gravity);
        const double x = 460.0 * (std::log10(printed_cm(slip)) + 3.0) / 6.5;
        EXPECT_NE(figure.find(fmt::format("M{:.1f} {:.1f}h0", 56.0 + x, 470.0 - x)), std::string::npos) << k;
    }
}

// With eight of them put 20 % wrong less than 97 % are within: 4, and each is told.
TEST_F(ThoroughEvidenceCommand, ExitCodeFollowsTheShareWithin)
{
    write_set(forty(1.2));
    const ProgramAnswer bad = verifier_answer({"verify", folder.string(), "--external", "--json"});
    EXPECT_EQ(bad.code, 4);
    const Json found = Json::parse(bad.out);
    std::size_t told = 0;
    for (const Json& row : found["groups"])
        if (row["source"] == "slammer" && row["group"] == "rigid block, slip") {
            EXPECT_EQ(row["within"], 72);
        }
    for (const Json& row : found["outside"])
        if (row["group"] == "rigid block, slip") {
            ++told;
            EXPECT_NEAR(row["theirs"].get<double>() / row["ours"].get<double>(), 1.2, 1e-4);
        }
    EXPECT_EQ(told, 8u);
    EXPECT_EQ(found["without_reason"], 0);
}

TEST_F(EvidenceCommand, AFolderWithoutTheSetIsRefused)
{
    const ProgramAnswer a = verifier_answer({"verify", folder.string(), "--external"});
    EXPECT_EQ(a.code, 3);
    EXPECT_NE(a.talk.find(set_file() + ": error: there is no such file."), std::string::npos) << a.talk;
}

} // namespace

} // namespace damslip::slammer_tests
