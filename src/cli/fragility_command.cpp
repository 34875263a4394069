#include "cli/fragility_command.hpp"

#include "analysis/fragility/fragility_study.hpp"
#include "cli/print_pdf.hpp"
#include "cli/sweep_plan.hpp"
#include "cli/terminal/terminal_watch.hpp"
#include "core/file.hpp"
#include "core/parallel.hpp"
#include "core/stopwatch.hpp"
#include "core/usage_error.hpp"
#include "pages/fragility/fragility_report.hpp"
#include "pages/fragility/fragility_tables.hpp"
#include "pages/report/csv_lines.hpp"
#include "pages/report/page_html.hpp"
#include "pages/report/table_text.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <ostream>

namespace damslip::cli {

using namespace pages;

namespace {

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

void write_files(const std::filesystem::path& out, const FragilityView& view, const SweepIdentity& identity)
{
    const std::vector<std::string> comments = {"damslip " + identity.version + " fragility", "scene " + identity.scene,
                                               "runs " + hash_of(identity)};
    write_samples(out / "samples.csv", view, comments);
    write_file(out / "fragility.csv", csv(fragility_table(view), comments));
    if (const Table rates = rate_part_table(view); !rates.rows.empty())
        write_file(out / "hazard.csv", csv(rates, comments));
    write_file(out / "summary.json", fragility_json(view).dump(2) + "\n");
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
    if (!streams.quiet)
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
    const FragilityView view = view_of(study, plan, runs, answer);
    if (streams.form == Form::json)
        streams.out << fragility_json(view).dump(2) << "\n";
    else
        streams.out << fragility_text(view);
    if (!a.out.empty()) write_files(a.out, view, fragility_identity(plan, study.text, study.method.id));
    if (!a.pdf.empty()) {
        print_pdf(page_html(fragility_page(view)), a.pdf);
        name_report(a.pdf, streams);
    }
    return answer.answered ? exit_ok : exit_no_answer;
}

} // namespace

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
    if (!study.suite.made.empty() && !streams.quiet) streams.talk << study.suite.made << "\n";
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
        store.emplace(store_file(a.out, shard), identity, shard,
                      a.resume ? StoreStart::resume : StoreStart::fresh);
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

} // namespace damslip::cli
