#include "pages/fe/tied_report.hpp"

#include "core/units.hpp"
#include "pages/scene/open_records.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <functional>

namespace damslip::pages {

namespace {

using units::mm;

/// One line of a chart: a name and how it is read from a row.
struct Line {
    const char* name;
    std::function<double(const fe2d::HistoryRow&)> value; ///< in the chart's unit
};

Chart history_chart(const TiedRun& run, const std::string& together, std::size_t records, const char* title,
                    const char* label, const char* unit, const std::vector<Line>& lines)
{
    Chart chart;
    chart.title = run.record + ": " + title;
    chart.x = {"time", "s", Scale::linear, 0.1, {}, {}, {}};
    chart.y = {label, unit, Scale::linear, 0.1, {}, {}, {}};
    chart.height = 280;
    chart.together = together;
    std::vector<double> time;
    for (const fe2d::HistoryRow& row : run.history.rows) time.push_back(row.time);
    for (const Line& line : lines) {
        Curve curve{line.name, time, {}, {}, {}, Mark::line, Weight::normal, -1};
        for (const fe2d::HistoryRow& row : run.history.rows) curve.y.push_back(line.value(row));
        chart.curves.push_back(std::move(curve));
    }
    chart.thin_above = std::clamp<std::size_t>(16000 / std::max<std::size_t>(records, 1), 800, 4200);
    chart.thin_buckets = chart.thin_above / (2 * chart.curves.size());
    return chart;
}

std::vector<Chart> history_charts(const TiedRun& run, std::size_t number, std::size_t records)
{
    using Row = fe2d::HistoryRow;
    const std::string together = fmt::format("record{}", number);
    const auto chart = [&](const char* title, const char* label, const char* unit, const std::vector<Line>& lines) {
        return history_chart(run, together, records, title, label, unit, lines);
    };
    const Row start = run.history.rows.front();
    std::vector<Line> ground{{"horizontal, upstream", [](const Row& r) { return r.ground_accel_h; }}};
    if (std::any_of(run.history.rows.begin(), run.history.rows.end(),
                    [](const Row& r) { return r.ground_accel_v != 0.0; }))
        ground.push_back({"vertical, up", [](const Row& r) { return r.ground_accel_v; }});
    std::vector<Line> forces{{"shear, downstream", [](const Row& r) { return r.base_shear / 1e6; }},
                             {"normal, without uplift", [](const Row& r) { return r.base_normal / 1e6; }}};
    if (run.history.peak_water_force > 0.0)
        forces.push_back({"water on the dam, dynamic part", [](const Row& r) { return r.water_force_x / 1e6; }});
    return {
        chart("ground acceleration", "acceleration", "m/s²", ground),
        chart("crest motion", "displacement since the start", "mm",
              {{"downstream", [start](const Row& r) { return (r.crest_x - start.crest_x) / mm; }},
               {"up", [start](const Row& r) { return (r.crest_y - start.crest_y) / mm; }}}),
        chart("crest acceleration", "acceleration, absolute", "m/s²",
              {{"downstream", [](const Row& r) { return r.crest_accel_x; }},
               {"up", [](const Row& r) { return r.crest_accel_y; }}}),
        chart("forces on the base", "force", "MN/m", forces),
        chart(
            "energy since the start of the shaking", "energy", "kJ/m",
            {{"external work", [start](const Row& r) { return (r.energy.external - start.energy.external) / 1e3; }},
             {"kinetic", [start](const Row& r) { return (r.energy.kinetic - start.energy.kinetic) / 1e3; }},
             {"strain", [start](const Row& r) { return (r.energy.strain - start.energy.strain) / 1e3; }},
             {"damping, dissipated", [start](const Row& r) { return (r.energy.damping - start.energy.damping) / 1e3; }},
             {"scheme, dissipated",
              [start](const Row& r) { return (r.energy.numerical - start.energy.numerical) / 1e3; }},
             {"radiated", [start](const Row& r) { return (r.energy.radiated - start.energy.radiated) / 1e3; }},
             {"imbalance", [](const Row& r) { return r.imbalance / 1e3; }}})};
}

Headline headline(const std::vector<TiedRun>& runs)
{
    if (runs.empty()) return {"No earthquake was run.", Outcome::none, "No answer."};
    for (const TiedRun& r : runs)
        if (r.history.status != fe2d::TiedRunStatus::complete)
            return {r.record + ": " + r.history.status_text, Outcome::unresolved, "UNRESOLVED"};
    const TiedRun& worst = *std::max_element(runs.begin(), runs.end(), [](const TiedRun& a, const TiedRun& b) {
        return a.history.peak_crest_x < b.history.peak_crest_x;
    });
    return {
        fmt::format(
            "On a base that is bonded to the rock the crest moves {:.4g} mm at most against the ground (record {}), "
            "with a base shear of up to {:.4g} MN/m.",
            worst.history.peak_crest_x / mm, worst.record, worst.history.peak_base_shear / 1e6),
        Outcome::none, "A bonded base has no slip to judge."};
}

} // namespace

Page tied_page(const FePageFrame& frame, const std::vector<TiedRun>& runs, const Table& stages, const Table& table)
{
    Page page = begin_fe_page(frame);
    page.headline = headline(runs);
    page.sections.push_back({"Runs", {TablePart{without_seconds(table), Layout::rows, 1, Fold::open}}, Fold::open});
    page.sections.push_back({"Static stages", {TablePart{stages, Layout::rows, 1, Fold::open}}, Fold::open});
    std::vector<GroundMotion> motions;
    for (const TiedRun& r : runs) {
        motions.push_back(r.motion);
        Section section{"Record " + r.record, {}, motions.size() <= open_records ? Fold::open : Fold::folded};
        for (const std::string& note : r.notes) section.parts.push_back(Paragraph{note});
        if (r.history.rows.size() > 1)
            for (Chart& chart : history_charts(r, motions.size(), runs.size()))
                section.parts.emplace_back(std::move(chart));
        page.sections.push_back(std::move(section));
    }
    end_fe_page(frame, motions, {}, page);
    return page;
}

} // namespace damslip::pages
