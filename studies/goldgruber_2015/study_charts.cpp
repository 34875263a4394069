#include "studies/goldgruber_2015/study_charts.hpp"

#include "pages/sweep/sweep_pages.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace damslip::study {

using namespace pages;

namespace {

using pages::Curve;
using pages::Mark;
using pages::Scale;
using pages::Weight;

pages::Chart history_chart(std::string title)
{
    pages::Chart chart;
    chart.title = std::move(title);
    chart.x = {"time", "s"};
    chart.y = {"slip", "mm", Scale::asinh, 1.0};
    return chart;
}

/// Histories of all frictions of one case, a colour each.
void add_histories(pages::Chart& chart, const StudyRows& rows, StudyCase at, const std::string& name, Mark mark)
{
    for (std::size_t i = 0; i < chapter_4::frictions.size(); ++i) {
        at.friction = chapter_4::frictions[i];
        const SlipHistory* history = rows.history(at);
        if (!history) continue;
        Curve curve = history_curve(fmt::format("μ = {:.2f}{}", at.friction, name), *history);
        curve.mark = mark;
        curve.colour = static_cast<int>(i);
        chart.curves.push_back(std::move(curve));
    }
}

std::string missing_frictions(const StudyRows& rows, StudyCase at)
{
    std::string list;
    for (const double friction : chapter_4::frictions) {
        at.friction = friction;
        if (rows.fails_statically(at)) list += fmt::format("{}{:.2f}", list.empty() ? "" : ", ", friction);
    }
    if (list.empty()) return "";
    return fmt::format(" At μ = {} the dam slides without an earthquake: it stands from μ = {:.4g} on.", list,
                       rows.critical_friction(at));
}

} // namespace

pages::Chart block_histories(const StudyRows& rows, const std::string& uplift)
{
    pages::Chart chart = history_chart(fmt::format("Slip of the rigid block, uplift {}", uplift));
    StudyCase at{uplift, "westergaard-simplified", 1.0, 1.0, "rigid"};
    add_histories(chart, rows, at, "", Mark::line);
    at.method = "rigid-v";
    add_histories(chart, rows, at, ", with vertical", Mark::dashed);
    chart.note = "Solid: horizontal motion; dashed: with the vertical one." + missing_frictions(rows, at);
    return chart;
}

pages::Chart fe_histories(const StudyRows& rows, const std::string& uplift, double size, const std::string& method)
{
    pages::Chart chart = history_chart(
        fmt::format("Slip by {}, {} m, uplift {}", method, size * rows.grid().axes.level.front(), uplift));
    StudyCase at{uplift, "acoustic", size, 1.0, method};
    add_histories(chart, rows, at, ", acoustic", Mark::line);
    at.water = "westergaard";
    add_histories(chart, rows, at, ", Westergaard", Mark::dashed);
    chart.note = "Solid: acoustic elements; dashed: rigorous Westergaard." + missing_frictions(rows, at);
    return chart;
}

pages::Chart over_friction(const StudyRows& rows, const std::string& title, const std::vector<FrictionCurve>& curves)
{
    pages::Chart chart;
    chart.title = title;
    chart.x = {"friction μ", ""};
    chart.y = {"largest slip", "mm", Scale::asinh, 1.0};
    std::vector<double> frictions = chapter_4::frictions;
    std::reverse(frictions.begin(), frictions.end());
    std::vector<double> marked;
    for (const FrictionCurve& c : curves) {
        if (!rows.has(c.at.method)) continue;
        Curve curve{c.name, frictions, rows.slips(c.at), {}, {}, c.mark, Weight::normal, c.colour};
        std::reverse(curve.y.begin(), curve.y.end());
        if (std::none_of(curve.y.begin(), curve.y.end(), [](double v) { return std::isfinite(v); })) continue;
        chart.curves.push_back(std::move(curve));
        const double critical = rows.critical_friction({c.at.uplift, c.at.water, c.at.size, 1.0, c.at.method});
        const auto same = [critical](double other) { return std::abs(other - critical) < 1e-6; };
        if (critical > frictions.front() && std::none_of(marked.begin(), marked.end(), same)) {
            marked.push_back(critical);
            chart.vertical.push_back(
                {critical, fmt::format("{}: slides statically below {:.4g}", c.at.uplift, critical)});
        }
    }
    return chart;
}

} // namespace damslip::study
