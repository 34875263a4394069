#include "cli/tied_run.hpp"

#include "analysis/fe/tied_runs.hpp"
#include "analysis/prepare/rock_warnings.hpp"
#include "cli/terminal/terminal_watch.hpp"
#include "core/file.hpp"
#include "core/version.hpp"
#include "fe2d/statics/static_solution.hpp"
#include "pages/fe/acoustic_modes.hpp"
#include "pages/fe/fe_output.hpp"
#include "pages/fe/tied_report.hpp"
#include "pages/report/json_object.hpp"
#include "pages/report/page_html.hpp"
#include "pages/report/table_text.hpp"
#include "pages/scene/effect_table.hpp"
#include "scene/plausible.hpp"
#include "scene/write.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <optional>
#include <ostream>

namespace damslip::cli {

using namespace pages;

namespace {

Table stage_table(const fe2d::Model& model, const fe2d::StaticSolution& statics)
{
    Table t;
    t.title = "Static stages";
    t.columns = {{"stage", "stage", "", 4},
                 {"force_x_kN_m", "sum Fx", "kN/m", 6},
                 {"force_y_kN_m", "sum Fy", "kN/m", 6},
                 {"crest_x_mm", "crest x", "mm", 5},
                 {"crest_y_mm", "crest y", "mm", 5}};
    for (const fe2d::StaticStage& s : statics.stages) {
        const Eigen::Vector2d crest = crest_displacement(model, s.displacement);
        t.rows.push_back({s.name, s.resultant.x() / 1e3, s.resultant.y() / 1e3, 1e3 * crest.x(), 1e3 * crest.y()});
    }
    t.notes.push_back(
        "forces: x downstream, y up; crest: its upstream end, relative to the zero state of stages.geostatic.");
    return t;
}

/// Energy that left through the boundaries of water and rock over the largest energy of the run; empty where there are none.
Cell radiated_share(const fe2d::History& history)
{
    if (history.rows.empty() || history.energy_scale == 0.0) return {};
    const double radiated = history.rows.back().energy.radiated;
    if (history.peak_water_force == 0.0 && radiated == 0.0) return {};
    return radiated / history.energy_scale;
}

Table run_table(const std::vector<TiedRun>& runs)
{
    Table t;
    t.title = "Earthquake runs, tied base";
    t.columns = {{"record", "record", "", 4},
                 {"polarity", "polarity", "", 4},
                 {"status", "status", "", 4},
                 {"method", "method", "", 4},
                 {"steps", "steps", "", 4},
                 {"dt_s", "step", "s", 4},
                 {"peak_crest_x_mm", "peak crest x", "mm", 5},
                 {"peak_crest_accel_x_m_s2", "peak crest a_x", "m/s²", 5},
                 {"peak_base_shear_kN_m", "peak base shear", "kN/m", 5},
                 {"radiated_share", "radiated", "–", 3},
                 {"energy_imbalance", "energy imbalance", "–", 2},
                 {"factorisations", "factorisations", "", 4},
                 {"seconds", "time", "s", 3}};
    for (const TiedRun& r : runs)
        t.rows.push_back(
            {r.record, static_cast<std::int64_t>(r.polarity),
             r.history.status == fe2d::TiedRunStatus::complete ? std::string("complete") : r.history.status_text,
             r.history.method, static_cast<std::int64_t>(r.history.steps), r.history.time_step,
             1e3 * r.history.peak_crest_x, r.history.peak_crest_accel_x, r.history.peak_base_shear / 1e3,
             radiated_share(r.history), r.history.largest_imbalance,
             static_cast<std::int64_t>(r.history.factorisations), r.seconds});
    t.notes.push_back("crest x relative to the ground, from the static state; accelerations absolute; energy imbalance "
                      "over the largest energy of the run.");
    t.notes.push_back("one polarity: the model is linear, so the other turns the part of the horizontal motion round; "
                      "--polarity -1 runs it.");
    return t;
}

} // namespace

int run_tied(const FeArguments& arguments, const Ready& ready, const Streams& streams)
{
    const Scene& scene = ready.scene;
    const EffectPlan& plan = ready.plan;
    const std::vector<RecordPair>& records = ready.records();
    TerminalWatch watch(streams);
    TiedRuns all(ready, fe_options(arguments), watch);
    const fe2d::Model& model = all.model();
    const fe2d::StaticSolution& statics = all.statics();
    const fe2d::FluidModel* const water = all.water();
    FieldSeries fields(arguments.out, model);
    for (const fe2d::StaticStage& s : statics.stages) fields.add(s.name, 0.0, s.displacement, s.elastic);
    std::vector<TiedRun> runs = all.run([&](const TiedRun& r) {
        if (r.history.displacement.size())
            fields.add(r.record + ", end", r.history.rows.empty() ? 0.0 : r.history.rows.back().time,
                       r.history.displacement, r.history.displacement);
        if (!arguments.out.empty())
            write_file(arguments.out / ("history_" + file_word(r.record) + ".csv"),
                       pages::csv(fe2d::tabulate(r.history), {"damslip " + program_version() + " fe --base tied",
                                                              "scene " + scene_hash(scene), "record " + r.record}));
    });
    if (water)
        for (TiedRun& r : runs) {
            r.notes.push_back(water_counts(*water));
            for (std::string& warning : reservoir_warnings(scene, 20.0)) r.notes.push_back(std::move(warning));
        }
    for (TiedRun& r : runs)
        for (std::string& warning : rock_warnings(scene, model.mesh, r.motion)) r.notes.push_back(std::move(warning));
    const Table counts = count_table(model.counts, water);
    auto j = json_header("fe");
    j["scene"] = {{"title", scene.title}, {"file", scene.file.string()}, {"hash", scene_hash(scene)}};
    j["base"] = "tied";
    j["effects"] = json_of(effect_table(plan));
    j["model"] = json_of(counts);
    j["stages"] = json_of(stage_table(model, statics));
    j["runs"] = json_of(run_table(runs));
    for (const TiedRun& r : runs) j["notes"][r.record] = r.notes;
    const std::vector<std::string> messages = note_texts(scene.notes);
    j["messages"] = messages;
    if (streams.form == Form::json)
        streams.out << j.dump(2) << "\n";
    else {
        streams.out << scene.title << "\n\n"
                    << pages::text(counts) << "\n"
                    << pages::text(stage_table(model, statics)) << "\n"
                    << pages::text(run_table(runs));
        for (const std::string& message : messages) streams.out << "note: " << message << "\n";
        for (const TiedRun& r : runs)
            for (const std::string& note : r.notes) streams.out << "note: " << r.record << ": " << note << "\n";
    }
    finish_output(arguments.out, scene, j.dump(2) + "\n", fields);
    say_written(arguments.out, streams);
    if (!arguments.out.empty()) {
        PressureProfile none; // a bonded base takes its uplift with the loads
        const FePageFrame frame{
            scene,
            plan,
            records,
            model,
            water,
            std::move(none),
            "finite elements, base bonded to the rock",
            fmt::format("plane-strain finite elements, {} unknowns, base bonded", model.dofs.count)};
        const std::filesystem::path file = arguments.out / "report.html";
        pages::Page page = tied_page(frame, runs, stage_table(model, statics), run_table(runs));
        page.warnings.insert(page.warnings.begin(), messages.begin(), messages.end());
        write_file(file, pages::page_html(page));
        if (!streams.quiet) streams.talk << "report: " << file.string() << "\n";
    }
    const bool whole = runs.size() == records.size() && std::all_of(runs.begin(), runs.end(), [](const TiedRun& r) {
                           return r.history.status == fe2d::TiedRunStatus::complete;
                       });
    return whole ? exit_ok : exit_no_answer;
}

} // namespace damslip::cli
