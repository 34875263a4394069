#include "verification/pages/evidence.hpp"

#include "pages/report/table_text.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace damslip::pages {

using external::Result;

namespace {

struct Group {
    std::string source, name;
    std::vector<const Result*> results;

    std::int64_t count(auto&& holds) const { return std::count_if(results.begin(), results.end(), holds); }
    std::int64_t within() const
    {
        return count([](const Result* r) { return r->within(); });
    }
    std::int64_t reproduced() const
    {
        return count([](const Result* r) { return r->reproduced; });
    }
    /// Quantile of ours/theirs - 1 [%] of those that are not small: above a thousandth of the largest.
    Cell ratio(double quantile) const
    {
        double largest = 0.0;
        for (const Result* r : results) largest = std::max(largest, std::abs(r->theirs));
        std::vector<double> ratios;
        for (const Result* r : results)
            if (std::abs(r->theirs) > 1e-3 * largest && std::isfinite(r->ours))
                ratios.push_back(100.0 * (r->ours / r->theirs - 1.0));
        if (ratios.empty()) return {};
        std::sort(ratios.begin(), ratios.end());
        return ratios[static_cast<std::size_t>(std::lround(quantile * static_cast<double>(ratios.size() - 1)))];
    }
};

std::vector<Group> groups_of(const std::vector<SourceOutcome>& outcomes)
{
    std::vector<Group> groups;
    for (const SourceOutcome& o : outcomes)
        for (const Result& r : o.results) {
            const auto same = std::find_if(groups.begin(), groups.end(), [&](const Group& g) {
                return g.source == o.subject->id && g.name == r.group;
            });
            Group& group = same == groups.end() ? groups.emplace_back(Group{o.subject->id, r.group, {}}) : *same;
            group.results.push_back(&r);
        }
    return groups;
}

std::vector<ColumnOf<Group>> group_columns(bool with_source)
{
    std::vector<ColumnOf<Group>> columns{
        {{"group", "numbers"}, &Group::name},
        {{"count", "compared"}, [](const Group& g) { return count_cell(g.results.size()); }},
        {{"within", "within"}, &Group::within},
        {{"share_within", "share", "%", 4},
         [](const Group& g) {
             return 100.0 * static_cast<double>(g.within()) / static_cast<double>(g.results.size());
         }},
        {{"reproduced", "digits by its own steps"},
         [](const Group& g) { return g.reproduced() ? Cell(g.reproduced()) : Cell(); }},
        {{"low_percent", "ours − theirs, 5 %", "%", 2}, [](const Group& g) { return g.ratio(0.05); }},
        {{"median_percent", "median", "%", 2}, [](const Group& g) { return g.ratio(0.5); }},
        {{"high_percent", "95 %", "%", 2}, [](const Group& g) { return g.ratio(0.95); }}};
    if (with_source) columns.insert(columns.begin(), {{"source", "source"}, &Group::source});
    return columns;
}

std::string markdown_table(const Table& table)
{
    std::string out = "|", rule = "|";
    for (const Column& c : table.columns) {
        out += fmt::format(" {}{} |", c.heading, c.unit.empty() || c.unit == "–" ? "" : " [" + c.unit + "]");
        rule += " --- |";
    }
    out += "\n" + rule + "\n";
    for (const auto& row : table.rows) {
        out += "|";
        for (std::size_t j = 0; j < row.size(); ++j) out += " " + cell_text(row[j], table.columns[j].digits) + " |";
        out += "\n";
    }
    return out;
}

std::size_t missed(const SourceOutcome& o)
{
    return static_cast<std::size_t>(
        std::count_if(o.results.begin(), o.results.end(), [](const Result& r) { return !r.within(); }));
}

} // namespace

Table evidence_table(const std::vector<SourceOutcome>& outcomes)
{
    return table_of(
        "Numbers of others against ours", group_columns(true), groups_of(outcomes),
        {"within: |ours − theirs| at most the accuracy that the source's digits and its own steps leave; digits by its "
         "own "
         "steps: its scheme, written anew, prints what it printed; ours − theirs: of theirs, above a thousandth of the "
         "largest of the group."});
}

Table missed_table(const std::vector<SourceOutcome>& outcomes)
{
    struct Row {
        std::string source;
        const Result* result;
    };
    std::vector<Row> rows;
    for (const SourceOutcome& o : outcomes)
        for (const Result& r : o.results)
            if (!r.within()) rows.push_back({o.subject->id, &r});
    return table_of<Row>("Outside",
                         {{{"group", "numbers"}, [](const Row& r) { return r.result->group; }},
                          {{"what", "case"}, [](const Row& r) { return r.result->what; }},
                          {{"unit", "unit"}, [](const Row& r) { return r.result->unit; }},
                          {{"theirs", "theirs", "", 6}, [](const Row& r) { return r.result->theirs; }},
                          {{"ours", "ours", "", 6}, [](const Row& r) { return r.result->ours; }},
                          {{"accuracy", "accuracy", "", 2}, [](const Row& r) { return r.result->accuracy; }},
                          {{"reason", "why"}, [](const Row& r) { return r.result->reason; }}},
                         rows);
}

