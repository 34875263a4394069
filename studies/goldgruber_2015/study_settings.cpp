#include "studies/goldgruber_2015/study_settings.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <numeric>

namespace damslip::study {

using namespace pages;

namespace {

struct Change {
    const char* name;
    std::function<void(Scene&)> apply;
};

/// In the order of the physics: water, joint, time integration, damping; the rest of the preset last.
const std::vector<Change>& changes()
{
    static const std::vector<Change> list{
        {"accurate settings, whole steps of the record", [](Scene& s) { s.time.substeps = 0; }},
        {"reservoir bottom still and fully reflecting, far end absorbing at normal incidence",
         [](Scene& s) {
             s.reservoir->bottom_motion = BottomMotion::still;
             s.reservoir->bottom_reflection = 1.0;
             s.reservoir->far_end = FarEnd::damper;
         }},
        {"the joint cannot open", [](Scene& s) { s.contact.separation = JointOpening::none; }},
        {"HHT α = −1/3 for −0.05",
         [](Scene& s) {
             s.time.scheme = TimeScheme::hht;
             s.time.alpha = -1.0 / 3.0;
         }},
        {"mass damping of the relative velocity, sliding included",
         [](Scene& s) { s.damping.mass = MassDamping::relative; }},
        {"sticking gives way by 0.005 of the element length (all of the preset)",
         [](Scene& s) { s = with_law(std::move(s), FeLaw::goldgruber_2015, {}); }}};
    return list;
}

Axes settings_axes()
{
    Axes axes;
    axes.friction = chapter_4::frictions;
    axes.uplift = {"seepage"};
    axes.reservoir = {"acoustic", "westergaard"};
    axes.size = axes.scale = {1.0};
    axes.method = {sweep_method("fe")};
    return axes;
}

} // namespace

std::vector<SettingsStep> settings_steps(const Scene& given, const Records& records, int jobs, Watch& watch)
{
    std::vector<SettingsStep> steps;
    Axes axes = settings_axes();
    axes.level = {given.reservoir->level};
    axes.polarity = {study_polarity(given)};
    const TaskList tasks = make_tasks(axes, 1);
    std::vector<std::size_t> wanted(tasks.rows());
    std::iota(wanted.begin(), wanted.end(), 0u);
    Scene scene = given;
    for (const Change& change : changes()) {
        change.apply(scene);
        const Sweep inputs{scene, axes, tasks, records, std::nullopt, std::nullopt};
        const Grid grid = make_grid(scene, axes, tasks, records, jobs);
        const SweepOutcome outcome = run_sweep(inputs, grid, wanted, nullptr, jobs, watch);
        if (!outcome.complete()) return steps;
        const StudyRows rows(grid, outcome);
        StatusCount unanswered;
        for (const FinishedRow& row : outcome.rows)
            if (!row.good) unanswered.add(status_of(row).value_or(Status::not_resolved));
        steps.push_back({change.name, rows.slips({"seepage", "acoustic", 1.0, 1.0, "fe"}),
                         rows.slips({"seepage", "westergaard", 1.0, 1.0, "fe"}), unanswered});
    }
    return steps;
}

Table settings_table(const std::vector<SettingsStep>& steps)
{
    struct Row {
        std::string change, water;
        const std::vector<double>& slips; ///< of chapter_4::frictions [mm]
    };
    std::vector<Row> rows;
    for (const SettingsStep& step : steps) {
        rows.push_back({step.change, "acoustic", step.acoustic});
        rows.push_back({step.change, "westergaard", step.westergaard});
    }
    std::vector<ColumnOf<Row>> columns{{{"change", "change"}, &Row::change}, {{"water", "water"}, &Row::water}};
    for (std::size_t i = 0; i < chapter_4::frictions.size(); ++i) {
        const double friction = chapter_4::frictions[i];
        columns.push_back({{fmt::format("slip_mm_at_{:.2f}", friction), fmt::format("μ = {:.2f}", friction), "mm", 3},
                           [i](const Row& r) { return finite_cell(r.slips[i]); }});
    }
    return table_of(
        "From the accurate settings to the source's, one after the other", columns, rows,
        {"largest slips, with curtain, size 1; each line has the changes of the lines above it too. The second "
         "changes nothing where there is no acoustic water."});
}

pages::Chart settings_chart(const std::vector<SettingsStep>& steps, const std::string& water)
{
    pages::Chart chart;
    chart.title = "Slip with the source's settings, one after the other: " + water;
    chart.x = {"friction μ", ""};
    chart.y = {"largest slip", "mm", pages::Scale::asinh, 1.0};
    std::vector<double> frictions = chapter_4::frictions;
    std::reverse(frictions.begin(), frictions.end());
    for (const SettingsStep& step : steps) {
        pages::Curve curve{(chart.curves.empty() ? "" : "+ ") + step.change,
                           frictions,
                           water == "acoustic" ? step.acoustic : step.westergaard,
                           {},
                           {},
                           pages::Mark::line_and_points,
                           pages::Weight::normal,
                           -1};
        std::reverse(curve.y.begin(), curve.y.end());
        chart.curves.push_back(std::move(curve));
    }
    return chart;
}

} // namespace damslip::study
