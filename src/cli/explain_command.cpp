#include "analysis/prepare/ready.hpp"
#include "analysis/prepare/tied_scheme.hpp"
#include "cli/flags.hpp"
#include "cli/print_pdf.hpp"
#include "cli/terminal/terminal_watch.hpp"
#include "core/file.hpp"
#include "core/usage_error.hpp"
#include "pages/ablation/ablation_tables.hpp"
#include "pages/explain/explain_page.hpp"
#include "pages/fe/fe_report.hpp"
#include "pages/fe/water_notes.hpp"
#include "pages/report/page_html.hpp"
#include "scene/plausible.hpp"
#include "scene/water.hpp"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <ostream>
#include <string>

namespace damslip::cli {

using namespace pages;

namespace {

struct ExplainArguments {
    RunInputs inputs;
    std::string method = "rigid"; ///< "rigid" or "fe"
    bool ablate = false;          ///< runs the scene without each of its effects
    std::filesystem::path report; ///< of the ablation, HTML; empty: none
    int jobs = 1;                 ///< threads of the ablation, 0: all cores
};

/// How the water takes part, by the computed first frequency where the scene leaves it open, and what its length and end are good for.
std::vector<std::string> water_notes(const Ready& ready)
{
    std::vector<std::string> notes;
    if (!has_water(ready.given)) return notes;
    if (ready.reservoir) notes.push_back(ready.reservoir->reason + "; --reduced takes added mass");
    if (ready.given.reservoir->model == ReservoirModel::acoustic)
        for (std::string& warning : reservoir_warnings(ready.given, 20.0)) notes.push_back(std::move(warning));
    return notes;
}

/// The scene's records for the estimate of seconds; none where a file is not there, which only a run has to have.
Records records_at_hand(const Scene& scene)
{
    for (const RecordFiles& r : scene.motion.records)
        if (!std::filesystem::exists(r.horizontal)) return nullptr;
    return load_records(scene, Method::finite_elements);
}

/// The FE model that a run of this scene would hold, and what the run costs.
void add_model(const Ready& ready, Explained& out)
{
    out.plan = ready.plan; // names the water that was chosen
    out.model = fe2d::build_model(ready.scene, ready.model_options());
    if (ready.plan.on(Effect::acoustic_water) && has_water(ready.scene)) out.water = fe2d::build_fluid(ready.scene);
    out.cost = contact_cost(ready);
    for (std::string& note : water_notes(ready)) out.notes.push_back(std::move(note));
    out.notes.push_back(time_scheme_note(ready.given));
    for (std::string& note : bond_messages(ready.scene, out.model->mesh)) out.notes.push_back(std::move(note));
}

void check_records(const Scene& scene, Method method)
{
    if (method == Method::rigid_block || !scene.motion.records.empty()) return;
    throw UsageError(Diagnostic{scene.file.string(), 0, 0, "--ablate --method fe without a record.",
                                "at least one record: slips are what is compared",
                                "add  --record FILE  or a [[motion.record]]"});
}

/// `explain --ablate`: the scene without each of its effects in turn. @returns an ExitCode
int ablate(const ExplainArguments& arguments, const Streams& streams)
{
    const Method method = arguments.method == "fe" ? Method::finite_elements : Method::rigid_block;
    const Scene given = read_run_scene(arguments.inputs, streams);
    need_section(given, "damslip explain --ablate", "damslip explain SCENE gives the effects of the wedge");
    if (method == Method::finite_elements) say_base(given, streams);
    check_records(given, method);
    const Ready ready =
        prepare(given, method, {.stop = streams.stop}); // the water is chosen once: no removal changes it
    const AblationPlan plan = make_ablations(ready.given, method, seepage_points(ready.given));

    TerminalWatch watch(streams);
    const AblationRuns runs = run_ablations(plan, ready.pairs, arguments.jobs, watch);
    const Ablations ablations{plan, ready.records(), runs, ready.reservoir ? ready.reservoir->reason : std::string()};
    streams.out << (streams.form == Form::json ? ablation_json(ablations, given, ready.plan).dump(2) + "\n"
                                               : ablation_text(ablations, ready.plan));
    if (!arguments.report.empty()) {
        write_file(arguments.report, page_html(ablation_page(ablations, given, ready.plan)));
        name_report(arguments.report, streams);
    }
    return unanswered_runs(runs).exit_code();
}

/// The effect plan: which effects are on, why, and what each costs.
int explain(const ExplainArguments& arguments, const Streams& streams)
{
    if (arguments.ablate) return ablate(arguments, streams);
    const Scene given = read_run_scene(arguments.inputs, streams);
    if (arguments.method == "fe")
        need_section(given, "damslip explain --method fe", "leave --method out: the wedge is rigid");
    const Method method = arguments.method == "fe" ? Method::finite_elements : Method::rigid_block;
    Explained out{given, arguments.method, make_effect_plan(given, method), {}, {}, {}, note_texts(given.notes)};
    if (method == Method::finite_elements)
        add_model(prepare(given, method, records_at_hand(given), {.stop = streams.stop}), out);
    streams.out << (streams.form == Form::json ? explain_json(out).dump(2) + "\n" : explain_text(out));
    return exit_ok;
}

void explain_flags(CLI::App& sub, ExplainArguments& a)
{
    add_run_inputs(sub, a.inputs);
    add_rock(sub, a.inputs);
    add_scale(sub, a.inputs);
    add_friction(sub, a.inputs);
    sub.add_option("--method", a.method, "rigid or fe")->check(CLI::IsMember({"rigid", "fe"}))->capture_default_str();
    const char* const group = "Ablation";
    CLI::Option* ablate =
        sub.add_flag("--ablate", a.ablate,
                     "runs the scene without each of its effects in turn: change of slip and crest motion, seconds")
            ->group(group);
    sub.add_option("--report", a.report, "HTML file with the changes as charts")
        ->check(output_to(OutputPath::file, "--report"))
        ->needs(ablate)
        ->group(group);
    add_jobs(sub, a.jobs, "threads; 0: all cores; with 1 (default) the seconds are fair")->needs(ablate)->group(group);
}

} // namespace

Command explain_command()
{
    return {"explain", "the effect plan: what is taken into account, why, and what it costs",
            "damslip explain examples/reference_dam.toml --ablate --report ablation.html",
            with_flags<ExplainArguments>(explain_flags, explain)};
}

} // namespace damslip::cli
