#include "pages/accuracy/accuracy_pages.hpp"

#include "analysis/accuracy/hierarchy.hpp"
#include "core/units.hpp"
#include "core/version.hpp"
#include "pages/report/table_text.hpp"
#include "pages/scene/scene_pages.hpp"
#include "scene/write.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <numeric>

namespace damslip::pages {

namespace {

/// Error of model levels over a size (step, element), a curve for each model; x ascending.
Chart convergence_chart(const AccuracyReportInput& in, const std::string& title, const Axis& x,
                        std::vector<const ModelLevelResult*> (*model_levels)(const std::vector<ModelLevelResult>&, ModelLevelWater),
                        double (*size)(const ModelLevelResult&))
{
    Chart chart;
    chart.title = title;
    chart.x = x;
    chart.y = {"estimated error of the slip", "mm", Scale::log};
    for (const ModelLevelWater water : {ModelLevelWater::dry, ModelLevelWater::hydrostatic, ModelLevelWater::added_mass, ModelLevelWater::acoustic}) {
        std::vector<const ModelLevelResult*> row = model_levels(in.results, water);
        if (row.size() < 2) continue;
        std::reverse(row.begin(), row.end());
        Curve curve;
        curve.name = model_of(row.front()->model_level);
        curve.mark = Mark::line_and_points;
        for (const ModelLevelResult* r : row) {
            const auto& error = in.judgement.model_levels[static_cast<std::size_t>(r - in.results.data())].error;
            if (!error) continue;
            curve.x.push_back(size(*r));
            curve.y.push_back(*error / units::mm);
        }
        if (curve.x.size() > 1) chart.curves.push_back(std::move(curve));
    }
    return chart;
}

/// The figure once more, to zoom and read values.
Chart cost_chart(const AccuracyReportInput& in)
{
    Chart chart;
    chart.title = "The same to zoom into: deviation of every model level over its time";
    chart.x = {"time of this model level alone", "s", Scale::log};
    chart.y = {"deviation from the finest model level", "%", Scale::log};
    chart.horizontal.push_back({100.0 * in.tolerance, fmt::format("tolerance {:.3g} %", 100.0 * in.tolerance)});
    for (const ModelLevelKind kind : {ModelLevelKind::regression, ModelLevelKind::rigid, ModelLevelKind::reduced, ModelLevelKind::finite_elements,
                                ModelLevelKind::variant, ModelLevelKind::acoustic, ModelLevelKind::quadratic, ModelLevelKind::other_rock}) {
        std::vector<std::pair<double, double>> points;
        for (std::size_t i = 0; i < in.results.size(); ++i)
            if (const auto& deviation = in.judgement.model_levels[i].deviation;
                deviation && kind_of(in.results[i].model_level) == kind)
                points.emplace_back(in.results[i].seconds, 100.0 * *deviation);
        if (points.empty()) continue;
        std::sort(points.begin(), points.end());
        Curve curve;
        curve.name = kind_name(kind, in.results);
        curve.mark = Mark::points;
        curve.colour = static_cast<int>(kind);
        for (const auto& [x, y] : points) {
            if (!curve.x.empty() && x <= curve.x.back()) continue; // of equal times the smaller deviation
            curve.x.push_back(x);
            curve.y.push_back(y);
        }
        chart.curves.push_back(std::move(curve));
    }
    return chart;
}

double step_size(const ModelLevelResult& r)
{
    return 1e3 * r.time_step.value_or(0.0);
}
double element_factor(const ModelLevelResult& r)
{
    return r.model_level.mesh;
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
                      fmt::format("{:.4g} mm ({})", top.slip(j.motion) / units::mm, in.motions()[j.motion].label()));
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
    Section section{"What accuracy costs", {}, Fold::open};
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
    Section section{"Convergence within each model", {}, Fold::open};
    section.parts.push_back(rows_part(model_table(in.results, in.judgement)));
    for (Chart chart :
         {convergence_chart(in, "Error over the time step", {"time step", "ms", Scale::log}, step_row, step_size),
          convergence_chart(in, "Error over the element size", {"element size over the scene's", "–", Scale::log},
                            mesh_column, element_factor)})
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
    page.sections.push_back({"Model levels", {rows_part(model_level_table(in.results, in.judgement))}, Fold::open});
    page.sections.push_back(convergence_section(in));
    page.sections.push_back(limits_section(in.scene, Method::finite_elements));
    page.sections.push_back({"Scene", {scene_listing(in.scene)}, Fold::open});
    page.provenance = scene_provenance(in.scene);
    page.provenance.emplace_back("seconds", "processor time on the machine of this report, one thread");
    add_record_provenance(in.records, page.provenance);
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
    all.set("messages", in.messages);
    for (const std::string& message : in.messages) all.note(message);
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
    answer.headline_in_brief({result.done() ? fmt::format("Model level {}: slip {:.4g} mm at most.",
                                                          model_level_id(result.model_level), result.largest_slip() / units::mm)
                                            : "Model level " + model_level_id(result.model_level) + " has no slip.",
                              Outcome::none, word(result.status)});
    if (!result.remark.empty()) answer.note(result.remark);
    return answer;
}

} // namespace damslip::pages
