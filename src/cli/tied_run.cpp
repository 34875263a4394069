#include "cli/tied_run.hpp"

#include "analysis/prepare/fe_inputs.hpp"
#include "analysis/prepare/rock_warnings.hpp"
#include "analysis/prepare/tied_scheme.hpp"
#include "cli/terminal/terminal_watch.hpp"
#include "core/file.hpp"
#include "core/stopwatch.hpp"
#include "core/usage_error.hpp"
#include "core/version.hpp"
#include "fe2d/model/held_edges.hpp"
#include "fe2d/statics/static_solution.hpp"
#include "fe2d/time/coupled_structure.hpp"
#include "fe2d/time/explicit_run.hpp"
#include "fe2d/time/integrate.hpp"
#include "fe2d/time/modal_run.hpp"
#include "fe2d/time/structure_system.hpp"
#include "pages/fe/acoustic_modes.hpp"
#include "pages/fe/fe_output.hpp"
#include "pages/fe/tied_report.hpp"
#include "pages/report/json_object.hpp"
#include "pages/report/page_html.hpp"
#include "pages/report/table_text.hpp"
#include "pages/scene/effect_table.hpp"
#include "scene/plausible.hpp"
#include "scene/rock_mass.hpp"
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

fe2d::History integrate_by(TimeScheme scheme, const fe2d::Model& model, const GroundMotion& motion,
                           const fe2d::TiedRunOptions& options)
{
    if (scheme == TimeScheme::central_difference) return fe2d::integrate_explicit(model, motion, options);
    if (scheme == TimeScheme::modal) return fe2d::integrate_modal(model, motion, options);
    return fe2d::integrate(model, motion, options);
}

/// What stands still, what moves, and what its damping is taken from; the same model where the rock is massless.
struct TiedModels {
    fe2d::Model still;
    std::optional<fe2d::Model> on_free_edges, massless;

    TiedModels(const Scene& scene, const fe2d::ModelOptions& options) : still(fe2d::build_model(scene, options))
    {
        if (!rock_has_mass(scene)) return;
        massless = fe2d::build_model(with_massless_rock(scene), options);
        fe2d::ModelOptions free = options;
        free.edges = fe2d::RockEdges::free;
        if (rock_edges_are_viscous(scene)) on_free_edges = fe2d::build_model(scene, free);
    }
    const fe2d::Model& moving() const { return on_free_edges ? *on_free_edges : still; }
    const fe2d::Model& damped() const { return massless ? *massless : still; }
};

/// Static loads and where they leave the dam, on the unknowns of TiedModels::moving().
fe2d::HeldStart start_of(const TiedModels& models, const Eigen::VectorXd& load, const fe2d::StaticSolution& statics)
{
    if (!models.on_free_edges) return {{}, load};
    const Eigen::VectorXd rest =
        statics.stages.empty() ? Eigen::VectorXd::Zero(load.size()) : statics.stages.back().elastic;
    return fe2d::held_edges(models.still, *models.on_free_edges, rest, load);
}

TiedRun run_record(const Scene& scene, const TiedModels& models, const fe2d::FluidModel* water,
                   const fe2d::HeldStart& start_state, const Eigen::Vector2d& resultant, const GroundMotion& motion,
                   int polarity, Watch& watch)
{
    const fe2d::Model& damped = models.damped();
    TiedRun run{motion.name, {}, motion.notes, 0.0, motion};
    run.polarity = polarity;
    fe2d::TiedRunOptions options;
    options.scheme = fe2d::scheme_of(scene.time);
    options.dt = scene.time.dt;
    options.damping = water ? fe2d::damping_of(scene, damped, *water, motion) : fe2d::damping_of(scene, damped, motion);
    options.water = water;
    options.static_load = start_state.load;
    options.start_displacement = start_state.displacement;
    options.static_resultant = resultant;
    watch.begin(motion.name, 1000);
    std::size_t shown = 0;
    options.progress = [&](const fe2d::RunProgress& p) {
        const auto now = static_cast<std::size_t>(1000 * p.step / std::max<std::int64_t>(1, p.steps));
        if (now > shown) watch.advance(static_cast<double>(now - shown));
        shown = now;
        return watch.stop_asked() ? fe2d::RunAnswer::stop : fe2d::RunAnswer::go_on;
    };
    const Stopwatch start;
    const TiedScheme chosen = tied_scheme(scene, motion, options);
    run.history = integrate_by(chosen.scheme, models.moving(), motion, options);
    watch.end();
    run.seconds = start.seconds();
    if (!chosen.reason.empty()) run.notes.push_back(chosen.reason);
    if (models.on_free_edges && run.history.displacement.size() > 0)
        run.history.displacement = fe2d::without_edges(models.still, *models.on_free_edges, run.history.displacement);
    run.notes.insert(run.notes.end(), run.history.notes.begin(), run.history.notes.end());
    return run;
}

} // namespace

