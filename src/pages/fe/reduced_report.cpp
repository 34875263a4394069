#include "pages/fe/fe_pages.hpp"

#include "core/version.hpp"
#include "core/file.hpp"
#include "pages/report/table_text.hpp"
#include "pages/scene/scene_pages.hpp"
#include "scene/plausible.hpp"
#include "scene/write.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <ranges>

namespace damslip::pages {

namespace {

Table reduced_table(const std::vector<ReducedRecord>& runs, const std::optional<double>& allowable)
{
    struct Row {
        const fe2d::ReducedResult& reduced;
        ContactRun run; ///< in the form of a full one
    };
    std::vector<Row> rows;
    for (const ReducedRecord& r : runs) rows.push_back({r.result, as_contact_run(r)});
    const auto shared = [full = contact_run_columns(allowable)](std::string_view key) {
        const auto at =
            std::find_if(full.begin(), full.end(), [=](const ContactColumn& c) { return c.column.key == key; });
        return ColumnOf<Row>{at->column, [value = at->value](const Row& r) { return value(r.run); }};
    };
    Table t = table_of<Row>(
        "Earthquake runs, reduced, exact contact",
        {shared("record"),
         shared("polarity"),
         shared("status"),
         shared("slip_mm"),
         {{"truncation_error_mm", "± modes", "mm", 2},
          [](const Row& r) { return slip_cell(r.run, r.reduced.truncation_error); }},
         {{"slip_error_mm", "± step", "mm", 2}, [](const Row& r) { return slip_cell(r.run, r.reduced.step_error); }},
         shared("mesh_error_mm"),
         shared("total_error_mm"),
         shared("error_parts"),
         shared("max_slip_m"),
         shared("verdict"),
         {{"modes", "modes"}, [](const Row& r) { return r.reduced.modes; }},
         {{"highest_frequency_Hz", "up to", "Hz", 4}, [](const Row& r) { return r.reduced.highest_frequency; }},
         shared("steps"),
         shared("dt_s"),
         shared("unresolved"),
         shared("seconds"),
         shared("walked_at_least_m")},
        rows);
    t.notes.push_back(
        "slip: area mean over the base since the static state, positive downstream; ± modes: what the elastic modes "
        "left out change (estimate), ± step: what the time step leaves open; ± mesh: change against elements of twice "
        "the size.");
    for (std::string& note : error_notes(as_contact_runs(runs))) t.notes.push_back(std::move(note));
    t.notes.push_back("polarity -1: the record's horizontal component is flipped.");
    t.notes.push_back("time without the shared set-up of model and modes.");
    return t;
}

Table history_table(const fe2d::ReducedHistory& h)
{
    const auto of = [](const std::vector<double>& values) {
        return [&values](std::size_t row) { return values[row]; };
    };
    std::vector<ColumnOf<std::size_t>> columns{{{"time_s", "time", "s", 6}, of(h.time)},
                                               {{"slip_m", "slip", "m", 6}, of(h.slip)},
                                               {{"crest_x_m", "crest x", "m", 6}, of(h.crest_x)},
                                               {{"normal_force_N_m", "N'", "N/m", 6}, of(h.normal_force)},
                                               {{"shear_force_N_m", "T", "N/m", 6}, of(h.shear_force)}};
    for (ColumnOf<std::size_t>& column : slide_columns(h.slide)) columns.push_back(std::move(column));
    return table_of("", columns, std::views::iota(std::size_t{0}, h.time.size()));
}

FePageFrame reduced_frame(const ReducedReportInput& in)
{
    const int modes = in.runs.empty() ? 0 : in.runs.front().result.modes;
    return {
        in.scene,
        in.plan,
        in.records,
        in.full.model(),
        nullptr,
        in.uplift,
        fmt::format("finite elements with contact on {} elastic modes of the dam", modes),
        fmt::format("plane-strain finite elements, {} unknowns, {} contact pairs, of the dam's modes {} elastic ones "
                    "and the rigid ones; static stages by the full model; rigid block for comparison",
                    in.full.model().dofs.count, in.full.structure().pairs(), modes)};
}

/// What the step's part of the error holds.
constexpr const char* error_source = "step and modes";

} // namespace

void write_reduced_history(const std::filesystem::path& folder, const Scene& scene, const std::string& hash,
                           const ReducedRecord& run)
{
    const ContactRun as_full = as_contact_run(run);
    write_file(
        folder / (run_file("history", scene, run.record, as_full.suffix()) + ".csv"),
        csv(history_table(run.result.history), {"damslip " + program_version() + " fe --reduced", "scene " + hash,
                                                "record " + as_full.label(), "status " + word(run.result.status)}));
}

std::vector<std::string> reduced_messages(const Scene& scene, const std::vector<ReducedRecord>& runs)
{
    std::vector<std::string> messages = base_notes(scene);
    add_run_messages(as_contact_runs(runs), messages);
    return messages;
}

FeAnswer reduced_answer(const ReducedReportInput& in)
{
    const std::optional<double>& allowable = in.scene.criteria.allowable_slip;
    const std::vector<ContactRun> runs = as_contact_runs(in.runs);
    const Headline headline = fe_headline(in.scene, runs, in.combinations, error_source);
    const Table stages = contact_stage_table(runs), table = reduced_table(in.runs, allowable);
    FeAnswer answer = begin_fe_answer(FeKind::reduced, reduced_frame(in));
    answer.json["contact_pairs"] = in.full.structure().plane().pairs();
    answer.json["rock"] = rock_json(in.scene, in.full);
    add_verdict(headline, runs, allowable, answer);
    answer.json["stages"] = json_of(stages);
    answer.json["runs"] = json_of(table);
    const Table run_out = run_out_table(runs);
    answer.json["run_out"] = json_of(run_out);
    Table shown = table;
    write_walked_slips(shown);
    answer.text += "  " + rock_line(in.scene, in.full) + "\n\n" + text(stages) + "\n";
    answer.text.add(shown, run_columns_in_brief, text(shown) + "\n");
    answer.text += text(run_out) + "\n";
    answer.text.headline(headline);
    add_points(in.scene, runs, answer.text);
    end_fe_answer(in.messages, answer);
    return answer;
}

Page reduced_page(const ReducedReportInput& in)
{
    const FePageFrame frame = reduced_frame(in);
    Page page = begin_fe_page(frame);
    page.warnings.insert(page.warnings.begin(), in.messages.begin(), in.messages.end());
    std::vector<ContactRun> runs;
    std::vector<GroundMotion> motions;
    std::vector<Section> sections;
    for (const ReducedRecord& r : in.runs) {
        runs.push_back(as_contact_run(r));
        if (motions.empty() || motions.back().name != r.motion.name)
            motions.push_back(r.motion); // once for both polarities
        std::optional<sliding::SlideResult> rigid;
        if (in.rigid.state == sliding::StaticState::at_rest)
            rigid = slide_model(in.scene, in.rigid, r.motion, 1, sliding::HistoryOutput::samples);
        Section section{"Record " + runs.back().label(), {}, Fold::open};
        if (!r.result.message.empty()) section.parts.push_back(Paragraph{r.result.message});
        const RunView view{runs.back(), rigid ? &*rigid : nullptr, in.scene.criteria.allowable_slip,
                           fmt::format("record{}", runs.size()), in.runs.size()};
        if (runs.back().fe.history.time.size() > 1)
            for (Chart& chart : history_charts(view)) section.parts.emplace_back(std::move(chart));
        sections.push_back(std::move(section));
    }
    page.headline = fe_headline(in.scene, runs, in.combinations, error_source);
    page.key_figures = fe_key_figures(in.scene, runs);
    std::erase_if(page.key_figures,
                  [](const auto& figure) { return figure.first == "Largest open length"; }); // not kept
    page.key_figures.emplace_back("Elastic modes",
                                  fmt::format("{}", in.runs.empty() ? 0 : in.runs.front().result.modes));
    Table table = reduced_table(in.runs, in.scene.criteria.allowable_slip);
    write_walked_slips(table);
    page.sections.push_back({"Slip", {rows_part(without_seconds(table)), rows_part(run_out_table(runs))}, Fold::open});
    page.sections.push_back({"Static stages", {rows_part(contact_stage_table(runs))}, Fold::open});
    std::vector<Section> appendix = add_worse_polarities(runs, std::move(sections), page);
    end_fe_page(frame, motions, {}, page);
    std::move(appendix.begin(), appendix.end(), std::back_inserter(page.sections));
    return page;
}

} // namespace damslip::pages