std::string evidence_markdown(const std::vector<SourceOutcome>& outcomes, const std::string& figure)
{
    std::string out = "# Evidence: numbers of others\n\nResults that others published, computed again. The accuracy of "
                      "each source is fixed "
                      "before anything is compared; what lies outside stands below with its reason. Made by `damslip "
                      "verify --external FOLDER "
                      "--markdown`, FOLDER holding what may not be shipped. The same models in another "
                      "finite-element program: [a second solver](second-solver.md).\n";
    for (const SourceOutcome& o : outcomes) {
        out += fmt::format("\n## {}\n{}.\n\nCompared: {}.\n\nIts accuracy: {}.\n", o.subject->id, o.subject->citation,
                           o.subject->subject, o.subject->accuracy);
        if (o.results.empty()) {
            out += fmt::format("\nNot run: {} is not in the folder.\n", o.subject->folder);
            continue;
        }
        const std::vector<SourceOutcome> one{o};
        out += "\n" + markdown_table(table_of("", group_columns(false), groups_of(one)));
        if (o.subject->folder.empty()) {
            out += "\n| case | unit | theirs | ours | accuracy |\n| --- | --- | --- | --- | --- |\n";
            for (const Result& r : o.results)
                out += fmt::format("| {} | {} | {:.6g} | {:.6g} | {:.2g} |\n", r.what, r.unit, r.theirs, r.ours,
                                   r.accuracy);
        } else if (!figure.empty()) {
            out += fmt::format(
                "\n![Our slips over theirs, both logarithmic: all points lie on the line, those of the coupled "
                "analysis beside it]({})\n",
                figure);
        }
        if (missed(o) > 0)
            out += fmt::format("\n{} of {} lie outside:\n\n", missed(o), o.results.size()) +
                   markdown_table(missed_table(one));
    }
    out += "\n## What could not be had\n";
    for (const std::string& words : external::not_to_be_had()) out += "- " + words + ".\n";
    return out;
}

std::string evidence_figure(const std::vector<SourceOutcome>& outcomes)
{
    constexpr double side = 460.0, margin = 56.0, low = -3.0, high = 3.5; // decades of cm
    constexpr const char* colours[] = {"#4269d0", "#efb118", "#ff725c", "#6cc5b0", "#3ca951", "#ff8ab7"};
    const auto place = [&](double decade) { return (decade - low) / (high - low) * side; };
    std::map<std::string, std::string> dots;
    for (const Group& group : groups_of(outcomes))
        for (const Result* r : group.results) {
            if (r->unit != "cm" || !(r->theirs > 0.0) || !(r->ours > 0.0)) continue;
            const double x = std::log10(r->theirs), y = std::log10(r->ours);
            if (x < low || y < low || x > high || y > high) continue;
            dots[group.name] += fmt::format("M{:.1f} {:.1f}h0", margin + place(x), 10.0 + side - place(y));
        }
    if (dots.empty()) return "";
    std::string svg = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
        "font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
        margin + side + 230.0, side + 60.0);
    for (int decade = -3; decade <= 3; ++decade) {
        const double x = margin + place(decade), y = 10.0 + side - place(decade);
        svg += fmt::format("<path d=\"M{0:.1f} 10V{1:.1f}M{2} {3:.1f}H{4}\" stroke=\"#ddd\"/>\n", x, 10.0 + side,
                           margin, y, margin + side);
        const std::string label = fmt::format("{:g}", std::pow(10.0, decade));
        svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>\n", x, side + 27.0, label);
        svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"end\">{}</text>\n", margin - 5.0, y + 4.0,
                           label);
    }
    svg +=
        fmt::format("<path d=\"M{} {}L{} 10\" stroke=\"#888\" fill=\"none\"/>\n", margin, 10.0 + side, margin + side);
    svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">slip published [cm]</text>\n",
                       margin + 0.5 * side, side + 48.0);
    svg += fmt::format("<text transform=\"translate(14 {:.1f}) rotate(-90)\" text-anchor=\"middle\">slip by damslip "
                       "[cm]</text>\n",
                       10.0 + 0.5 * side);
    std::size_t k = 0;
    for (const auto& [name, path] : dots) {
        const char* colour = colours[k % std::size(colours)];
        svg += fmt::format("<path d=\"{}\" stroke=\"{}\" stroke-width=\"3\" stroke-linecap=\"round\" fill=\"none\"/>\n",
                           path, colour);
        svg += fmt::format("<circle cx=\"{0:.1f}\" cy=\"{1:.1f}\" r=\"4\" fill=\"{2}\"/><text x=\"{3:.1f}\" "
                           "y=\"{4:.1f}\">{5}</text>\n",
                           margin + side + 18.0, 24.0 + 18.0 * static_cast<double>(k), colour, margin + side + 28.0,
                           28.0 + 18.0 * static_cast<double>(k), name);
        ++k;
    }
    return svg + "</svg>\n";
}

} // namespace damslip::pages
