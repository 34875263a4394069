#include "analysis/accuracy/accuracy.hpp"
#include "analysis/accuracy/hierarchy.hpp"
#include "analysis/accuracy/model_level_runner.hpp"
#include "analysis/assess/assess.hpp"
#include "analysis/fragility/fragility_study.hpp"
#include "analysis/prepare/ready.hpp"
#include "cli/command.hpp"
#include "cli/input/run_inputs.hpp"
#include "cli/terminal/terminal.hpp"
#include "cli/verifier.hpp"
#include "core/file.hpp"
#include "core/input_error.hpp"
#include "core/parallel.hpp"
#include "core/text.hpp"
#include "core/units.hpp"
#include "pages/accuracy/accuracy_pages.hpp"
#include "pages/fragility/fragility_pages.hpp"
#include "pages/report/page.hpp"
#include "pages/report/table_text.hpp"
#include "pages/scene/scene_pages.hpp"
#include "scene/plausible.hpp"
#include "scene/write.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <ostream>

namespace damslip::cli {

using namespace pages;

namespace {

struct AccuracyArguments {
    RunInputs inputs;
    double tolerance = 0.02;      ///< of the deviation from the finest model level [-]
    int repeats = 3;              ///< of short model levels
    double budget = 300.0;        ///< processor time of all model levels together [s]
    bool quick = false;           ///< fewer model levels
    bool all_records = false;     ///< else the first
    std::string model_level;             ///< run this one alone; empty: the hierarchy
    std::filesystem::path out;    ///< folder for report, tables, figure and the model levels' scenes; empty: none
    std::filesystem::path report; ///< the report alone; empty: none
    std::filesystem::path pdf;    ///< the report on paper; empty: none
    std::filesystem::path svg;    ///< the figure alone; empty: none
    bool probability = false;     ///< what the interval of a probability costs, in place of the hierarchy
    std::string method;           ///< of --probability: as of fragility; empty: rigid-v or rigid
    std::optional<double> level;  ///< of --probability, in the unit of the levels; none: P nearest to 0.1
    std::optional<int> samples; ///< of --probability: runs of the largest estimate; none: 16384, of finite elements 128
    int jobs = 0;               ///< of --probability: threads; 0: all cores
};

void check(const AccuracyArguments& a)
{
    if (!a.pdf.empty() && !a.model_level.empty())
        refuse_usage("--pdf with --model-level.", "a report of all model levels", "leave one of them out");
    if (!(a.tolerance > 0.0 && std::isfinite(a.tolerance)))
        refuse_usage(fmt::format("--tolerance {} is not allowed.", a.tolerance), "a share of the slip > 0",
                     "for 2 % write  --tolerance 0.02");
    if (a.repeats < 1)
        refuse_usage(fmt::format("--repeats {} is not allowed.", a.repeats), "1 or more", "write  --repeats 3");
    if (!(a.budget > 0.0))
        refuse_usage(fmt::format("--budget {} is not allowed.", a.budget), "seconds > 0", "for example  --budget 60");
    for (const auto& [flag, given] : {std::pair{"--method", !a.method.empty()},
                                      {"--level", a.level.has_value()},
                                      {"--samples", a.samples.has_value()}})
        if (given && !a.probability)
            refuse_usage(fmt::format("{} without --probability.", flag), "both", "add  --probability");
    if (!a.model_level.empty() && !parse_model_level(a.model_level))
        refuse_usage("--model-level " + a.model_level + " is not known.", "a model level as the table names it",
                     "for example  --model-level fe-added-mass:dt/4  or  --model-level rigid:h");
}

/// The command that runs one model level with the same scene and records.
std::string command_of(const AccuracyArguments& a, const ModelLevel& model_level)
{
    std::string command = "damslip accuracy " + shell_words(a.inputs);
    if (a.inputs.scale) command += " --scale " + shortest(*a.inputs.scale);
    if (a.inputs.friction) command += " --friction " + shortest(*a.inputs.friction);
    if (a.all_records) command += " --all-records";
    return command + " --model-level " + shell_quoted(model_level_id(model_level));
}

struct Loaded {
    Scene scene;
    Records records;
    double seconds = 0.0;
    std::size_t in_scene = 0; ///< records of the scene, whether used or not
};

Loaded load(const AccuracyArguments& a, const Streams& streams)
{
    const ProcessorClock clock(ProcessorTimeOf::process);
    Loaded loaded{read_run_scene(a.inputs, streams), {}, 0.0, 0};
    need_section(loaded.scene, "damslip accuracy",
                 "the slip of a wedge is exact for its record: damslip screen SCENE gives it");
    if (loaded.scene.mesh.file)
        throw UsageError(Diagnostic{loaded.scene.file.string(), 0, 0, "accuracy with mesh.file.",
                                    "the program's own mesh: the study changes the size of its elements",
                                    "delete mesh.file, or compare meshes of your own with  damslip fe"});
    if (!loaded.scene.motion.sequence.empty())
        throw UsageError(Diagnostic{loaded.scene.file.string(), 0, 0, "accuracy with motion.sequence.",
                                    "records each alone: the study compares methods on one record",
                                    "delete sequence, or give the record with  --record FILE"});
    loaded.in_scene = loaded.scene.motion.records.size();
    if (loaded.in_scene == 0)
        refuse(a.inputs.scene, "the scene has no record.", "a [[motion.record]], or --record", "add  --record FILE");
    if (!a.all_records && a.inputs.records.empty()) loaded.scene.motion.records.resize(1);
    loaded.records = load_records(loaded.scene, Method::finite_elements);
    loaded.seconds = clock.seconds();
    return loaded;
}

std::vector<std::string> messages_of(const HierarchyFacts& facts, const Loaded& loaded,
                                     const std::vector<ModelLevelResult>& results, bool interrupted)
{
    std::vector<std::string> messages;
    if (const std::optional<std::string> note = base_note(loaded.scene)) messages.push_back(*note + ".");
    for (std::string& note : note_texts(loaded.scene.notes)) messages.push_back(std::move(note));
    messages.insert(messages.end(), facts.left_out.begin(), facts.left_out.end());
    if (loaded.records->size() < loaded.in_scene)
        messages.push_back(fmt::format("Only the first of the scene's {} records is used: {}. With --all-records the "
                                       "worst counts.",
                                       loaded.in_scene, loaded.records->front().files.name));
    messages.push_back(fmt::format("Every model level is run with {}.", polarity_words(polarities_of(loaded.scene))));
    for (const ModelLevelResult& r : results)
        if (!r.done())
            messages.push_back(fmt::format("{} {}: {}", model_level_id(r.model_level),
                                           r.skipped ? "skipped" : word(r.status), r.remark));
    if (interrupted) messages.push_back("Interrupted: the model levels that were finished count.");
    return messages;
}

/// Scenes of the finite-element model levels, for `fe`.
void write_model_level_scenes(const std::filesystem::path& out, const Scene& scene, const std::vector<ModelLevelResult>& results)
{
    for (const ModelLevelResult& r : results)
        if (r.done() && r.model_level.family == ModelLevelFamily::finite_elements)
            write_file(out / "rungs" / (file_word(model_level_id(r.model_level)) + ".toml"), resolved_toml(scene_of(scene, r.model_level)));
}

void write_csv(const std::filesystem::path& out, const Scene& scene, const std::vector<ModelLevelResult>& results,
               double tolerance)
{
    write_file(out / "accuracy.csv", accuracy_csv(scene, results, judge_model_levels(results, tolerance)));
}

/// One model level alone: its slip, by motion.
int run_one(const AccuracyArguments& a, const Loaded& loaded, const ModelLevelRunner& runner, const Streams& streams)
{
    const ModelLevel model_level = *parse_model_level(a.model_level);
    const ModelLevelResult result = runner.run(model_level);
    if (result.status == Status::refused)
        refuse(a.inputs.scene, fmt::format("--model-level {} is refused: {}", a.model_level, result.remark),
               "a model level that this scene admits", "leave --model-level out: the table lists those that run");
    const std::vector<MotionName> motions = motion_names(loaded.scene, *loaded.records);
    put_answer(one_model_level_answer(result, motions), "--out DIR", streams);
    if (!a.out.empty()) {
        write_file(a.out / "scene.toml", resolved_toml(scene_of(loaded.scene, model_level)));
        if (!streams.quiet && model_level.family == ModelLevelFamily::finite_elements)
            streams.talk << "histories and fields:  damslip fe " << shell_quoted((a.out / "scene.toml").string())
                         << (model_level.modes ? fmt::format(" --reduced --modes {}", *model_level.modes) : "") << " --out "
                         << shell_quoted(a.out.string()) << "\n";
    }
    return status_row(result.status).exit_code;
}

std::vector<ModelLevelResult> run_aloud(const AccuracyArguments& a, const Loaded& loaded, const ModelLevelRunner& runner,
                                    const HierarchyFacts& facts, Watch& watch, const Streams& streams)
{
    HierarchyRunOptions options;
    options.hierarchy = {a.quick ? Effort::quick : Effort::full, a.tolerance};
    options.repeats = a.repeats;
    options.budget = a.budget;
    Stopwatch since_line;
    const auto line_is_due = [&] { // where no terminal is: one each ten seconds
        if (streams.quiet || streams.terminal || since_line.seconds() < 10.0) return false;
        since_line = Stopwatch();
        return true;
    };
    HierarchyCalls calls;
    calls.run = [&](const ModelLevel& model_level) { return runner.run(model_level); };
    calls.least_seconds = [&](const ModelLevel& model_level) { return runner.least_seconds(model_level); };
    calls.interrupted = [&] { return watch.stop_asked(); };
    calls.begins = [&](const ModelLevel& model_level) {
        if (streams.bar)
            *streams.bar << "  " << model_level_id(model_level) << " ..." << std::flush;
        else if (line_is_due())
            streams.talk << "accuracy: " << model_level_id(model_level) << " begins\n" << std::flush;
    };
    calls.ends = [&](const std::vector<ModelLevelResult>& results) {
        const ModelLevelResult& r = results.back();
        watch.results_at_hand();
        const std::string said =
            r.done() ? fmt::format("{:<32} {:>10.5g} mm {:>9.3g} s", model_level_id(r.model_level), r.largest_slip() / units::mm,
                                   r.seconds)
                     : fmt::format("{:<32} {}: {}", model_level_id(r.model_level),
                                   r.skipped ? "skipped" : word(r.status), r.remark);
        if (streams.bar)
            *streams.bar << "\r  " << said << "\n";
        else if (line_is_due())
            streams.talk << "accuracy: " << said << "\n" << std::flush;
        if (!a.out.empty()) write_csv(a.out, loaded.scene, results, a.tolerance); // what is finished is not lost
    };
    const Stopwatch start;
    std::vector<ModelLevelResult> results = run_hierarchy(facts, options, calls);
    if (!streams.quiet && !streams.terminal)
        streams.talk << fmt::format("accuracy: {} model level{}, {:.3g} s\n", results.size(),
                                    results.size() == 1 ? "" : "s", start.seconds());
    return results;
}

void check_probability_flags(const AccuracyArguments& a)
{
    const RunInputs& in = a.inputs;
    for (const auto& [flag, given] : {std::pair{"--model-level", !a.model_level.empty()},
                                      {"--quick", a.quick},
                                      {"--all-records", a.all_records},
                                      {"--record", !in.records.empty()},
                                      {"--friction", in.friction.has_value()},
                                      {"--scale", in.scale.has_value()},
                                      {"--svg", !a.svg.empty()}})
        if (given)
            refuse_usage(fmt::format("--probability together with {}.", flag),
                         "the scene's own tables [probability], [suite], [intensity], [[limit]]", "leave one out");
    need_scene_file(in, "--probability");
}

/// The half-width of the 95 % interval of P at one level over processor time, by several estimators (interval_cost()).
/// @returns exit_no_answer where the budget allows no estimate, or after an interrupt
int accuracy_of_probability(const AccuracyArguments& a, const Streams& streams)
{
    check_probability_flags(a);
    const SceneText text = SceneText::read(a.inputs.scene);
    Scene scene = text.scene();
    say(scene.notes, a.inputs.strict, streams);
    FragilityInput input = read_fragility_input(a.inputs.scene);
    const FragilityStudy study = open_fragility(text, std::move(scene), std::move(input), a.method);
    const bool finite_elements = study.finite_elements();
    IntervalCostOptions options;
    options.method = study.method.id;
    options.rigid = study.rigid().id;
    if (a.level) options.level = *a.level * study.input.intensity.level_unit;
    options.runs = static_cast<std::size_t>(a.samples.value_or(finite_elements ? 128 : 16384));
    options.sizes = finite_elements ? 3 : 5;
    options.step = finite_elements ? 2 : 4;
    options.replicates = finite_elements ? 8 : 16;
    options.budget = a.budget;
    options.jobs = a.jobs;
    TerminalWatch watch(streams);
    const IntervalCost cost = interval_cost(study.input, study.suite, text, study.written, options, watch);
    const Answer answer = interval_cost_answer(study, cost);
    put_answer(answer, "--out DIR", streams);
    const auto page = [&] { return page_html(interval_cost_page(study, cost)); };
    if (!a.out.empty()) {
        answer.write(a.out, {fmt::format("scene {}", study.scene.file.string())});
        write_file(a.out / "report.html", page());
        name_report(a.out / "report.html", streams);
    }
    if (!a.report.empty()) write_file(a.report, page());
    if (!a.pdf.empty()) print_pdf(page(), a.pdf);
    const bool any =
        std::any_of(cost.points.begin(), cost.points.end(), [](const IntervalPoint& p) { return p.done(); });
    return any && !watch.stop_asked() ? exit_ok : exit_no_answer;
}

/// Runs the hierarchy of methods on a scene: slip, its error, its cost; names the cheapest model level within the tolerance.
/// @returns exit_no_answer where no model level is within it, or after an interrupt; what was computed is written all the
/// same.
int accuracy(const AccuracyArguments& a, const Streams& streams)
{
    check(a);
    if (a.probability) return accuracy_of_probability(a, streams);
    const Loaded loaded = load(a, streams);
    say_base(loaded.scene, streams);
    TerminalWatch watch(streams);
    BudgetWatchOf<ProcessorClock> budget(watch, a.budget);
    const ModelLevelRunner runner(loaded.scene, loaded.records, loaded.seconds, budget);
    if (!a.model_level.empty()) return run_one(a, loaded, runner, streams);

    const HierarchyFacts facts = runner.facts();
    const std::vector<ModelLevelResult> results = run_aloud(a, loaded, runner, facts, watch, streams);
    const Judgement judgement = judge_model_levels(results, a.tolerance);
    const std::vector<std::string> messages = messages_of(facts, loaded, results, watch.stop_asked());
    const std::string command = judgement.choice ? command_of(a, results[*judgement.choice].model_level) : "";
    const AccuracyReportInput in{loaded.scene, *loaded.records, results, judgement, a.tolerance, command, messages};
    const Answer answer = accuracy_answer(in);
    put_answer(answer, "--out DIR", streams);
    const auto page = [&] { return page_html(accuracy_page(in)); };
    const std::string figure = cost_figure(results, judgement, a.tolerance, figure_title(loaded.scene, *loaded.records),
                                           FigureStyle::standalone);
    if (!a.svg.empty() && !figure.empty()) write_file(a.svg, figure);
    if (!a.out.empty()) {
        write_csv(a.out, loaded.scene, results, a.tolerance);
        answer.write(a.out, {});
        write_file(a.out / "scene_resolved.toml", resolved_toml(loaded.scene));
        if (!figure.empty()) write_file(a.out / "accuracy.svg", figure);
        write_model_level_scenes(a.out, loaded.scene, results);
        write_file(a.out / "report.html", page());
        name_report(a.out / "report.html", streams);
    }
    if (!a.report.empty()) {
        write_file(a.report, page());
        name_report(a.report, streams);
    }
    if (!a.pdf.empty()) {
        print_pdf(page(), a.pdf);
        name_report(a.pdf, streams);
    }
    const bool answered = judgement.choice || all_fail_statically(results);
    return answered && !watch.stop_asked() ? exit_ok : exit_no_answer;
}

void accuracy_flags(CLI::App& sub, AccuracyArguments& a)
{
    add_run_inputs(sub, a.inputs);
    add_scale(sub, a.inputs);
    sub.add_flag("--all-records", a.all_records, "all records of the scene, the worst counts; else its first")
        ->group("Ground motion");
    add_friction(sub, a.inputs);
    sub.add_option("--tolerance", a.tolerance, "names the cheapest model level within this share of the finest's slip")
        ->capture_default_str();
    sub.add_option("--repeats", a.repeats, "runs of a model level for its median time; fewer of those above a second")
        ->capture_default_str();
    sub.add_option("--budget", a.budget,
                   "processor seconds for all model levels together; what would exceed them is listed as skipped")
        ->capture_default_str();
    sub.add_flag("--quick", a.quick, "fewer steps, no finer mesh, one reduced run, no other contact law or scheme");
    sub.add_option("--model-level,--rung", a.model_level, "run this model level alone, named as in the table: fe-acoustic:dt/4,2h");
    add_out(sub, a.out, OutputPath::folder,
            "folder for report.html, accuracy.csv, accuracy.svg, summary.json and the scenes of all model levels");
    sub.add_option("--report", a.report, "the report alone (.html)")->check(output_to(OutputPath::file, "--report"));
    add_pdf(sub, a.pdf);
    const char* const group = "Probability";
    sub.option_defaults()->group(group);
    sub.add_flag("--probability", a.probability,
                 "half-width of the 95 % interval of P over processor seconds, by plain Monte Carlo, Latin hypercubes "
                 "and Sobol' points; of a scene for fragility, its first limit");
    sub.add_option("--method", a.method, "as of fragility; default: rigid-v or rigid");
    sub.add_option("--level", a.level, "intensity in the unit of the levels; default: where P is nearest to 0.1")
        ->check(in_range(1e-9, 1e9));
    sub.add_option("--samples", a.samples, "runs of the largest estimate; default: 16384, of finite elements 128")
        ->check(CLI::Range(16, 10'000'000));
    add_jobs(sub, a.jobs);
    sub.option_defaults()->group("Options");
    sub.add_option("--svg", a.svg, "the chart alone (.svg)")->check(output_to(OutputPath::file, "--svg"));
}

} // namespace

Command accuracy_command()
{
    return {"accuracy", "what accuracy costs: every method on this scene, its error and its seconds",
            "damslip accuracy examples/reference_dam.toml --tolerance 0.02 --out results/accuracy",
            with_flags<AccuracyArguments>(accuracy_flags, accuracy)};
}

} // namespace damslip::cli
