#include "analysis/prepare/ready.hpp"
#include "cli/command.hpp"
#include "cli/terminal/terminal.hpp"
#include "cli/verifier.hpp"
#include "core/file.hpp"
#include "core/input_error.hpp"
#include "core/status.hpp"
#include "core/text.hpp"
#include "pages/ablation/ablation_pages.hpp"
#include "pages/fe/fe_pages.hpp"
#include "pages/report/page.hpp"
#include "pages/scene/scene_pages.hpp"
#include "scene/planes.hpp"
#include "scene/plausible.hpp"
#include "scene/read.hpp"
#include "scene/scene_text.hpp"
#include "scene/water.hpp"

#include <filesystem>
#include <fmt/format.h>
#include <iostream>
#include <nlohmann/json.hpp>
#include <ostream>
#include <string>
#include <unistd.h>

namespace damslip::cli {

namespace {

struct InitArguments {
    std::filesystem::path out = "dam.toml";
    pages::SceneTemplate dam;
    bool force = false; ///< replaces a file
};

/// A number from the terminal; nothing for an empty line: what is assumed stays.
std::optional<double> asked(const std::string& what, const std::string& otherwise, const Streams& streams)
{
    for (;;) {
        streams.talk << what << (otherwise.empty() ? ": " : fmt::format(" [{}]: ", otherwise)) << std::flush;
        std::string line;
        if (!read_line(std::cin, line)) return std::nullopt;
        if (line.find_first_not_of(" \t\r") == std::string::npos) {
            if (!otherwise.empty()) return std::nullopt;
            continue;
        }
        if (const std::optional<double> value = parse_whole_number_text(line); value && *value > 0.0) return value;
        streams.talk << "a number above zero, such as 62.5\n";
    }
}

void ask_for_the_rest(pages::SceneTemplate& dam, const Streams& streams)
{
    const auto ask = [&](std::optional<double>& value, const char* what, double otherwise) {
        if (!value) value = asked(what, fmt::format("{:.4g}", otherwise), streams);
    };
    if (dam.height <= 0.0) dam.height = asked("height of the dam [m]", "", streams).value_or(0.0);
    if (dam.height <= 0.0) return;
    ask(dam.base, "length of its base [m]", 0.8 * dam.height);
    ask(dam.crest, "width of its crest [m]", 0.1 * dam.height);
    ask(dam.level, "water above the heel [m]", 0.95 * dam.height);
    ask(dam.friction, "friction of the base [-]", 0.8);
}

/// Writes a commented scene and its drawing beside it. Asks for what is missing where somebody sits at the terminal.
int init(const InitArguments& arguments, const Streams& streams)
{
    InitArguments a = arguments;
    if (isatty(STDIN_FILENO) && !streams.quiet && a.dam.height <= 0.0) ask_for_the_rest(a.dam, streams);
    if (!(a.dam.height > 0.0))
        refuse_usage("the height of the dam is missing.", "--height in metres",
                     "for example  damslip init dam.toml --height 62.5 --base 45");
    if (!a.dam.verticals.empty() && a.dam.verticals.size() != a.dam.records.size())
        refuse_usage(
            fmt::format("{} vertical records beside {} horizontal ones.", a.dam.verticals.size(), a.dam.records.size()),
            "one --vertical for each --record, or none", "name as many");
    if (!a.force && std::filesystem::exists(a.out))
        throw UsageError(Diagnostic{a.out.string(), 0, 0, "is there already.", "a new file",
                                    "choose another name, or replace it with  --force"});
    const std::filesystem::path folder = std::filesystem::absolute(a.out).parent_path();
    for (auto* records : {&a.dam.records, &a.dam.verticals}) // names in a scene count from its folder
        for (std::filesystem::path& record : *records)
            record = std::filesystem::proximate(std::filesystem::absolute(record), folder);
    const std::string text = pages::scene_text(a.dam);
    const Scene scene = parse_scene(text, a.out);
    write_file(a.out, text);
    std::filesystem::path drawing = a.out;
    drawing.replace_extension(".svg");
    write_file(drawing, pages::drawn_section(scene));
    if (!put_json_document(streams, "init", {{"scene", a.out.string()}, {"drawing", drawing.string()}}))
        streams.out << fmt::format("{}: the scene, assumptions marked\n{}: its section\nnext:  damslip screen {}\n",
                                   a.out.string(), drawing.string(), a.out.string());
    return exit_ok;
}

void init_flags(CLI::App& sub, InitArguments& a)
{
    sub.add_option("FILE", a.out, "scene to write")
        ->capture_default_str()
        ->check(output_to(OutputPath::regular_file, "FILE"));
    sub.add_option("--height", a.dam.height, "of the dam [m]; asked for at a terminal")->check(in_range(1.0, 1000.0));
    sub.add_option("--base", a.dam.base, "length of the base [m] (0.8 of the height)")->check(in_range(0.1, 2000.0));
    sub.add_option("--crest", a.dam.crest, "width of the crest [m] (0.1 of the height)")->check(in_range(0.1, 1000.0));
    sub.add_option("--level", a.dam.level, "of the water above the heel [m] (0.95 of the height)")
        ->check(in_range(0.1, 3000.0));
    sub.add_option("--friction", a.dam.friction, "of the base [-] (0.8)")->check(in_range(0.01, 10.0));
    sub.add_option("--allowable", a.dam.allowable, "slip [mm] (50)")->check(in_range(0.1, 100000.0));
    sub.add_option("--title", a.dam.title, "of the dam")->capture_default_str();
    sub.add_option("--record", a.dam.records, "horizontal accelerogram(s)");
    sub.add_option("--vertical", a.dam.verticals, "vertical accelerogram(s), one for each --record");
    sub.add_flag("--force", a.force, "replace FILE where it is there");
}

} // namespace

Command init_command()
{
    return {"init", "a commented scene of your own dam, with its drawing",
            "damslip init dam.toml --height 62.5 --base 45", with_flags<InitArguments>(init_flags, init)};
}

namespace {

struct SchemaArguments {
    bool markdown = false; ///< docs/scene-keys.md instead of the JSON Schema
};

int print_schema(const SchemaArguments& arguments, const Streams& streams)
{
    const std::string text = arguments.markdown ? scene_keys_markdown() : scene_schema(); // the schema is JSON itself
    if (!arguments.markdown || !put_json_document(streams, "schema", {{"markdown", text}})) streams.out << text;
    return exit_ok;
}

void schema_flags(CLI::App& sub, SchemaArguments& a)
{
    sub.add_flag("--markdown", a.markdown, "the same keys as a Markdown document");
}

} // namespace

Command schema_command()
{
    return {"schema", "JSON Schema of the scene file", "damslip schema > scene.schema.json",
            with_flags<SchemaArguments>(schema_flags, print_schema)};
}

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
    if (ready.reservoir) notes.push_back(ready.reservoir->reason);
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
    out.lift_joints = joints_of(ready.scene);
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
    const Ready ready = // the water is chosen once: no removal changes it
        prepare(given, method, {.joints_of_lifts = method == Method::finite_elements, .stop = streams.stop});
    const AblationPlan plan = make_ablations(ready.given, method, seepage_points(ready.given));

