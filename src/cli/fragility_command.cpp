#include "analysis/fragility/fragility_study.hpp"
#include "cli/command.hpp"
#include "cli/input/run_inputs.hpp"
#include "cli/sweep_command.hpp"
#include "cli/terminal/terminal.hpp"
#include "cli/verifier.hpp"
#include "core/file.hpp"
#include "core/input_error.hpp"
#include "core/parallel.hpp"
#include "pages/fragility/fragility_pages.hpp"
#include "pages/report/page.hpp"
#include "pages/report/table_text.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <ostream>

namespace damslip::cli {

using namespace pages;

namespace {

struct FragilityArguments {
    RunInputs inputs; ///< SCENE and --strict
    std::string
        method; ///< rigid, rigid-v, fe, fe-exact, ...; empty: rigid-v where a record has a vertical component, else rigid
    std::optional<int> samples;        ///< runs per level; none: 1024 of the rigid block, 128 of finite elements
    std::string conditioning = "auto"; ///< on, off, auto: friction is not drawn for each run, but where it matters
    std::optional<double> aim;         ///< P that has to be known best, where friction is conditioned on
    std::optional<double> budget;      ///< processor seconds of finite elements in place of samples
    int rows = 128;                    ///< of each sample of the shares; 0: none
    std::filesystem::path out;         ///< folder; empty: no files
    std::filesystem::path pdf;         ///< the report on paper; empty: none
    int jobs = 0;                      ///< threads; 0: all cores
    bool allow_scaling = false;        ///< records beyond suite.max_scale
    bool resume = false, merge = false;
    std::string shard;                 ///< "i/n"
    std::filesystem::path slurm_array; ///< write a job script for all parts here instead
    int parts = 8;                     ///< of it
};

void check_fragility_flags(const FragilityArguments& a)
{
    if (a.out.empty())
        for (const auto& [flag, given] : {std::pair{"--resume", a.resume},
                                          {"--shard", !a.shard.empty()},
                                          {"--merge", a.merge},
                                          {"--slurm-array", !a.slurm_array.empty()}})
            if (given) refuse_usage(fmt::format("{} without --out.", flag), "both", "add  --out results/fragility");
    if (a.merge && !a.shard.empty()) refuse_usage("--merge together with --shard.", "one of them", "leave one out");
    if (a.budget && a.samples) refuse_usage("--budget together with --samples.", "one of them", "leave one out");
    for (const auto& [flag, given] : {std::pair{"--resume", a.resume},
                                      {"--shard", !a.shard.empty()},
                                      {"--merge", a.merge},
                                      {"--slurm-array", !a.slurm_array.empty()}})
        if (a.budget && given)
            refuse_usage(fmt::format("--budget together with {}.", flag),
                         "a number of runs that does not depend on the machine's pace",
                         "write the  --samples  that the run with --budget prints");
    for (const auto& [flag, given] :
         {std::pair{"--shard", !a.shard.empty()}, {"--slurm-array", !a.slurm_array.empty()}})
        if (!a.pdf.empty() && given)
            refuse_usage(fmt::format("--pdf together with {}.", flag), "a report of all runs",
                         "leave it out here, and add it to the  --merge  of all parts");
    need_scene_file(a.inputs, "fragility");
}

/// Runs per level that the budget pays for.
std::size_t samples_by_budget(const FragilityArguments& a, const FragilityStudy& study, const Streams& streams)
{
    TerminalWatch watch(streams);
    const BudgetPilot pilot = pilot_of_budget(study, *a.budget, a.jobs, watch);
    if (!streams.quiet)
        streams.talk << fmt::format("pilot: {} runs, {:.3g} processor seconds each; --samples {}\n", pilot.runs,
                                    pilot.seconds_per_run, pilot.samples);
    return pilot.samples;
}

std::filesystem::path store_file(const std::filesystem::path& out, const Shard& shard)
{
    return store_of(out / "samples.csv", shard.count > 1 ? std::optional(shard) : std::nullopt);
}

/// How many parts there are stores of. @throws InputError where there are none
std::size_t parts_in(const std::filesystem::path& folder)
{
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        const std::size_t of = name.find("-of-");
        if (!name.starts_with("samples.") || !name.ends_with(".sqlite") || of == std::string::npos) continue;
        const std::size_t n = std::strtoull(name.c_str() + of + 4, nullptr, 10);
        if (n > 0) return n;
    }
    refuse(folder, "there is no part of a fragility here.", "databases samples.0-of-3.sqlite ... of --shard",
           "run the parts first");
}

/// The rows of all parts.
FragilityRuns merged_runs(const std::filesystem::path& out, const FragilityPlan& plan, const SweepIdentity& identity,
                          Yields yields)
{
    const std::size_t n = parts_in(out);
    FragilityRuns runs = no_runs(plan, plan.samples.size(), yields);
    for (std::size_t i = 0; i < n; ++i) {
        const Shard shard{i, n};
        const std::filesystem::path file = store_file(out, shard);
        if (!std::filesystem::exists(file))
            refuse(file, "this part is missing.", fmt::format("the databases of all {} parts", n),
                   fmt::format("run  --shard {}/{}", i, n));
        const ResultStore store(file, identity, shard, StoreStart::resume);
        take_finished(store, 0, plan.samples.size(), runs);
    }
    if (!runs.complete())
        refuse(out, fmt::format("{} of {} runs are finished.", runs.finished(), runs.wanted), "all runs of all parts",
               "run the parts again with --resume");
    return runs;
}

/// Some thousand rows at a time.
void write_samples(const std::filesystem::path& file, const FragilityView& view,
                   const std::vector<std::string>& comments)
{
    constexpr std::size_t at_once = 4096;
    FileWriter writer(file);
    CsvLines lines;
    for (std::size_t first = 0; first == 0 || first < view.plan.samples.size(); first += at_once) {
        const Table part = sample_table(view, first, first + at_once);
        std::string text = first == 0 ? csv_head(part.columns, comments) : "";
        for (const auto& row : part.rows) lines.add(row, text);
        writer.write(text);
    }
    writer.finish();
}

void write_files(const std::filesystem::path& out, const FragilityView& view, const Answer& answer,
                 const SweepIdentity& identity)
{
    const std::vector<std::string> comments = {"damslip " + identity.version + " fragility", "scene " + identity.scene,
                                               "runs " + hash_of(identity)};
    write_samples(out / "samples.csv", view, comments);
    write_file(out / "fragility.csv", csv(fragility_table(view), comments));
    if (const Table rates = rate_part_table(view); !rates.rows.empty())
        write_file(out / "hazard_shares.csv", csv(rates, comments));
    answer.write(out, {});
    write_file(out / "report.html", page_html(fragility_page(view)));
    if (const std::string usace = fragility_usace(view); !usace.empty()) write_file(out / "usace.json", usace);
    if (const std::string nrml = fragility_nrml(view); !nrml.empty()) write_file(out / "fragility.xml", nrml);
}

int write_slurm(const FragilityArguments& a, const Streams& streams)
{
    std::string line = "damslip fragility " + shell_quoted(a.inputs.scene.string());
    if (!a.method.empty()) line += " --method " + a.method;
    if (a.samples) line += fmt::format(" --samples {}", *a.samples);
    if (a.aim) line += fmt::format(" --aim-at {}", *a.aim);
    if (a.conditioning != "auto") line += " --conditioning " + a.conditioning;
    line += fmt::format(" --share-rows {}", a.rows);
    if (a.allow_scaling) line += " --allow-scaling";
    line += " --out " + shell_quoted(a.out.string());
    const std::string parts =
        slurm_head("damslip-fragility", static_cast<std::size_t>(a.parts), a.jobs) +
        fmt::format("# A part that was stopped goes on when it is submitted again. When all parts "
                    "are there:\n#   {} --merge\n",
                    line) +
        slurm_exec(line, static_cast<std::size_t>(a.parts));
    write_file(a.slurm_array, parts);
    if (!streams.quiet) streams.talk << fmt::format("{} parts; afterwards:  {} --merge\n", a.parts, line);
    return exit_ok;
}

Conditioning conditioning_of(const std::string& word)
{
    return word == "on" ? Conditioning::on : word == "off" ? Conditioning::off : Conditioning::automatic;
}

/// Where the time of this start went. A file of its own, as all others have to have the same bytes again.
void tell_time(double wall, const FragilityArguments& a, const Streams& streams)
{
    const int threads = thread_count(a.jobs);
    const double solvers = seconds_in_solvers(), share = solvers / (wall * threads);
    if (!streams.quiet && streams.form != Form::text)
        streams.talk << fmt::format("{:.3g} s on {} threads, {:.1f} % of it in solvers\n", wall, threads,
                                    100.0 * share);
    const nlohmann::ordered_json times = {
        {"wall_s", wall}, {"threads", threads}, {"in_solvers_s", solvers}, {"share_in_solvers", share}};
    if (!a.out.empty()) write_file(a.out / "times.json", times.dump(2) + "\n");
}

int finish_fragility(const FragilityArguments& a, const FragilityStudy& study, const FragilityPlan& plan,
                     const FragilityRuns& runs, const ConditionedPlan* conditioned, const Streams& streams,
                     Watch& watch)
{
    const FragilityExtras extras{static_cast<std::size_t>(a.rows), a.jobs};
    const FragilityAnswer answer = answer_fragility(study, plan, runs, extras, watch, conditioned);
    const FragilityView view{study, plan, runs, answer};
    const Answer shown = fragility_answer(view);
    put_answer(shown, "--out DIR", streams);
    if (!a.out.empty()) write_files(a.out, view, shown, fragility_identity(plan, study.text, study.method.id));
    if (!a.pdf.empty()) {
        print_pdf(page_html(fragility_page(view)), a.pdf);
        name_report(a.pdf, streams);
    }
    return answer.answered ? exit_ok : exit_no_answer;
}

int fragility(const FragilityArguments& a, const Streams& streams)
{
    check_fragility_flags(a);
    const Stopwatch time;
    const SceneText text = SceneText::read(a.inputs.scene);
    Scene scene = text.scene();
    say(scene.notes, a.inputs.strict, streams);
    FragilityInput input = read_fragility_input(a.inputs.scene);
    if (a.allow_scaling) allow_any_scaling(input);
    if (!a.slurm_array.empty()) {
        check_fragility(input, text);
        return write_slurm(a, streams);
    }
    const FragilityStudy study = open_fragility(text, std::move(scene), std::move(input), a.method);
    if (!study.suite.made.empty()) streams.remark(study.suite.made);
    if (!a.out.empty()) make_folder(a.out);
    const std::size_t samples = a.budget    ? samples_by_budget(a, study, streams)
                                : a.samples ? static_cast<std::size_t>(*a.samples)
                                            : study.usual_samples();
    TerminalWatch watch(streams);
    const std::optional<ConditionedPlan> by_friction =
        condition_on_friction(study, conditioning_of(a.conditioning), samples, a.jobs, watch, a.aim);
    const ConditionedPlan* const conditioned = by_friction ? &*by_friction : nullptr;
    const FragilityPlan plan = conditioned ? conditioned->plan : study.plan(samples);
    const SweepIdentity identity = fragility_identity(plan, text, study.method.id);
    if (a.merge) {
        const FragilityRuns runs = merged_runs(a.out, plan, identity, study.yields());
        const int code = finish_fragility(a, study, plan, runs, conditioned, streams, watch);
        if (!a.out.empty()) name_report(a.out / "report.html", streams);
        return code;
    }
    const Shard shard = a.shard.empty() ? Shard{} : parse_shard(a.shard, "--shard");
    std::optional<ResultStore> store;
    if (!a.out.empty())
        store.emplace(store_file(a.out, shard), identity, shard, a.resume ? StoreStart::resume : StoreStart::fresh);
    const FragilityRuns runs = run_fragility(plan, text, study.method, wanted_samples(plan, shard),
                                             store ? &*store : nullptr, a.jobs, watch, study.yields());
    if (!streams.quiet && runs.found) streams.talk << fmt::format("{} runs were finished before\n", runs.found);
    if (!runs.complete()) {
        streams.talk << fmt::format("interrupted: {} of {} runs are finished{}\n", runs.finished(), runs.wanted,
                                    store ? "; go on with --resume" : "");
        return exit_no_answer;
    }
    if (shard.count > 1) {
        store->mark_done();
        if (!streams.quiet)
            streams.talk << fmt::format("part {}/{}: {} runs; when all parts are there:  --merge\n", shard.index,
                                        shard.count, runs.wanted);
        return exit_ok;
    }
    const int code = finish_fragility(a, study, plan, runs, conditioned, streams, watch);
    if (store) store->mark_done();
    tell_time(time.seconds(), a, streams);
    if (!a.out.empty()) name_report(a.out / "report.html", streams);
    return code;
}

void fragility_flags(CLI::App& sub, FragilityArguments& a)
{
    add_scene(sub, a.inputs);
    sub.add_option("--method", a.method,
                   "rigid (horizontal), rigid-v (with the vertical component), rocking (a block that rocks and "
                   "slides), fe, fe-exact, fe-penalty, "
                   "fe-slip-tolerance, fe-whole-steps, "
                   "fe-radiating, fe-massless, fe-reduced (few modes); default: rigid-v where a record has a vertical "
                   "component, else rigid");
    sub.add_option("--samples", a.samples,
                   "runs per level, rounded up to whole blocks; default: 1024, of finite elements 128")
        ->check(CLI::Range(1, 10'000'000));
    sub.add_option("--budget", a.budget,
                   "processor seconds of finite elements in place of --samples; a pilot of a tenth fixes the number")
        ->check(in_range(1.0, 1e9));
    sub.add_option("--conditioning", a.conditioning,
                   "on, off, auto: runs draw friction only where the rigid block, corrected by a pilot, does not know "
                   "whether the dam slides too far; auto: with finite elements, if no variable is epistemic. The rigid "
                   "block alone: P = F(mu*) of each draw of the rest, no friction drawn")
        ->check(CLI::IsMember({"auto", "on", "off"}))
        ->capture_default_str();
    sub.add_option("--aim-at", a.aim,
                   "a probability, where friction is conditioned on: two thirds of the runs go to the level whose P is "
                   "nearest to it; without it half of the runs make all P equally sure, half the annual rate")
        ->check(in_range(1e-9, 1.0));
    sub.add_option("--share-rows", a.rows, "rows of each of two samples for what P comes from; 0: not asked for")
        ->check(CLI::Range(0, 1'000'000))
        ->capture_default_str();
    sub.add_flag("--allow-scaling", a.allow_scaling, "records may be scaled beyond suite.max_scale; they are listed");
    add_out(sub, a.out, OutputPath::folder,
            "folder for samples.csv, fragility.csv, hazard_shares.csv, summary.json, report.html, fragility.xml "
            "(OpenQuake) and a database of the runs for --resume",
            "-o,--out");
    add_pdf(sub, a.pdf);
    add_jobs(sub, a.jobs);
    const char* const group = "Long runs";
    sub.option_defaults()->group(group);
    sub.add_flag("--resume", a.resume, "go on where a run with the same --out stopped");
    sub.add_option("--shard", a.shard, "i/n: the i-th of n parts, i from 0; its runs stay in a database in --out");
    sub.add_flag("--merge", a.merge, "put the parts in --out together");
    sub.add_option("--slurm-array", a.slurm_array, "write a Slurm job script for all parts")
        ->check(output_to(OutputPath::file, "--slurm-array"));
    sub.add_option("--parts", a.parts, "of --slurm-array")->check(CLI::Range(1, 1'000'000))->capture_default_str();
}

} // namespace

Command fragility_command()
{
    return {"fragility", "how likely the dam slides too far: P by the strength of the earthquake, rates per year",
            "damslip fragility examples/fragility/dam.toml --out results/fragility",
            with_flags<FragilityArguments>(fragility_flags, fragility)};
}

} // namespace damslip::cli
