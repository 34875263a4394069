#include "cli/arguments.hpp"

#include "cli/accuracy_command.hpp"
#include "cli/completion_command.hpp"
#include "cli/explain_command.hpp"
#include "cli/fe_command.hpp"
#include "cli/man_command.hpp"
#include "cli/mesh_command.hpp"
#include "cli/modes_command.hpp"
#include "cli/parser.hpp"
#include "cli/schema_command.hpp"
#include "cli/screen_command.hpp"
#include "cli/study_command.hpp"
#include "cli/sweep_command.hpp"
#include "cli/verify_command.hpp"
#include "core/usage_error.hpp"
#include "core/version.hpp"
#include "scene/uplift_row.hpp"

#include <fmt/format.h>

namespace damslip::cli {

namespace {

const char* const exit_codes = "Exit codes: 0 ok, 1 internal error, 2 command line, 3 a file that cannot be read or "
                               "written, 4 no answer: not converged, interrupted, too little memory, or a check failed "
                               "(results so far are kept).";

/// All option structs, owned together with the parser that fills them.
struct Parser : ParserBase {
    CLI::App app{"How far does this concrete gravity dam slide in this earthquake, and how sure are we?", "damslip"};

    ScreenArguments screen;
    SweepArguments sweep;
    StudyArguments study;
    ExplainArguments explain;
    AccuracyArguments accuracy;
    VerifyArguments verify;
    MeshArguments mesh;
    ModesArguments modes;
    FeArguments fe;
    RecordArguments record;
    SchemaArguments schema;
    ManArguments man;
    std::string shell;
};

CLI::App* command(Parser& p, const std::string& name, const std::string& description, const std::string& example)
{
    return add_command(p.app, p, name, description, example);
}

void add_scene(CLI::App* sub, RunInputs& in)
{
    sub->add_option("SCENE", in.scene, "scene file (TOML); -: standard input")->required();
    sub->add_flag("--strict", in.strict, "values outside the range of real dams are errors, not notes");
}

void add_run_inputs(CLI::App* sub, RunInputs& in)
{
    add_scene(sub, in);
    sub->add_option("--record", in.records, "horizontal accelerogram(s) instead of the scene's")
        ->group("Ground motion");
    sub->add_option("--vertical", in.verticals,
                    "vertical accelerogram(s), one for each --record, in the same order; none for a record without one")
        ->group("Ground motion");
    sub->add_option("--units", in.unit, "unit of record files that do not say: g, m/s2, cm/s2, gal, mg")
        ->group("Ground motion");
    sub->add_option("--dt", in.dt, "time step of one-column record files [s]")->group("Ground motion");
    sub->add_option("--column", in.column, "heading or number of the horizontal column where files hold several")
        ->group("Ground motion");
    sub->add_option("--vertical-column", in.vertical_column, "the same of the vertical files")->group("Ground motion");
}

void add_screen(Parser& p)
{
    CLI::App* sub =
        command(p, "screen", "limit equilibrium, yield accelerations, rigid-block displacement and regressions",
                "damslip screen examples/reference_dam.toml --record ns.at2 --vertical up.at2");
    add_run_inputs(sub, p.screen.inputs);
    sub->add_option("--scale", p.screen.inputs.scale, "factor on all records")->group("Ground motion");
    sub->add_option("--friction", p.screen.inputs.friction, "Coulomb mu instead of the scene's");
    sub->add_option("--scheme", p.screen.inputs.scheme, "of the rigid block: exact (default) or slammer");
    sub->add_option("--out", p.screen.out, "folder for summary.json, displacements.csv and the resolved scene")
        ->check(output_to(OutputPath::folder, "--out"));
    sub->add_option("-j,--jobs", p.screen.jobs, "threads; 0: all cores")->check(CLI::Range(0, 1024));
    sub->callback([&p] { p.chosen = [a = p.screen](const Streams& s) { return screen(a, s); }; });
}

void add_sweep_parts(CLI::App* sub, SweepArguments& a)
{
    const char* const group = "Long sweeps";
    sub->add_flag("--resume", a.resume, "go on where a sweep with the same --out stopped")->group(group);
    sub->add_option("--shard", a.shard, "i/n: the i-th of n parts, i from 0, into OUT.i-of-n.csv")->group(group);
    sub->add_option(
           "--merge", a.merge,
           "put parts together: part files, or folders of them; with SCENE its report has the section and the records")
        ->group(group);
    sub->add_flag("--plan", a.plan, "print the commands of all parts, one a line")->group(group);
    sub->add_option("--slurm-array", a.slurm_array, "write a Slurm job script for all parts")
        ->check(output_to(OutputPath::file, "--slurm-array"))
        ->group(group);
    sub->add_option("--parts", a.parts, "of --plan and --slurm-array; default: one per scene variant and motion")
        ->check(CLI::Range(1, 1000000))
        ->group(group);
}

void add_sweep(Parser& p)
{
    CLI::App* sub = command(
        p, "sweep", "slip over a grid of friction, level, uplift, reservoir, size, scale, polarity and records; CSV",
        "damslip sweep examples/reference_dam.toml --friction 0.65:1.0:0.05 --uplift curtain,linear --scale 1,2");
    add_run_inputs(sub, p.sweep.inputs);
    sub->get_option("SCENE")->required(false); // --merge has none
    const auto list = [&](const char* flag, std::string& target, const std::string& text) {
        sub->add_option(flag, target, text)->group("Grid");
    };
    list("--friction", p.sweep.friction, "Coulomb mu: 1.00,0.84,0.77 or first:last:step 0.65:1.0:0.05");
    list("--friction-deg", p.sweep.friction_deg, "friction angles instead [deg]");
    list("--level", p.sweep.level, "water levels above the heel, at size 1 [m]");
    list("--uplift", p.sweep.uplift, uplift_words());
    list("--reservoir", p.sweep.reservoir,
         "auto, hydrostatic, acoustic, westergaard, westergaard-simplified, zangar, goldgruber");
    list("--size", p.sweep.size, "factors on all lengths of the scene: dam, rock, water, elements");
    list("--scale", p.sweep.scale, "factors on the records");
    list("--polarity", p.sweep.polarity, "1, -1 or both: 1,-1");
    list(
        "--method", p.sweep.method,
        "rigid (horizontal), rigid-v (with the vertical component), fe (finite elements with the scene's contact law), "
        "fe-exact, fe-penalty, fe-slip-tolerance, fe-whole-steps, fe-goldgruber-2015, fe-reduced, and regressions by "
        "id such as ambraseys-menu-1988, jibson-1993, jibson-1998");
    sub->add_option("--modes", p.sweep.modes, "elastic modes of fe-reduced (12)")->check(CLI::Range(1, 1000));
    sub->add_option("--penalty-stiffness", p.sweep.penalty_stiffness, "of fe-penalty [N/m3]")
        ->check(CLI::Range(1.0, 1e20));
    sub->add_option("--scheme", p.sweep.inputs.scheme, "exact (default) or slammer");
    sub->add_option(
           "-o,--out", p.sweep.out,
           "CSV file, beside it a report (.html) and a journal for --resume; without it the rows go to standard "
           "output")
        ->check(output_to(OutputPath::regular_file, "--out"));
    sub->add_option("-j,--jobs", p.sweep.jobs, "threads; 0: all cores")->check(CLI::Range(0, 1024));
    add_sweep_parts(sub, p.sweep);
    sub->callback([&p] { p.chosen = [a = p.sweep](const Streams& s) { return sweep(a, s); }; });
}

void add_study(Parser& p)
{
    CLI::App* sub = command(
        p, "study",
        "the study of Goldgruber (2015), chapter 4: 6 frictions, 3 uplifts, 3 waters, 2 sizes; figures and findings",
        "damslip study examples/thesis-study/dam.toml --out study");
    add_run_inputs(sub, p.study.inputs);
    sub->add_option("--method", p.study.method, "as of sweep; with fe the finite elements run to the default accuracy")
        ->capture_default_str();
    sub->add_option("-o,--out", p.study.out, "folder for rows.csv, findings.csv and report.html")
        ->check(output_to(OutputPath::folder, "--out"))
        ->required();
    sub->add_option("-j,--jobs", p.study.jobs, "threads; 0: all cores")->check(CLI::Range(0, 1024));
    sub->add_flag("--resume", p.study.resume, "go on where a study with the same --out stopped");
    sub->callback([&p] { p.chosen = [a = p.study](const Streams& s) { return study(a, s); }; });
}

void add_explain(Parser& p)
{
    CLI::App* sub = command(p, "explain", "the effect plan: what is taken into account, why, and what it costs",
                            "damslip explain examples/reference_dam.toml --ablate --report ablation.html");
    add_run_inputs(sub, p.explain.inputs);
    sub->add_option("--scale", p.explain.inputs.scale, "factor on all records")->group("Ground motion");
    sub->add_option("--friction", p.explain.inputs.friction, "Coulomb mu instead of the scene's");
    sub->add_option("--method", p.explain.method, "rigid or fe")
        ->check(CLI::IsMember({"rigid", "fe"}))
        ->capture_default_str();
    const char* const group = "Ablation";
    CLI::Option* ablate =
        sub->add_flag("--ablate", p.explain.ablate,
                      "runs the scene without each of its effects in turn: change of slip and crest motion, seconds")
            ->group(group);
    sub->add_option("--report", p.explain.report, "HTML file with the changes as charts")
        ->check(output_to(OutputPath::file, "--report"))
        ->needs(ablate)
        ->group(group);
    sub->add_option("-j,--jobs", p.explain.jobs, "threads; 0: all cores; with 1 (default) the seconds are fair")
        ->check(CLI::Range(0, 1024))
        ->needs(ablate)
        ->group(group);
    sub->callback([&p] { p.chosen = [a = p.explain](const Streams& s) { return explain(a, s); }; });
}

void add_fe(Parser& p)
{
    CLI::App* sub = command(p, "fe", "staged finite-element run: gravity, impounding, uplift, earthquake",
                            "damslip fe examples/reference_dam.toml --out results/fe");
    add_run_inputs(sub, p.fe.inputs);
    sub->add_option("--scale", p.fe.inputs.scale, "factor on all records")->group("Ground motion");
    sub->add_option(
           "--polarity", p.fe.polarity,
           "run 1 or -1 alone; -1 flips the horizontal component (default: both, or motion.polarity of the scene)")
        ->check(CLI::IsMember({1, -1}))
        ->group("Ground motion");
    sub->add_option("--friction", p.fe.inputs.friction, "Coulomb mu instead of the scene's");
    sub->add_option("--base", p.fe.base, "contact: the dam slides, opens and rocks; tied: it is bonded to its base")
        ->check(CLI::IsMember({"contact", "tied"}))
        ->capture_default_str();
    sub->add_flag("!--no-mesh-error", p.fe.mesh_error,
                  "leave out the run on elements of twice the size that tells what the mesh leaves open of the slip");
    CLI::Option* reduced =
        sub->add_flag("--reduced", p.fe.reduced, "earthquake on few modes of the dam; slip with an error estimate")
            ->group("Reduced run");
    sub->add_option("--modes", p.fe.modes, "elastic modes kept (12)")
        ->check(CLI::Range(1, 1000))
        ->needs(reduced)
        ->group("Reduced run");
    reduced->excludes(sub->get_option("--base"));
    sub->add_option("--out", p.fe.out, "folder for summary.json, histories (CSV), fields (VTU) and the resolved scene")
        ->check(output_to(OutputPath::folder, "--out"));
    sub->callback([&p] { p.chosen = [a = p.fe](const Streams& s) { return fe(a, s); }; });
}

void add_modes(Parser& p)
{
    CLI::App* sub =
        command(p, "modes", "natural frequencies, effective masses, Rayleigh and modified Rayleigh coefficients",
                "damslip modes examples/reference_dam.toml --count 5");
    add_run_inputs(sub, p.modes.inputs);
    sub->add_option("-n,--count", p.modes.count, "number of modes")->check(CLI::Range(1, 200))->capture_default_str();
    sub->add_flag("--frf", p.modes.frequency_response,
                  "transfer functions ground to crest and to the water's force, 0.1 ... 20 Hz");
    sub->add_option("--out", p.modes.out, "folder for the mode shapes as VTU files and the transfer functions as CSV")
        ->check(output_to(OutputPath::folder, "--out"));
    sub->callback([&p] { p.chosen = [a = p.modes](const Streams& s) { return modes(a, s); }; });
}

void add_mesh(Parser& p)
{
    CLI::App* sub = command(p, "mesh", "the finite-element mesh of a scene: sizes and shapes; written for Gmsh",
                            "damslip mesh examples/reference_dam.toml --out dam.msh");
    add_scene(sub, p.mesh.inputs);
    sub->add_option("--out", p.mesh.out, "Gmsh file (.msh, ASCII) with physical groups, as mesh.file reads it")
        ->check(output_to(OutputPath::file, "--out"));
    sub->add_option("--format", p.mesh.format, "version of the Gmsh file")
        ->check(CLI::IsMember({"2.2", "4.1"}))
        ->capture_default_str();
    sub->add_option("--base", p.mesh.base, "nodes between dam and rock in the Gmsh file: twice, or shared by both")
        ->check(CLI::IsMember({"twice", "shared"}))
        ->capture_default_str();
    sub->callback([&p] { p.chosen = [a = p.mesh](const Streams& s) { return mesh(a, s); }; });
}

void add_accuracy(Parser& p)
{
    CLI::App* sub = command(p, "accuracy", "what accuracy costs: every method on this scene, its error and its seconds",
                            "damslip accuracy examples/reference_dam.toml --tolerance 0.02 --out results/accuracy");
    AccuracyArguments& a = p.accuracy;
    add_run_inputs(sub, a.inputs);
    sub->add_option("--scale", a.inputs.scale, "factor on all records")->group("Ground motion");
    sub->add_flag("--all-records", a.all_records, "all records of the scene, the worst counts; else its first")
        ->group("Ground motion");
    sub->add_option("--friction", a.inputs.friction, "Coulomb mu instead of the scene's");
    sub->add_option("--tolerance", a.tolerance, "names the cheapest rung within this share of the finest's slip")
        ->capture_default_str();
    sub->add_option("--repeats", a.repeats, "runs of a rung for its median time; fewer of rungs above a second")
        ->capture_default_str();
    sub->add_option("--budget", a.budget,
                    "processor seconds for all rungs together; what would exceed them is listed as skipped")
        ->capture_default_str();
    sub->add_flag("--quick", a.quick, "fewer steps, no finer mesh, one reduced run, no other contact law or scheme");
    sub->add_option("--rung", a.rung, "run this rung alone, named as in the table: fe-acoustic:dt/4,2h");
    sub->add_option("--out", a.out,
                    "folder for report.html, accuracy.csv, accuracy.svg, summary.json and the rungs' scenes")
        ->check(output_to(OutputPath::folder, "--out"));
    sub->add_option("--report", a.report, "the report alone (.html)")->check(output_to(OutputPath::file, "--report"));
    sub->add_option("--svg", a.svg, "the chart alone (.svg)")->check(output_to(OutputPath::file, "--svg"));
    sub->callback([&p] { p.chosen = [a = p.accuracy](const Streams& s) { return accuracy(a, s); }; });
}

void add_small_commands(Parser& p)
{
    CLI::App* check = command(p, "verify", "closed-form and published cases: expected, computed, error, pass",
                              "damslip verify sliding.block");
    check->add_option("FILTER", p.verify.filter, "part of the case ids to run");
    check->add_flag("--hard", p.verify.hard, "scenes chosen to break the numerics instead: two methods each");
    check->add_flag("--markdown", p.verify.markdown, "print docs/verification.md");
    check->callback([&p] { p.chosen = [a = p.verify](const Streams& s) { return verify(a, s); }; });

    CLI::App* schema = command(p, "schema", "JSON Schema of the scene file", "damslip schema > scene.schema.json");
    schema->add_flag("--markdown", p.schema.markdown, "the same keys as a Markdown document");
    schema->callback([&p] { p.chosen = [a = p.schema](const Streams& s) { return print_schema(a, s); }; });

    CLI::App* complete =
        command(p, "completion", "completion script for bash, zsh or fish", "source <(damslip completion bash)");
    complete->add_option("SHELL", p.shell, "bash, zsh or fish")->required();
    complete->callback([&p] { p.chosen = [shell = p.shell](const Streams& s) { return completion(shell, s); }; });

    CLI::App* pages = command(p, "man", "manual pages, made from the help texts", "damslip man fe | man -l -");
    pages->add_option("COMMAND", p.man.command, "the command whose page is printed; none: the program's own");
    pages->add_option("--out", p.man.out, "folder for the pages of all commands")
        ->check(output_to(OutputPath::folder, "--out"));
    pages->callback([&p] { p.chosen = [a = p.man](const Streams& s) { return man(a, s); }; });
}

void build(Parser& p)
{
    p.app.set_version_flag("--version", "damslip " + program_version());
    p.app.require_subcommand(1);
    p.app.footer(std::string("Examples:\n  damslip screen examples/reference_dam.toml\n  damslip sweep "
                             "examples/reference_dam.toml --friction 0.65:1.0:0.05\n") +
                 exit_codes);
    add_screen(p);
    add_sweep(p);
    add_study(p);
    add_fe(p);
    add_modes(p);
    add_mesh(p);
    add_explain(p);
    add_accuracy(p);
    add_record_commands(p.app, p, p.record);
    add_small_commands(p);
}

std::vector<std::string> command_names(const CLI::App& app)
{
    std::vector<std::string> names;
    for (const CLI::App* sub : app.get_subcommands([](const CLI::App*) { return true; }))
        names.push_back(sub->get_name());
    return names;
}

std::vector<std::string> flag_names(const CLI::App& app)
{
    std::vector<std::string> flags;
    for (const CLI::Option* option : app.get_options())
        for (const std::string& name : option->get_lnames()) flags.push_back("--" + name);
    return flags;
}

[[noreturn]] void unknown(const std::string& what, const std::string& word, const std::string& where,
                          const std::vector<std::string>& known, const std::string& help)
{
    const std::string_view near = nearest(word, known);
    throw UsageError(Diagnostic{"", 0, 0,
                                fmt::format("unknown {} {}{}.{}", what, word, where,
                                            near.empty() ? "" : fmt::format(" Did you mean {}?", near)),
                                fmt::format("{}", fmt::join(known, ", ")), "run  " + help});
}

/// Misspelt commands and flags, which CLI11 would report without a suggestion.
void check_spelling(const CLI::App& top, const std::vector<std::string>& arguments)
{
    const CLI::App* app = &top;
    std::string path = "damslip";
    for (const std::string& word : arguments) {
        if (word == "--") return;
        if (word.size() > 2 && word.starts_with("--")) {
            const std::string flag = word.substr(0, word.find('='));
            const std::vector<std::string> known = flag_names(*app);
            if (std::find(known.begin(), known.end(), flag) == known.end())
                unknown("flag", flag, " of " + path, known, path + " --help");
        } else if (const std::vector<std::string> names = command_names(*app);
                   !names.empty() && !word.starts_with("-")) {
            if (std::find(names.begin(), names.end(), word) == names.end())
                unknown("command", word, app == &top ? "" : " of " + path, names, path + " --help");
            app = app->get_subcommand(word);
            path += " " + word;
        }
    }
}

} // namespace

CLI::App* add_command(CLI::App& parent, ParserBase& base, const std::string& name, const std::string& description,
                      const std::string& example)
{
    CLI::App* sub = parent.add_subcommand(name, description);
    sub->footer("Example:\n  " + example);
    sub->add_flag("--json", base.json, "one JSON object on standard output, for machines");
    sub->add_flag("-q,--quiet", base.quiet, "no progress, no talk");
    return sub;
}

std::function<std::string(const std::string&)> output_to(OutputPath kind, const std::string& flag)
{
    return [kind, flag](const std::string& path) -> std::string {
        if (auto problem = output_path_problem(path, kind, flag)) throw UsageError(std::move(*problem));
        return {};
    };
}

Invocation parse_arguments(const std::vector<std::string>& arguments)
{
    Parser parser;
    build(parser);
    if (arguments.empty()) throw HelpText{parser.app.help()};
    check_spelling(parser.app, arguments);
    try {
        parser.app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
    } catch (const CLI::CallForHelp&) {
        throw HelpText{parser.app.help()}; // of the command that was named, with the way to it: "damslip record info"
    } catch (const CLI::CallForVersion& version) {
        throw HelpText{std::string(version.what()) + "\n"};
    } catch (const CLI::ParseError& error) {
        throw UsageError(Diagnostic{"", 0, 0, error.what(), "", "run  damslip --help  or  damslip COMMAND --help"});
    }
    return {parser.chosen, parser.json ? Form::json : Form::text, parser.quiet};
}

std::vector<CommandSummary> command_summaries()
{
    Parser parser;
    build(parser);
    return summaries_of(parser.app);
}

} // namespace damslip::cli