int run_tied(const FeArguments& arguments, const Scene& scene, const EffectPlan& plan,
             const std::vector<RecordPair>& records, const Streams& streams)
{
    fe2d::ModelOptions options;
    options.added_mass = added_mass_law(scene);
    if (scene.time.scheme == TimeScheme::central_difference) options.mass = fe2d::MassKind::lumped;
    const TiedModels models(scene, options);
    const fe2d::Model& model = models.still;
    std::optional<fe2d::FluidModel> water;
    if (scene.reservoir && scene.reservoir->model == ReservoirModel::acoustic && scene.reservoir->level > 0)
        water = fe2d::build_fluid(scene);
    fe2d::StaticLoads loads = fe2d::static_loads(scene, model);
    if (scene.stages.pore_pressure != PorePressure::none)
        loads.impounding.push_back({"water in the rock", rock_water_load(scene, model), Eigen::Vector2d::Zero()});
    const fe2d::StaticSolution statics = fe2d::solve_static(scene, model, loads);
    if (!statics.solver.ok())
        throw NotConverged(Diagnostic{scene.file.string(), 0, 0,
                                      "the static stages could not be solved: " + statics.solver.text(),
                                      "a model held by its foundation", "check [foundation] and the materials"});
    const Eigen::VectorXd load =
        fe2d::sum_of(loads.gravity, model.dofs.count) + fe2d::sum_of(loads.impounding, model.dofs.count);
    const Eigen::Vector2d resultant =
        statics.stages.empty() ? Eigen::Vector2d::Zero() : statics.stages.back().resultant;

    FieldSeries fields(arguments.out, model);
    for (const fe2d::StaticStage& s : statics.stages) fields.add(s.name, 0.0, s.displacement, s.elastic);
    const fe2d::HeldStart start = start_of(models, load, statics);
    TerminalWatch watch(streams);
    std::vector<TiedRun> runs;
    for (const RecordPair& pair : records) {
        if (watch.stop_asked()) break;
        runs.push_back(run_record(scene, models, water ? &*water : nullptr, start, resultant,
                                  ground_motion(scene, pair, 1.0, arguments.polarity.value_or(1)),
                                  shown_polarity(scene, arguments.polarity.value_or(1)), watch));
        watch.results_at_hand();
        const TiedRun& r = runs.back();
        if (r.history.displacement.size())
            fields.add(r.record + ", end", r.history.rows.empty() ? 0.0 : r.history.rows.back().time,
                       r.history.displacement, r.history.displacement);
        if (!arguments.out.empty())
            write_file(arguments.out / ("history_" + file_word(r.record) + ".csv"),
                       pages::csv(fe2d::tabulate(r.history), {"damslip " + program_version() + " fe --base tied",
                                                              "scene " + scene_hash(scene), "record " + r.record}));
    }
    if (water)
        for (TiedRun& r : runs) {
            r.notes.push_back(water_counts(*water));
            for (std::string& warning : reservoir_warnings(scene, 20.0)) r.notes.push_back(std::move(warning));
        }
    for (TiedRun& r : runs)
        for (std::string& warning : rock_warnings(scene, model.mesh, r.motion)) r.notes.push_back(std::move(warning));
    const Table counts = count_table(model.counts, water ? &*water : nullptr);
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
        Polyline none; // a bonded base takes its uplift with the loads
        const FePageFrame frame{
            scene,
            plan,
            records,
            model,
            water ? &*water : nullptr,
            std::move(none),
            "finite elements, base bonded to the rock",
            fmt::format("plane-strain finite elements, {} unknowns, base bonded", model.dofs.count)};
        const std::filesystem::path file = arguments.out / "report.html";
        pages::Page page = tied_page(frame, runs, stage_table(model, statics), run_table(runs));
        page.warnings.insert(page.warnings.begin(), messages.begin(), messages.end());
        write_file(file, pages::page_html(page));
        if (!streams.quiet) streams.talk << "report: " << file.string() << "\n";
    }
    const bool all = runs.size() == records.size() && std::all_of(runs.begin(), runs.end(), [](const TiedRun& r) {
                         return r.history.status == fe2d::TiedRunStatus::complete;
                     });
    return all ? exit_ok : exit_no_answer;
}

} // namespace damslip::cli
