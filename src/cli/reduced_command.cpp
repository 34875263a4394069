#include "cli/reduced_command.hpp"

#include "cli/run/contact_options.hpp"
#include "cli/run/reducible.hpp"
#include "cli/show/contact_tables.hpp"
#include "cli/show/effect_table.hpp"
#include "cli/show/fe_output.hpp"
#include "cli/show/reduced_report.hpp"
#include "cli/terminal/interrupt.hpp"
#include "cli/terminal/progress.hpp"
#include "cli/terminal/usage_error.hpp"
#include "core/file.hpp"
#include "fe2d/reduction/reduced_run.hpp"
#include "report/page_html.hpp"
#include "report/table_text.hpp"
#include "scene/plausible.hpp"
#include "scene/write.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <ostream>

namespace damslip::cli {

namespace {

Table reduced_table(const std::vector<ReducedRecord>& runs)
{
    Table t;
    t.title = "Earthquake runs, reduced, exact contact";
    t.columns = {{"record", "record", "", 4},
                 {"status", "status", "", 4},
                 {"slip_mm", "slip", "mm", 5},
                 {"truncation_error_mm", "± modes", "mm", 2},
                 {"slip_error_mm", "± step", "mm", 2},
                 {"max_slip_m", "largest slip", "m", 5},
                 {"modes", "modes", "", 4},
                 {"highest_frequency_Hz", "up to", "Hz", 4},
                 {"steps", "steps", "", 4},
                 {"dt_s", "step", "s", 4},
                 {"unresolved", "unresolved", "", 4},
                 {"seconds", "time", "s", 3}};
    for (const auto& [record, r, motion] : runs)
        t.rows.push_back({record, word(r.status), 1e3 * r.slip, 1e3 * r.truncation_error, 1e3 * r.step_error,
                          r.max_slip, static_cast<std::int64_t>(r.modes), r.highest_frequency,
                          static_cast<std::int64_t>(r.counts.steps), r.dt,
                          static_cast<std::int64_t>(r.counts.unresolved), r.seconds.statics + r.seconds.dynamics});
    t.notes.push_back("slip: area mean over the base at the end, since the static state, positive downstream; ± modes: "
                      "what the elastic modes left out change (estimate), ± step: what the time step leaves open.");
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

} // namespace

int run_reduced(const FeArguments& arguments, const Scene& scene, const EffectPlan& plan,
                const std::vector<RecordPair>& records, const Streams& streams)
{
    check_reducible(scene);
    SeepageSource seepage;
    const InterruptGuard interrupt;
    fe2d::RunOptions options = contact_options(scene, records, seepage);
    options.progress = [&](const fe2d::RunProgress&) {
        return interrupt.interrupted() ? fe2d::RunAnswer::stop : fe2d::RunAnswer::go_on;
    };
    options.stop = streams.stop;
    Progress progress(streams, "fe --reduced", records.size());
    progress.phase("set-up");
    const fe2d::EarthquakeRun full(scene, options);
    const fe2d::ReducedRun model(full, scene, options, arguments.modes.value_or(fe2d::default_modes));

    std::vector<ReducedRecord> runs;
    for (const RecordPair& pair : records) {
        if (interrupt.interrupted()) break;
        GroundMotion motion = ground_motion(scene, pair, 1.0, arguments.polarity.value_or(1));
        fe2d::ReducedResult result = model.run(motion);
        runs.push_back({pair.files.name, std::move(result), std::move(motion)});
        interrupt.results_at_hand();
        if (!arguments.out.empty())
            write_file(arguments.out / ("history_" + file_word(pair.files.name) + ".csv"),
                       report::csv(history_table(runs.back().result.history),
                                   {"damslip " + program_version() + " fe --reduced", "scene " + scene_hash(scene),
                                    "record " + pair.files.name}));
        progress.advance();
    }
    std::vector<std::string> messages = note_texts(scene.notes);
    for (const ReducedRecord& run : runs)
        if (run.result.status != Status::at_rest) messages.push_back(run.record + ": " + run.result.message);
    auto j = json_header("fe");
    j["scene"] = {{"title", scene.title}, {"file", scene.file.string()}, {"hash", scene_hash(scene)}};
    j["base"] = "contact";
    j["reduced"] = true;
    j["effects"] = json_of(effect_table(plan));
    j["model"] = json_of(count_table(full.model().counts));
    j["contact_pairs"] = full.structure().plane().pairs();
    j["stages"] = json_of(reduced_stage_table(runs));
    j["runs"] = json_of(reduced_table(runs));
    j["messages"] = messages;
    if (streams.form == Form::json)
        streams.out << j.dump(2) << "\n";
    else {
        streams.out << scene.title << "\n\n" << report::text(count_table(full.model().counts));
        streams.out << report::text(reduced_stage_table(runs)) << "\n" << report::text(reduced_table(runs));
        for (const std::string& message : messages) streams.out << "note: " << message << "\n";
    }
    FieldSeries fields(arguments.out, full.model()); // without instants: the reduced run keeps no shapes
    finish_output(arguments.out, scene, j.dump(2) + "\n", fields, streams);
    if (!arguments.out.empty()) {
        const RigidModel rigid = make_rigid_model(scene, seepage.profile_of(scene));
        const std::filesystem::path file = arguments.out / "report.html";
        write_file(file, report::page_html(reduced_page({scene, plan, records, full, rigid, options.uplift, runs,
                                                         reduced_table(runs), messages})));
        if (!streams.quiet) streams.talk << "report: " << file.string() << "\n";
    }
    const bool all = runs.size() == records.size() &&
                     std::all_of(runs.begin(), runs.end(),
                                 [](const ReducedRecord& run) { return is_answer(run.result.status); });
    return all ? exit_ok : exit_no_answer;
}

} // namespace damslip::cli