    TerminalWatch watch(streams);
    const AblationRuns runs = run_ablations(plan, ready.pairs, arguments.jobs, watch);
    const Ablations ablations{plan, ready.records(), runs, ready.reservoir ? ready.reservoir->reason : std::string()};
    put_answer(ablation_answer(ablations, given, ready.plan), "--report FILE.html", streams);
    if (!arguments.report.empty()) {
        write_file(arguments.report, page_html(ablation_page(ablations, given, ready.plan)));
        name_report(arguments.report, streams);
    }
    return unanswered_runs(runs).exit_code();
}

/// The effect plan: which effects are on, why, and what each costs.
int explain(const ExplainArguments& arguments, const Streams& streams)
{
    const bool on_seam = !arguments.inputs.plane.empty();
    if (arguments.ablate && on_seam)
        refuse_usage("--ablate with --plane.", "effects of the dam on its base", "leave one of them out");
    if (arguments.ablate) return ablate(arguments, streams);
    const Scene given = read_run_scene(arguments.inputs, streams);
    if (arguments.method == "fe")
        need_section(given, "damslip explain --method fe", "leave --method out: the wedge is rigid");
    const Method method = arguments.method == "fe" ? Method::finite_elements : Method::rigid_block;
    if (on_seam && method != Method::finite_elements)
        refuse_usage("--plane with --method rigid.", "--method fe", "damslip screen SCENE has all planes as rigid blocks");
    Explained out{given, arguments.method, make_effect_plan(given, method), {}, {}, {}, note_texts(given.notes)};
    if (method == Method::finite_elements)
        add_model(prepare(given, method, records_at_hand(given), {.joints_of_lifts = true, .stop = streams.stop}), out);
    put_answer(explain_answer(out), "", streams);
    return exit_ok;
}

void explain_flags(CLI::App& sub, ExplainArguments& a)
{
    add_run_inputs(sub, a.inputs);
    add_rock(sub, a.inputs);
    add_scale(sub, a.inputs);
    add_friction(sub, a.inputs);
    add_plane(sub, a.inputs);
    sub.add_option("--method", a.method, "rigid or fe")->check(CLI::IsMember({"rigid", "fe"}))->capture_default_str();
    const char* const group = "Ablation";
    sub.option_defaults()->group(group);
    CLI::Option* ablate =
        sub.add_flag("--ablate", a.ablate,
                     "runs the scene without each of its effects in turn: change of slip and crest motion, seconds");
    sub.add_option("--report", a.report, "HTML file with the changes as charts")
        ->check(output_to(OutputPath::file, "--report"))
        ->needs(ablate);
    add_jobs(sub, a.jobs, "threads; 0: all cores; with 1 (default) the seconds are fair")->needs(ablate);
}

} // namespace

Command explain_command()
{
    return {"explain", "the effect plan: what is taken into account, why, and what it costs",
            "damslip explain examples/reference_dam.toml --ablate --report ablation.html",
            with_flags<ExplainArguments>(explain_flags, explain)};
}

} // namespace damslip::cli
