#include "pages/fe/fe_pages.hpp"

#include "core/file.hpp"
#include "core/units.hpp"
#include "core/version.hpp"
#include "pages/report/table_text.hpp"
#include "pages/scene/scene_pages.hpp"
#include "scene/plausible.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>

namespace damslip::pages {

namespace {

std::vector<ColumnOf<fe2d::HistoryRow>> history_columns(bool water)
{
    using Row = fe2d::HistoryRow;
    std::vector<ColumnOf<Row>> all = {
        {{"time_s", "time", "s", 6}, &Row::time},
        {{"ground_accel_h_m_s2", "ground acceleration a_h", "m/s²", 4}, &Row::ground_accel_h},
        {{"ground_accel_v_m_s2", "ground acceleration a_v", "m/s²", 4}, &Row::ground_accel_v},
        {{"crest_x_m", "crest displacement x", "m", 4}, &Row::crest_x},
        {{"crest_y_m", "crest displacement y", "m", 4}, &Row::crest_y},
        {{"crest_accel_x_m_s2", "crest acceleration x", "m/s²", 4}, &Row::crest_accel_x},
        {{"crest_accel_y_m_s2", "crest acceleration y", "m/s²", 4}, &Row::crest_accel_y},
        {{"base_shear_N_m", "base shear", "N/m", 4}, &Row::base_shear},
        {{"base_normal_N_m", "base normal force", "N/m", 4}, &Row::base_normal}};
    for (const auto& [column, value] : energy_columns())
        all.push_back(
            {{"energy_" + column.key, column.heading, column.unit}, [value](const Row& r) { return value(r.energy); }});
    all.push_back({{"energy_imbalance_J_m", "energy imbalance", "J/m", 2}, &Row::imbalance});
    if (water) all.push_back({{"water_force_x_N_m", "hydrodynamic force x", "N/m", 4}, &Row::water_force_x});
    return all;
}

using units::mm;

/// One line of a chart: a name and how it is read from a row.
struct Line {
    const char* name;
    std::function<double(const fe2d::HistoryRow&)> value; ///< in the chart's unit
};

Chart history_chart(const TiedRun& run, const std::string& together, std::size_t records, const char* title,
                    const char* label, const char* unit, const std::vector<Line>& lines)
{
    Chart chart = time_chart(run.label() + ": " + title, {label, unit}, 280);
    chart.together = together;
    for (const Line& line : lines) {
        Curve& curve = chart.curves.emplace_back(Curve{line.name});
        for (const fe2d::HistoryRow& row : run.history.rows) curve.add(row.time, line.value(row));
    }
    thin_for(chart, records, run_samples, most_run_samples);
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
    const auto since_start = [start](double Row::*value) {
        return [=](const Row& r) { return (r.*value - start.*value) / mm; };
    };
    const auto in_MN = [](double Row::*force) { return [=](const Row& r) { return r.*force / 1e6; }; };
    const auto energy = [start](double fe2d::Energy::*term) {
        return [=](const Row& r) { return (r.energy.*term - start.energy.*term) / 1e3; };
    };
    using E = fe2d::Energy;
    std::vector<Line> ground{{"horizontal, upstream", &Row::ground_accel_h}};
    if (std::ranges::any_of(
            run.history.rows, [](double a) { return a != 0.0; }, &Row::ground_accel_v))
        ground.push_back({"vertical, up", &Row::ground_accel_v});
    std::vector<Line> forces{{"shear, downstream", in_MN(&Row::base_shear)},
                             {"normal, without uplift", in_MN(&Row::base_normal)}};
    if (run.history.peak_water_force > 0.0)
        forces.push_back({"water on the dam, dynamic part", in_MN(&Row::water_force_x)});
    return {chart("ground acceleration", "acceleration", "m/s²", ground),
            chart("crest motion", "displacement since the start", "mm",
                  {{"downstream", since_start(&Row::crest_x)}, {"up", since_start(&Row::crest_y)}}),
            chart("crest acceleration", "acceleration, absolute", "m/s²",
                  {{"downstream", &Row::crest_accel_x}, {"up", &Row::crest_accel_y}}),
            chart("forces on the base", "force", "MN/m", forces),
            chart("energy since the start of the shaking", "energy", "kJ/m",
                  {{"external work", energy(&E::external)},
                   {"kinetic", energy(&E::kinetic)},
                   {"strain", energy(&E::strain)},
                   {"damping, dissipated", energy(&E::damping)},
                   {"scheme, dissipated", energy(&E::numerical)},
                   {"radiated", energy(&E::radiated)},
                   {"imbalance", [](const Row& r) { return r.imbalance / 1e3; }}})};
}

Headline headline(const std::vector<TiedRun>& runs)
{
    if (runs.empty()) return {"No earthquake was run.", Outcome::none, "No answer."};
    for (const TiedRun& r : runs)
        if (r.history.status != fe2d::TiedRunStatus::complete)
            return {r.label() + ": " + text_of(r.history.ending), Outcome::unresolved, "UNRESOLVED"};
    const TiedRun& worst = *std::ranges::max_element(runs, {}, [](const TiedRun& r) { return r.history.peak_crest_x; });
    const TiedRun& sheared = *std::ranges::max_element(runs, {}, [](const TiedRun& r) { return r.history.peak_base_shear; });
    return {
        fmt::format(
            "On a base that is bonded to the rock the crest moves {:.4g} mm at most against the ground (record {}), "
            "with a base shear of up to {:.4g} MN/m{}{}.",
            worst.history.peak_crest_x / mm, worst.label(), sheared.history.peak_base_shear / 1e6,
            &sheared == &worst ? "" : " (record " + sheared.label() + ")",
            worst.both ? "" : fmt::format(", polarity {:+d} alone", worst.polarity)),
        Outcome::none, "A bonded base has no slip to judge."};
}

Table stage_table(const fe2d::Model& model, const fe2d::StaticSolution& statics)
{
    struct Row {
        const fe2d::StaticStage& stage;
        Eigen::Vector2d crest; ///< [m]
    };
    std::vector<Row> rows;
    for (const fe2d::StaticStage& s : statics.stages) rows.push_back({s, crest_displacement(model, s.displacement)});
    return table_of<Row>(
        "Static stages",
        {{{"stage", "stage"}, [](const Row& r) { return r.stage.name; }},
         {{"force_x_kN_m", "sum Fx", "kN/m", 6}, [](const Row& r) { return r.stage.resultant.x() / 1e3; }},
         {{"force_y_kN_m", "sum Fy", "kN/m", 6}, [](const Row& r) { return r.stage.resultant.y() / 1e3; }},
         {{"crest_x_mm", "crest x", "mm", 5}, [](const Row& r) { return 1e3 * r.crest.x(); }},
         {{"crest_y_mm", "crest y", "mm", 5}, [](const Row& r) { return 1e3 * r.crest.y(); }}},
        rows, {"forces: x downstream, y up; crest: its upstream end, relative to the zero state of stages.geostatic."});
}

/// Energy that left through the boundaries of water and rock over the largest energy of the run; empty where there are none.
Cell radiated_share(const fe2d::History& history)
{
    if (history.rows.empty() || history.energy_scale == 0.0) return {};
    const double radiated = history.rows.back().energy.radiated;
    if (history.peak_water_force == 0.0 && radiated == 0.0) return {};
    return radiated / history.energy_scale;
}

Table run_table(const std::vector<TiedRun>& runs, bool with_seconds)
{
    using R = TiedRun;
    const auto status = [](const R& r) {
        return r.history.status == fe2d::TiedRunStatus::complete ? std::string("complete") : text_of(r.history.ending);
    };
    std::vector<ColumnOf<R>> columns{
        {in_brief({"record", "record"}), &R::record},
        {in_brief({"polarity", "polarity"}), &R::polarity},
        {in_brief({"status", "status"}), status},
        {{"method", "method"}, [](const R& r) { return r.history.method; }},
        {{"steps", "steps"}, [](const R& r) { return r.history.steps; }},
        {{"dt_s", "step", "s", 4}, [](const R& r) { return r.history.time_step; }},
        {ranking({"peak_crest_x_mm", "peak crest x", "mm", 5}),
         [](const R& r) { return 1e3 * r.history.peak_crest_x; }},
        {in_brief({"peak_crest_accel_x_m_s2", "peak crest a_x", "m/s²", 5}),
         [](const R& r) { return r.history.peak_crest_accel_x; }},
        {in_brief({"peak_base_shear_kN_m", "peak base shear", "kN/m", 5}),
         [](const R& r) { return r.history.peak_base_shear / 1e3; }},
        {{"radiated_share", "radiated", "–", 3}, [](const R& r) { return radiated_share(r.history); }},
        {in_brief({"energy_imbalance", "energy imbalance", "–", 2}),
         [](const R& r) { return r.history.largest_imbalance; }},
        {{"factorisations", "factorisations"}, [](const R& r) { return r.history.factorisations; }}};
    if (with_seconds) columns.push_back({{"seconds", "time", "s", 3}, &R::seconds});
    return table_of<R>(
        "Earthquake runs, tied base", columns, runs,
        {"crest x relative to the ground, from the static state; accelerations absolute; energy imbalance over the "
         "largest energy of the run."});
}

} // namespace

FePageFrame tied_frame(const Scene& scene, const EffectPlan& plan, const std::vector<RecordPair>& records,
                       const fe2d::Model& model, const fe2d::FluidModel* water)
{
    return {.scene = scene,
            .plan = plan,
            .records = records,
            .model = model,
            .water = water,
            .kind = "finite elements, base bonded to the rock",
            .method = fmt::format("plane-strain finite elements, {} unknowns, base bonded", model.dofs.count),
            .slides = false};
}

void write_tied_history(const std::filesystem::path& folder, const Scene& scene, const std::string& hash,
                           const TiedRun& run)
{
    write_file(folder / (run_file("history", scene, run.record, run.suffix()) + ".csv"),
               csv(table_of("", history_columns(run.history.peak_water_force > 0.0), run.history.rows),
                   {"damslip " + program_version() + " fe --base tied", "scene " + hash, "record " + run.label()}));
}

Answer tied_answer(const FePageFrame& frame, const fe2d::StaticSolution& statics, const std::vector<TiedRun>& runs)
{
    Answer answer = begin_fe_answer(frame);
    answer.add("stages", stage_table(frame.model, statics));
    answer.add("runs", run_table(runs, true), {.brief = true});
    nlohmann::ordered_json notes;
    for (const TiedRun& r : runs) notes[r.label()] = r.notes;
    answer.set("notes", notes);
    const Headline found = headline(runs);
    answer.headline(found);
    answer.set("headline", found.sentence);
    answer.set("verdict", word(found.outcome == Outcome::unresolved ? Verdict::undecided : Verdict::none));
    answer.notes("messages", note_texts(frame.scene.notes));
    std::set<std::string> said; // once for both polarities
    for (const TiedRun& r : runs)
        for (const std::string& note : r.notes)
            if (said.insert(r.record + ": " + note).second) answer.note(r.record + ": " + note);
    return answer;
}

Page tied_page(const FePageFrame& frame, const fe2d::StaticSolution& statics, const std::vector<TiedRun>& runs)
{
    Page page = begin_fe_page(frame);
    page.headline = headline(runs);
    page.sections.push_back({"Runs", {rows_part(run_table(runs, false))}});
    page.sections.push_back({"Static stages", {rows_part(stage_table(frame.model, statics))}});
    std::vector<GroundMotion> motions;
    std::size_t number = 0;
    for (const TiedRun& r : runs) {
        if (motions.empty() || motions.back().name != r.motion.name) motions.push_back(r.motion); // once for both polarities
        ++number;
        Section section{"Record " + r.label(), {}, number <= open_records ? Fold::open : Fold::folded};
        for (const std::string& note : r.notes) section.parts.push_back(Paragraph{note});
        if (r.history.rows.size() > 1)
            for (Chart& chart : history_charts(r, number, runs.size()))
                section.parts.emplace_back(std::move(chart));
        page.sections.push_back(std::move(section));
    }
    end_fe_page(frame, motions, {}, page);
    const std::vector<std::string> messages = note_texts(frame.scene.notes);
    page.warnings.insert(page.warnings.begin(), messages.begin(), messages.end());
    return page;
}

} // namespace damslip::pages
