#include "pages/accuracy/accuracy_pages.hpp"

#include "analysis/accuracy/hierarchy.hpp"
#include "core/status.hpp"
#include "core/units.hpp"
#include "core/version.hpp"
#include "pages/report/table_text.hpp"
#include "pages/scene/scene_pages.hpp"
#include "scene/write.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <ranges>

namespace damslip::pages {

namespace {

using units::mm;

/// Of the list; empty for a model level that was skipped, and for a regression, which gives an estimate and no run.
Cell status_cell(const ModelLevelResult& r)
{
    if (r.skipped || (r.done() && r.model_level.family == ModelLevelFamily::regression)) return {};
    return word(r.status);
}

struct ModelLevelRow {
    const ModelLevelResult& result;
    const ModelLevelVerdict& verdict;
    const Judgement& judgement;

    Cell of_motion(std::optional<double> MotionOutcome::*value) const
    {
        return judgement.motion < result.motions.size() ? optional_cell(result.motions[judgement.motion].*value, mm)
                                                        : Cell();
    }
    /// Of its slip from the top's, over the top's [%].
    Cell off_top_percent() const
    {
        if (!result.done() || !judgement.top || !verdict.off_top) return {};
        const double top = std::abs(result.slip(judgement.motion) - *verdict.off_top);
        return top >= least_slip ? Cell(100.0 * *verdict.off_top / top) : Cell();
    }
};

std::vector<ColumnOf<ModelLevelRow>> model_level_columns()
{
    using R = ModelLevelRow;
    const auto if_done = [](auto value) {
        return [=](const R& r) { return r.result.done() ? cell_of(r.result.*value) : Cell(); };
    };
    const auto megabytes = [](const R& r) { return r.result.done() ? optional_cell(r.result.bytes, 1e6) : Cell(); };
    const auto deviation = [](const R& r) { return r.verdict.deviation ? Cell(100.0 * *r.verdict.deviation) : Cell(); };
    return {
        {in_brief({"rung", "model level"}), [](const R& r) { return model_level_id(r.result.model_level); }},
        {in_brief({"slip_mm", "slip", "mm", 5}), [](const R& r) { return r.of_motion(&MotionOutcome::slip); }},
        {{"slip_16_mm", "16 %", "mm", 3}, [](const R& r) { return r.of_motion(&MotionOutcome::low); }},
        {{"slip_84_mm", "84 %", "mm", 3}, [](const R& r) { return r.of_motion(&MotionOutcome::high); }},
        {in_brief({"error_mm", "± steps, mesh", "mm", 2}), [](const R& r) { return r.verdict.error; }, mm},
        {{"model_difference_mm", "model − top's", "mm", 3}, [](const R& r) { return r.verdict.model_difference; }, mm},
        {{"off_top_mm", "slip − top's", "mm", 3}, [](const R& r) { return r.verdict.off_top; }, mm},
        {{"off_top_percent", "slip − top's", "%", 3}, &R::off_top_percent},
        {in_brief({"deviation_percent", "deviation", "%", 3}), deviation},
        {{"front", "front"}, [](const R& r) { return r.verdict.front ? Cell(true) : Cell(); }},
        {in_brief({"seconds", "time", "s", 3}), if_done(&ModelLevelResult::seconds)},
        {{"set_up_seconds", "set-up", "s", 2}, if_done(&ModelLevelResult::set_up_seconds)},
        {{"repeats", "runs"}, if_done(&ModelLevelResult::repeats)},
        {{"megabytes", "memory", "MB", 3}, megabytes},
        {{"unknowns", "unknowns"}, [](const R& r) { return r.result.unknowns; }},
        {{"time_step_s", "step", "s", 4}, [](const R& r) { return r.result.time_step; }},
        {{"steps", "steps"}, [](const R& r) { return r.result.steps; }},
        {in_brief({"status", "status"}), [](const R& r) { return status_cell(r.result); }},
        {{"remark", "remark"}, [](const R& r) { return (r.result.skipped ? "skipped: " : "") + r.result.remark; }}};
}

/// Those that no model level as fast beats, the finest first.
Table front_table(const std::vector<ModelLevelResult>& results, const Judgement& j)
{
    std::vector<ModelLevelRow> rows;
    for (std::size_t i = results.size(); i-- > 0;)
        if (j.model_levels[i].front) rows.push_back({results[i], j.model_levels[i], j});
    return table_of("Model levels that none as fast beats", model_level_columns(), rows);
}

/// Slip of every model level for every motion [m], for files.
Table slip_table(const std::vector<ModelLevelResult>& results, const std::vector<MotionName>& motions)
{
    struct Row {
        std::string model_level;
        MotionName motion;
        double slip; ///< [m]
    };
    std::vector<Row> rows;
    for (const ModelLevelResult& r : results)
        for (std::size_t i = 0; i < r.motions.size() && i < motions.size(); ++i)
            rows.push_back({model_level_id(r.model_level), motions[i], r.slip(i)});
    return table_of<Row>("",
                         {{{"rung", "model level"}, &Row::model_level},
                          {{"record", "record"}, [](const Row& r) { return r.motion.record; }},
                          {{"polarity", "polarity"}, [](const Row& r) { return r.motion.polarity; }},
                          {{"slip_m", "slip", "m", 6}, &Row::slip}},
                         rows);
}

/// Slips of one model level, by motion.
Table one_model_level_table(const ModelLevelResult& result, const std::vector<MotionName>& motions)
{
    using Number = std::size_t;
    return table_of<Number>(
        "Model level " + model_level_id(result.model_level),
        {{in_brief({"record", "record"}), [&](Number i) { return motions[i].record; }},
         {in_brief({"polarity", "polarity"}), [&](Number i) { return motions[i].polarity; }},
         {ranking({"slip_mm", "slip", "mm", 6}), [&](Number i) { return result.slip(i) / mm; }},
         {in_brief({"seconds", "time, all motions", "s", 3}), [&](Number) { return result.seconds; }}},
        std::views::iota(Number{0}, result.motions.size()));
}

} // namespace

Table model_level_table(const std::vector<ModelLevelResult>& results, const Judgement& j)
{
    std::vector<ModelLevelRow> rows;
    for (std::size_t i = 0; i < results.size(); ++i) rows.push_back({results[i], j.model_levels[i], j});
    Table t = table_of("Model levels", model_level_columns(), rows);
    t.notes = {
        "± steps, mesh: estimate of what steps, elements, penalty and modes leave open, from the model levels of the "
        "same "
        "model; model − top's: difference of the limits of both models.",
        "deviation: (|slip − top's| + what the top model level leaves open) over the top's slip, the worst motion; "
        "front: no "
        "model level as fast deviates less.",
        "time: processor time of all that this model level costs alone, reading and set-up included, median of the "
        "runs; "
        "memory: growth of the resident memory to its peak during the first run.",
        "dt/4: a quarter of the record's step; dt=auto: chosen by time.slip_tolerance, the default of `fe`; "
        "dt=adaptive: the same with time.stepping = \"adaptive\"; 2h, h/2: "
        "elements of twice and half the scene's size; q8: quadratic elements of the size before it; stick: penalty in "
        "N/m³."};
    if (j.top && results[*j.top].motions.size() > 1)
        t.notes.push_back("slips and millimetres: of the record and polarity that slide the top model level furthest.");
    return t;
}

Table model_table(const std::vector<ModelLevelResult>& results, const Judgement& j)
{
    using M = ModelLimit;
    double reference = 0.0; // of the limits: the top's own, or its slip
    if (j.top) {
        reference = results[*j.top].slip(j.motion);
        const std::string top = model_of(results[*j.top].model_level);
        for (const M& m : j.models)
            if (m.model == top) reference = m.slip[j.motion];
    }
    const auto off_top = [&](const M& m) {
        return std::abs(reference) >= least_slip ? Cell(100.0 * (m.slip[j.motion] - reference) / std::abs(reference))
                                                 : Cell();
    };
    Table t =
        table_of<M>("Models and their limits",
                    {{in_brief({"model", "model"}), &M::model},
                     {in_brief({"limit_mm", "limit", "mm", 5}), [&](const M& m) { return m.slip[j.motion] / mm; }},
                     {in_brief({"open_mm", "± open", "mm", 2}), [&](const M& m) { return m.open[j.motion] / mm; }},
                     {in_brief({"off_top_percent", "model − top's", "%", 3}), off_top},
                     {{"order_step", "order in step", "", 3}, &M::order_step},
                     {{"order_mesh", "in mesh", "", 3}, &M::order_mesh},
                     {{"order_penalty", "in 1/penalty", "", 3}, &M::order_penalty},
                     {{"order_modes", "in 1/modes", "", 3}, &M::order_modes}},
                    j.top ? j.models : std::vector<M>{});
    if (!j.top) return t;
    t.notes.push_back("limit: step and element size to zero, by Richardson's extrapolation with the observed order "
                      "(held between 1 and 2); the rigid block is located exactly. Orders are those the last three "
                      "model levels show.");
    for (const M& m : j.models)
        if (!m.mesh_known && m.model.starts_with("fe-"))
            t.notes.push_back(m.model + ": the limit is that of the scene's mesh, no other mesh was run.");
    return t;
}

bool all_fail_statically(const std::vector<ModelLevelResult>& results)
{
    bool any = false;
    for (const ModelLevelResult& r : results) {
        if (!r.ran()) continue;
        if (r.done() || !fails_statically(r.status)) return false;
        any = true;
    }
    return any;
}

namespace {

std::string standing_sentence(const std::vector<ModelLevelResult>& results)
{
    StatusCount count;
    for (const ModelLevelResult& r : results)
        if (r.ran()) count.add(r.status);
    return "The dam does not stand without an earthquake, by every model level that ran: " + count.words() + ".";
}

} // namespace

std::string choice_sentence(const std::vector<ModelLevelResult>& results, const Judgement& j, double tolerance)
{
    if (all_fail_statically(results)) return standing_sentence(results);
    if (!j.top) return "No model level has a slip to compare.";
    const ModelLevelResult& top = results[*j.top];
    if (j.contradiction)
        return fmt::format("No model level can be named: {}, finer than the others, has no final slip: {}. {}",
                           model_level_id(results[*j.contradiction].model_level),
                           word(results[*j.contradiction].status), results[*j.contradiction].remark);
    if (!j.top_error)
        return fmt::format(
            "Nothing says how far the finest model level, {}, is from its limit: more steps are needed. Let it run to "
            "its end, with a larger --budget where that ended it.",
            model_level_id(top.model_level));
    if (!j.choice)
        return fmt::format("No model level is within {:.3g} %: the finest one, {}, itself leaves {:.2g} % open.",
                           100.0 * tolerance, model_level_id(top.model_level), 100.0 * *j.top_error);
    const ModelLevelResult& r = results[*j.choice];
    return fmt::format(
        "Cheapest model level within {:.3g} %: {}, slip {:.4g} mm in {:.2g} s, {:.2g} % from the finest ({}, {:.2g} "
        "s).",
        100.0 * tolerance, model_level_id(r.model_level), r.slip(j.motion) / mm, r.seconds,
        100.0 * *j.model_levels[*j.choice].deviation, model_level_id(top.model_level), top.seconds);
}

namespace {

/// Error of model levels over a size (step, element), a curve for each model; x ascending.
Chart convergence_chart(const AccuracyReportInput& in, const std::string& title, const Axis& x,
                        std::vector<const ModelLevelResult*> (*model_levels)(const std::vector<ModelLevelResult>&, ModelLevelWater),
                        double (*size)(const ModelLevelResult&))
{
    Chart chart{title, x, {"estimated error of the slip", "mm", Scale::log}};
    for (const ModelLevelWater water : {ModelLevelWater::dry, ModelLevelWater::hydrostatic, ModelLevelWater::added_mass, ModelLevelWater::acoustic}) {
        std::vector<const ModelLevelResult*> row = model_levels(in.results, water);
        if (row.size() < 2) continue;
        std::ranges::reverse(row);
        Curve curve{.name = model_of(row.front()->model_level), .mark = Mark::line_and_points};
        for (const ModelLevelResult* r : row)
            if (const auto& error = in.judgement.model_levels[static_cast<std::size_t>(r - in.results.data())].error)
                curve.add(size(*r), *error / mm);
        if (curve.x.size() > 1) chart.curves.push_back(std::move(curve));
    }
    return chart;
}

/// The figure once more, to zoom and read values.
Chart cost_chart(const AccuracyReportInput& in)
{
    Chart chart{"The same to zoom into: deviation of every model level over its time",
                {"time of this model level alone", "s", Scale::log},
                {"deviation from the finest model level", "%", Scale::log}};
    chart.horizontal.push_back({100.0 * in.tolerance, fmt::format("tolerance {:.3g} %", 100.0 * in.tolerance)});
    for (const ModelLevelKind kind : {ModelLevelKind::regression, ModelLevelKind::rigid, ModelLevelKind::reduced, ModelLevelKind::finite_elements,
                                ModelLevelKind::variant, ModelLevelKind::acoustic, ModelLevelKind::quadratic, ModelLevelKind::other_rock}) {
        std::vector<std::pair<double, double>> points;
        for (std::size_t i = 0; i < in.results.size(); ++i)
            if (const auto& deviation = in.judgement.model_levels[i].deviation;
                deviation && kind_of(in.results[i].model_level) == kind)
                points.emplace_back(in.results[i].seconds, 100.0 * *deviation);
        if (points.empty()) continue;
        std::ranges::sort(points);
        Curve curve{.name = kind_name(kind, in.results), .mark = Mark::points, .colour = static_cast<int>(kind)};
        for (const auto& [x, y] : points)
            if (curve.x.empty() || x > curve.x.back()) curve.add(x, y); // of equal times the smaller deviation
        chart.curves.push_back(std::move(curve));
    }
    return chart;
}

Headline headline(const AccuracyReportInput& in)
{
    const std::string sentence = choice_sentence(in.results, in.judgement, in.tolerance);
    if (all_fail_statically(in.results)) return {sentence, Outcome::fail, "FAIL"};
    if (in.judgement.choice) return {sentence, Outcome::none, ""};
    return {sentence, Outcome::unresolved, "No model level within the tolerance."};
}

std::vector<std::pair<std::string, std::string>> key_figures(const AccuracyReportInput& in)
{
    std::vector<std::pair<std::string, std::string>> list;
    const Judgement& j = in.judgement;
    if (!j.top) return list;
    const ModelLevelResult& top = in.results[*j.top];
    list.emplace_back("Slip of the finest model level",
                      fmt::format("{:.4g} mm ({})", top.slip(j.motion) / mm, in.motions()[j.motion].label()));
    list.emplace_back("Finest model level", model_level_id(top.model_level));
    if (j.top_error) list.emplace_back("It leaves open", fmt::format("{:.2g} %", 100.0 * *j.top_error));
    list.emplace_back("It takes", fmt::format("{:.3g} s", top.seconds));
    if (j.choice) {
        list.emplace_back("Model level within the tolerance", model_level_id(in.results[*j.choice].model_level));
        list.emplace_back("It takes", fmt::format("{:.3g} s", in.results[*j.choice].seconds));
    }
    return list;
}

/// Model levels that ran, or should have, and have no slip to draw, by their status.
std::string not_drawn(const std::vector<ModelLevelResult>& results)
{
    std::string list;
    for (const ModelLevelResult& r : results)
        if (!r.done() && !r.skipped)
            list += fmt::format("{}{} ({})", list.empty() ? "" : ", ", model_level_id(r.model_level), word(r.status));
    return list.empty() ? "" : " Not drawn: " + list + ".";
}

Section cost_section(const AccuracyReportInput& in)
{
    Section section{"What accuracy costs"};
    const std::string svg =
        cost_figure(in.results, in.judgement, in.tolerance, figure_title(in.scene, in.records), FigureStyle::page);
    if (svg.empty()) {
        section.parts.push_back(Paragraph{"No model level has a deviation to draw." + not_drawn(in.results)});
        return section;
    }
    section.parts.push_back(Drawing{"Deviation over time", svg,
                                    "The line joins model levels that no model level as fast beats. Filled: on that "
                                    "line. Ring: the cheapest model level within the "
                                    "tolerance." +
                                        not_drawn(in.results)});
    if (!in.command.empty()) section.parts.push_back(Paragraph{"To run that model level alone:  " + in.command});
    section.parts.push_back(cost_chart(in));
    return section;
}

Section convergence_section(const AccuracyReportInput& in)
{
    Section section{"Convergence within each model"};
    section.parts.push_back(rows_part(model_table(in.results, in.judgement)));
    for (Chart chart :
         {convergence_chart(in, "Error over the time step", {"time step", "ms", Scale::log}, step_row,
                            [](const ModelLevelResult& r) { return 1e3 * r.time_step.value_or(0.0); }),
          convergence_chart(in, "Error over the element size", {"element size over the scene's", "–", Scale::log},
                            mesh_column, [](const ModelLevelResult& r) { return r.model_level.mesh; })})
        if (!chart.curves.empty()) section.parts.push_back(std::move(chart));
    return section;
}

} // namespace

std::string figure_title(const Scene& scene, const std::vector<RecordPair>& records)
{
    std::string title = scene.title.empty() ? scene.file.filename().string() : scene.title;
    title +=
        records.size() == 1 ? ", " + records.front().files.name : fmt::format(", worst of {} records", records.size());
    return title + ", " + polarity_words(polarities_of(scene));
}

Page accuracy_page(const AccuracyReportInput& in)
{
    Page page = begin_page(
        in.scene, "What accuracy costs: the hierarchy of models from regressions to the finest finite elements. ");
    page.headline = headline(in);
    page.key_figures = key_figures(in);
    page.warnings = in.messages;
    for (std::string& w : record_warnings(in.records)) page.warnings.push_back(std::move(w));
    page.sections.push_back(cost_section(in));
    page.sections.push_back({"Model levels", {rows_part(model_level_table(in.results, in.judgement))}});
    page.sections.push_back(convergence_section(in));
    page.sections.push_back(limits_section(in.scene, Method::finite_elements));
    end_page(in.scene, in.records, page, {{"seconds", "processor time on the machine of this report, one thread"}});
    return page;
}

// The hierarchy as object, text and CSV.

Answer accuracy_answer(const AccuracyReportInput& in)
{
    const Judgement& judged = in.judgement;
    Answer all(json_header("accuracy", in.scene));
    all += in.scene.title + "\n\n";
    auto records = nlohmann::ordered_json::array();
    for (const RecordPair& pair : in.records) records.push_back(pair.files.name);
    all.set("records", records);
    all.set("tolerance", in.tolerance);
    nlohmann::ordered_json governs, top, top_open, choice; // null where there is none
    if (judged.top) {
        const MotionName motion = in.motions()[judged.motion];
        governs = {{"record", motion.record}, {"polarity", motion.polarity}};
        top = model_level_id(in.results[*judged.top].model_level);
    }
    if (judged.top_error) top_open = *judged.top_error;
    if (judged.choice) choice = {{"rung", model_level_id(in.results[*judged.choice].model_level)}, {"command", in.command}};
    all.set("governs", governs);
    all.set("top", top);
    all.set("top_open", top_open);
    all.set("choice", choice);
    all.add("rungs", model_level_table(in.results, judged));
    all.add("front", front_table(in.results, judged), {.text = false, .brief = true, .data = false});
    all.add("models", model_table(in.results, judged), {.brief = true});
    all.add("slips", slip_table(in.results, in.motions()), {.text = false});
    all += choice_sentence(in.results, judged, in.tolerance) + "\n";
    all.headline_in_brief(headline(in));
    if (!in.command.empty()) all += "  " + in.command + "\n";
    all.next(in.command);
    all.notes("messages", in.messages);
    return all;
}

std::string accuracy_csv(const Scene& scene, const std::vector<ModelLevelResult>& results, const Judgement& judgement)
{
    return csv(model_level_table(results, judgement),
               {"damslip " + program_version() + " accuracy", "scene " + scene_hash(scene)});
}

Answer one_model_level_answer(const ModelLevelResult& result, const std::vector<MotionName>& motions)
{
    Answer answer(json_header("accuracy"));
    answer.set("rung", model_level_id(result.model_level));
    answer.add("runs", one_model_level_table(result, motions), {.brief = true});
    answer += "status: " + word(result.status) + "\n";
    answer.set("status", word(result.status));
    answer.set("remark", result.remark);
    answer.headline_in_brief({result.done()
                                  ? fmt::format("Model level {}: slip {:.4g} mm at most.",
                                                model_level_id(result.model_level), result.largest_slip() / mm)
                                  : "Model level " + model_level_id(result.model_level) + " has no slip.",
                              Outcome::none, word(result.status)});
    if (!result.remark.empty()) answer.note(result.remark);
    return answer;
}

} // namespace damslip::pages
