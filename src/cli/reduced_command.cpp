#include "cli/reduced_command.hpp"

#include "analysis/fe/contact_runs.hpp"
#include "cli/terminal/terminal_watch.hpp"
#include "core/file.hpp"
#include "core/version.hpp"
#include "fe2d/reduction/reduced_run.hpp"
#include "pages/fe/contact_tables.hpp"
#include "pages/fe/fe_output.hpp"
#include "pages/fe/fe_report.hpp"
#include "pages/fe/reduced_report.hpp"
#include "pages/report/json_object.hpp"
#include "pages/report/page_html.hpp"
#include "pages/report/table_text.hpp"
#include "pages/scene/effect_table.hpp"
#include "scene/plausible.hpp"
#include "scene/write.hpp"

#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <ostream>

namespace damslip::cli {

using namespace pages;

namespace {

/// With the part of the modes, which the step's holds in a reduced run.
std::string error_words(const SlipError& error)
{
    const std::string words = error.parts();
    return words.starts_with("step") ? "modes, " + words : words;
}

Table reduced_table(const std::vector<ReducedRecord>& runs, const std::optional<double>& allowable)
{
    Table t;
    t.title = "Earthquake runs, reduced, exact contact";
    t.columns = {{"record", "record", "", 4},
                 {"polarity", "polarity", "", 4},
                 {"status", "status", "", 4},
                 {"slip_mm", "slip at end (mean of base)", "mm", 5},
                 {"truncation_error_mm", "± modes", "mm", 2},
                 {"slip_error_mm", "± step", "mm", 2},
                 {"mesh_error_mm", "± mesh", "mm", 2},
                 {"total_error_mm", "± total", "mm", 2},
                 {"error_parts", "error holds", "", 4},
                 {"max_slip_m", "largest slip on the way", "m", 5},
                 {"verdict", "verdict", "", 4},
                 {"modes", "modes", "", 4},
                 {"highest_frequency_Hz", "up to", "Hz", 4},
                 {"steps", "steps", "", 4},
                 {"dt_s", "step", "s", 4},
                 {"unresolved", "unresolved", "", 4},
                 {"seconds", "time", "s", 3}};
    for (const ReducedRecord& run : runs) {
        const fe2d::ReducedResult& r = run.result;
        const ContactRun as_full = as_contact_run(run);
        const SlipError error = slip_error(as_full);
        const bool slides = reported(r.status, r.slip).has_value();
        const auto in_mm = [&](double metres) { return slides && std::isfinite(metres) ? Cell(1e3 * metres) : Cell(); };
        t.rows.push_back({run.record, static_cast<std::int64_t>(run.polarity), word(r.status), in_mm(r.slip),
                          in_mm(r.truncation_error), in_mm(r.step_error), in_mm(error.mesh), in_mm(error.total),
                          slides ? Cell(error_words(error)) : Cell(), slides ? Cell(r.max_slip) : Cell(),
                          word(verdict_of(as_full, allowable)), static_cast<std::int64_t>(r.modes), r.highest_frequency,
                          static_cast<std::int64_t>(r.counts.steps), r.dt,
                          static_cast<std::int64_t>(r.counts.unresolved), r.seconds.statics + r.seconds.dynamics});
    }
    t.notes.push_back(
        "slip: area mean over the base since the static state, positive downstream; ± modes: what the elastic "
        "modes left out change (estimate), ± step: what the time step leaves open; ± mesh: change against "
        "elements of twice the size.");
    for (const std::string& note : error_notes(as_contact_runs(runs))) t.notes.push_back(note);
    t.notes.push_back("polarity -1: the record's horizontal component is flipped.");
    t.notes.push_back("time without the shared set-up of model and modes.");
    return t;
}

Table history_table(const fe2d::ReducedHistory& h)
{
    Table t;
    t.columns = {{"time_s", "time", "s", 6},
                 {"slip_m", "slip", "m", 6},
                 {"crest_x_m", "crest x", "m", 6},
                 {"normal_force_N_m", "N'", "N/m", 6},
                 {"shear_force_N_m", "T", "N/m", 6}};
    for (std::size_t i = 0; i < h.time.size(); ++i)
        t.rows.push_back({h.time[i], h.slip[i], h.crest_x[i], h.normal_force[i], h.shear_force[i]});
    return t;
}

void write_history(const std::filesystem::path& folder, const Scene& scene, const ReducedRecord& run)
{
    const ContactRun as_full = as_contact_run(run);
    write_file(folder / ("history_" + file_word(run.record) + as_full.suffix() + ".csv"),
               pages::csv(history_table(run.result.history),
                          {"damslip " + program_version() + " fe --reduced", "scene " + scene_hash(scene),
                           "record " + as_full.label(), "status " + word(run.result.status)}));
}

} // namespace

int run_reduced(const FeArguments& arguments, const Ready& ready, const Streams& streams)
{
    const Scene& scene = ready.scene;
    const EffectPlan& plan = ready.plan;
    const std::vector<RecordPair>& records = ready.records();
    TerminalWatch watch(streams);
    ReducedRuns all(ready, fe_options(arguments), watch);
    const fe2d::EarthquakeRun& full = all.full();
    const std::vector<ReducedRecord> runs = all.run([&](const ReducedRecord& run) {
        if (!arguments.out.empty()) write_history(arguments.out, scene, run);
    });
    const std::vector<ContactRun> list = as_contact_runs(runs);
    const Table table = reduced_table(runs, scene.criteria.allowable_slip);
    const pages::Headline headline = fe_headline(scene, list, "step and modes");
    std::vector<std::string> messages = note_texts(scene.notes);
    for (const ContactRun& run : list)
        if (run.fe.status != Status::at_rest) messages.push_back(run.label() + ": " + run.fe.message);
    auto j = json_header("fe");
    j["scene"] = {{"title", scene.title}, {"file", scene.file.string()}, {"hash", scene_hash(scene)}};
    j["base"] = "contact";
    j["reduced"] = true;
    j["effects"] = json_of(effect_table(plan));
    j["model"] = json_of(count_table(full.model().counts));
    j["contact_pairs"] = full.structure().plane().pairs();
    j["headline"] = headline.sentence;
    j["verdict"] = word(verdict_of(list, scene.criteria.allowable_slip));
    j["worst"] = worst_json(list, scene.criteria.allowable_slip);
    j["stages"] = json_of(contact_stage_table(list));
    j["runs"] = json_of(table);
    j["messages"] = messages;
    if (streams.form == Form::json)
        streams.out << j.dump(2) << "\n";
    else {
        streams.out << scene.title << "\n\n" << pages::text(count_table(full.model().counts));
        streams.out << pages::text(contact_stage_table(list)) << "\n"
                    << pages::text(table) << "\n"
                    << headline_text(headline);
        for (const std::string& message : messages) streams.out << "note: " << message << "\n";
    }
    FieldSeries fields(arguments.out, full.model()); // without instants: the reduced run keeps no shapes
    finish_output(arguments.out, scene, j.dump(2) + "\n", fields);
    say_written(arguments.out, streams);
    if (!arguments.out.empty()) {
        const std::filesystem::path file = arguments.out / "report.html";
        write_file(file, pages::page_html(reduced_page(
                             {scene, plan, records, full, all.rigid(), all.uplift(), runs, table, messages})));
        if (!streams.quiet) streams.talk << "report: " << file.string() << "\n";
    }
    const bool whole = runs.size() == all.whole();
    return whole ? exit_code_of(list) : exit_no_answer;
}

} // namespace damslip::cli
