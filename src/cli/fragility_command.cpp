#include "cli/fragility_command.hpp"

#include "analysis/fragility/shaking_suite.hpp"
#include "cli/sweep_plan.hpp"
#include "cli/terminal/terminal_watch.hpp"
#include "core/file.hpp"
#include "core/units.hpp"
#include "core/usage_error.hpp"
#include "pages/fragility/fragility_report.hpp"
#include "pages/fragility/fragility_tables.hpp"
#include "pages/report/page_html.hpp"
#include "pages/report/table_text.hpp"
#include "pages/sweep/sweep_parts.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <ostream>

namespace damslip::cli {

using namespace pages;

namespace {

constexpr std::uint32_t cheap_stream = 1, pilot_stream = 2; // of FragilitySizes: draws of their own

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
    need_scene_file(a.inputs, "fragility");
}

const SweepMethod& method_of_fragility(const FragilityArguments& a, const Records& records, const Scene& scene)
{
    const bool vertical =
        scene.motion.vertical &&
        std::any_of(records->begin(), records->end(), [](const RecordPair& p) { return p.vertical.has_value(); });
    const std::string id = a.method.empty() ? vertical ? "rigid-v" : "rigid" : a.method;
    const std::vector<std::string> known = sweep_methods();
    const bool there = std::find(known.begin(), known.end(), id) != known.end();
    const auto kind = there ? sweep_method(id).kind : SweepKind::regression;
    if (kind == SweepKind::regression || kind == SweepKind::rocking || sweep_method(id).reduced || id == "fe-penalty")
        refuse_usage(fmt::format("--method {} is not one of a fragility.", id),
                     "rigid, rigid-v, fe, fe-exact, fe-slip-tolerance, fe-whole-steps, fe-goldgruber-2015, "
                     "fe-radiating, fe-massless",
                     "write  --method rigid-v  or  --method fe");
    return sweep_method(id);
}

/// Limits that a run of a sweep's methods gives.
void check_limits(const FragilityInput& input, const std::filesystem::path& file)
{
    for (const LimitInput& limit : input.limits)
        if (limit.quantity != LimitQuantity::slip && limit.quantity != LimitQuantity::largest_slip)
            throw InputError(Diagnostic{file.string(), 0, 0,
                                        fmt::format("limit \"{}\" is not computed by fragility.", limit.text),
                                        "quantity = \"slip\" or \"largest-slip\"", "change limit.quantity"});
}

/// The hazard curve in SI. @throws InputError for one of another measure
probability::HazardCurve hazard_of(const FragilityInput& input, double unit)
{
    const probability::HazardFile file = probability::read_hazard_curve(input.hazard->curve);
    if (!file.measure.empty() && file.measure != input.intensity.text)
        throw InputError(Diagnostic{
            input.hazard->curve.string(), 0, 0,
            fmt::format("the hazard curve is of {}, the levels are of {}.", file.measure, input.intensity.text),
            "one measure for both", "change intensity.measure, or take the curve of that measure"});
    const bool exported = file.investigation_time > 0.0; // OpenQuake's units
    const bool velocity = input.intensity.measure == IntensityMeasure::pgv;
    const double factor = !exported ? unit : velocity ? units::cm : units::standard_gravity;
    std::vector<double> x = file.curve.x();
    for (double& at : x) at *= factor;
    return {std::move(x), file.curve.rate()};
}

/// Everything that is fixed before the first run.
struct FragilityJob {
    const FragilityArguments& arguments;
    const Streams& streams;
    SceneText text;
    Scene scene;
    FragilityInput input;
    ShakingSuite suite;
    const SweepMethod& method;
    NumberInFile written;

    bool finite_elements() const { return method.kind == SweepKind::finite_elements; }
    FragilityPlan plan(std::size_t samples, std::uint32_t stream = 0) const
    {
        return plan_fragility(input, suite, {samples, stream}, text.file(), written);
    }
    const SweepMethod& rigid() const { return method_of_fragility({}, suite.pairs, scene); }
};

/// Runs per level that the budget pays for: a tenth goes into a pilot whose answers are thrown away.
std::size_t samples_by_budget(const FragilityJob& job)
{
    const double budget = *job.arguments.budget;
    TerminalWatch watch(job.streams);
    const FragilityPlan pilot = job.plan(1, pilot_stream);
    const std::size_t few = std::min<std::size_t>(pilot.samples.size(), 2 * pilot.levels);
    std::vector<std::size_t> wanted; // spread over levels and draws
    for (std::size_t i = 0; i < few; ++i) wanted.push_back(i * pilot.samples.size() / few);
    const FragilityRuns runs = run_fragility(pilot, job.text, job.method, wanted, nullptr, job.arguments.jobs, watch);
    const double per_run = runs.seconds / static_cast<double>(std::max<std::size_t>(1, runs.finished()));
    const double left = std::max(0.9 * budget, budget - runs.seconds);
    const auto samples = static_cast<std::size_t>(std::max(1.0, left / (per_run * static_cast<double>(pilot.levels))));
    if (!job.streams.quiet)
        job.streams.talk << fmt::format("pilot: {} runs, {:.3g} processor seconds each; --samples {}\n",
                                        runs.finished(), per_run, samples);
    return samples;
}

std::filesystem::path journal_file(const FragilityJob& job, const Shard& shard)
{
    const std::filesystem::path rows = job.arguments.out / "samples.csv";
    return journal_of(shard.count > 1 ? part_file(rows, shard) : rows);
}

/// How many parts there are journals of. @throws InputError where there are none
std::size_t parts_in(const std::filesystem::path& folder)
{
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        const std::size_t of = name.find("-of-");
        if (!name.starts_with("samples.") || !name.ends_with(".csv.journal") || of == std::string::npos) continue;
        const std::size_t n = std::strtoull(name.c_str() + of + 4, nullptr, 10);
        if (n > 0) return n;
    }
    refuse(folder, "there is no part of a fragility here.", "journals samples.0-of-3.csv.journal ... of --shard",
           "run the parts first");
}

/// The rows of all parts.
FragilityRuns merged_runs(const FragilityJob& job, const FragilityPlan& plan, const SweepIdentity& identity)
{
    const std::size_t n = parts_in(job.arguments.out);
    FragilityRuns runs;
    runs.rows.resize(plan.samples.size());
    runs.yield.assign(plan.draws.size(), std::nan(""));
    runs.wanted = plan.samples.size();
    for (std::size_t i = 0; i < n; ++i) {
        const Shard shard{i, n};
        const std::filesystem::path file = journal_file(job, shard);
        if (!std::filesystem::exists(file))
            refuse(file, "this part is missing.", fmt::format("the journals of all {} parts", n),
                   fmt::format("run  --shard {}/{}", i, n));
        const Journal journal(file, identity, shard, JournalStart::resume);
        for (FinishedRow& row : journal.finished_rows(0, plan.samples.size())) {
            const std::size_t id = row.id;
            runs.rows[id] = std::move(row);
            ++runs.found;
        }
    }
    if (!runs.complete())
        refuse(job.arguments.out, fmt::format("{} of {} runs are finished.", runs.finished(), runs.wanted),
               "all runs of all parts", "run the parts again with --resume");
    return runs;
}

void write_files(const FragilityJob& job, const FragilityView& view, const SweepIdentity& identity)
{
    const std::filesystem::path& out = job.arguments.out;
    const std::vector<std::string> comments = {"damslip " + identity.version + " fragility", "scene " + identity.scene,
                                               "runs " + hash_of(identity)};
    write_file(out / "samples.csv", csv(sample_table(view), comments));
    write_file(out / "fragility.csv", csv(fragility_table(view), comments));
    if (const Table rates = rate_part_table(view); !rates.rows.empty())
        write_file(out / "hazard.csv", csv(rates, comments));
    write_file(out / "summary.json", fragility_json(view).dump(2) + "\n");
    write_file(out / "report.html", page_html(fragility_page(view)));
    if (const std::string nrml = fragility_nrml(view); !nrml.empty()) write_file(out / "fragility.xml", nrml);
    if (!job.streams.quiet) job.streams.talk << "report: " << (out / "report.html").string() << "\n";
}

int write_slurm(const FragilityArguments& a, const Streams& streams)
{
    std::string line = "damslip fragility " + shell_quoted(a.inputs.scene.string());
    if (!a.method.empty()) line += " --method " + a.method;
    if (a.samples) line += fmt::format(" --samples {}", *a.samples);
    line += fmt::format(" --cheap-samples {} --share-rows {}", a.cheap_samples, a.rows);
    if (a.allow_scaling) line += " --allow-scaling";
    line += " --out " + shell_quoted(a.out.string());
    write_file(a.slurm_array, fmt::format(R"(#!/bin/sh
#SBATCH --job-name=damslip-fragility
#SBATCH --array=0-{0}
#SBATCH --ntasks=1
#SBATCH --cpus-per-task={1}
#SBATCH --time=04:00:00
#SBATCH --mem-per-cpu=2G
#SBATCH --output=damslip-fragility-%A-%a.log
# A part that was stopped goes on when it is submitted again. When all parts are there:
#   {2} --merge
set -eu
exec {2} --jobs "${{SLURM_CPUS_PER_TASK:-1}}" --resume --quiet --shard "$SLURM_ARRAY_TASK_ID/{3}"
)",
                                          a.parts - 1, std::max(1, a.jobs), line, a.parts));
    if (!streams.quiet) streams.talk << fmt::format("{} parts; afterwards:  {} --merge\n", a.parts, line);
    return exit_ok;
}

/// Rigid runs beside the finite elements, and the estimate of both.
TwoLevelFragility two_models(const FragilityJob& job, const FragilityPlan& plan, const FragilityRuns& dear,
                             Watch& watch)
{
    const FragilityRuns beside =
        run_fragility(plan, job.text, job.rigid(), wanted_samples(plan), nullptr, job.arguments.jobs, watch);
    const FragilityPlan others = job.plan(static_cast<std::size_t>(job.arguments.cheap_samples), cheap_stream);
    const FragilityRuns cheap =
        run_fragility(others, job.text, job.rigid(), wanted_samples(others), nullptr, job.arguments.jobs, watch);
    return estimate_two_level(plan, dear, beside, others, cheap);
}

int finish_fragility(const FragilityJob& job, const FragilityPlan& plan, const FragilityRuns& runs,
                     const SweepIdentity& identity, Watch& watch)
{
    const double unit = job.input.intensity.level_unit;
    std::optional<probability::HazardCurve> hazard;
    if (job.input.hazard) hazard = hazard_of(job.input, unit);
    const FragilityEstimate estimate = estimate_fragility(
        plan, runs, hazard ? &*hazard : nullptr, job.input.hazard ? job.input.hazard->all_events : std::nullopt);
    FragilityView view{job.scene, plan, runs, estimate, job.method.id, unit, job.input.intensity.level_unit_text};
    std::optional<TwoLevelFragility> both;
    if (job.finite_elements() && job.arguments.cheap_samples > 0 &&
        job.input.intensity.design != FragilityDesign::cloud)
        view.two_level = &both.emplace(two_models(job, plan, runs, watch));
    std::optional<FragilityCauses> causes;
    if (job.arguments.rows > 0)
        causes = fragility_causes(plan, estimate, job.text, job.written, job.rigid(),
                                  static_cast<std::size_t>(job.arguments.rows), job.arguments.jobs, watch);
    if (causes) view.causes = &*causes;
    for (const LimitInput& limit : job.input.limits)
        view.needed_yields.emplace_back(limit, needed_yield(plan, job.text, limit.value));
    for (const std::string& far : plan.scaled_far) view.notes.push_back("scaled beyond suite.max_scale: " + far);
    for (const std::string& failure : runs.failures) view.notes.push_back("not resolved: " + failure);
    bool answered = true;
    for (const LimitEstimate& limit : estimate.limits)
        if (limit.missing_share() > 0.05) {
            answered = false;
            view.notes.push_back(fmt::format("{}: {:.1f} % of the runs have no answer; P lies between both bounds.",
                                             limit.limit.text, 100.0 * limit.missing_share()));
        }
    if (job.streams.form == Form::json)
        job.streams.out << fragility_json(view).dump(2) << "\n";
    else
        job.streams.out << fragility_text(view);
    if (!job.arguments.out.empty()) write_files(job, view, identity);
    return answered ? exit_ok : exit_no_answer;
}

} // namespace

int fragility(const FragilityArguments& a, const Streams& streams)
{
    check_fragility_flags(a);
    const SceneText text = SceneText::read(a.inputs.scene);
    Scene scene = text.scene();
    say(scene.notes, a.inputs.strict, streams);
    FragilityInput input = read_fragility_input(a.inputs.scene);
    check_limits(input, a.inputs.scene);
    if (a.allow_scaling) {
        if (!input.suite) {
            input.suite.emplace();
            input.suite->polarity = SuitePolarity::as_recorded;
        }
        input.suite->allow_scaling = true;
    }
    const NumberInFile written = [&text](const std::string& key) { return text.written(key); };
    check_supports(input, text, written);
    if (!a.slurm_array.empty()) return write_slurm(a, streams);
    ShakingSuite suite = suite_of_input(scene, input);
    const SweepMethod& method = method_of_fragility(a, suite.pairs, scene);
    const FragilityJob job{a, streams, text, std::move(scene), std::move(input), std::move(suite), method, written};
    const std::size_t samples = a.budget
                                    ? samples_by_budget(job)
                                    : static_cast<std::size_t>(a.samples.value_or(job.finite_elements() ? 128 : 1024));
    const FragilityPlan plan = job.plan(samples);
    const SweepIdentity identity = fragility_identity(plan, text, method.id);
    if (!a.out.empty()) std::filesystem::create_directories(a.out);
    TerminalWatch watch(streams);
    if (a.merge) return finish_fragility(job, plan, merged_runs(job, plan, identity), identity, watch);
    const Shard shard = a.shard.empty() ? Shard{} : parse_shard(a.shard, "--shard");
    std::optional<Journal> journal;
    if (!a.out.empty())
        journal.emplace(journal_file(job, shard), identity, shard,
                        a.resume ? JournalStart::resume : JournalStart::fresh);
    const FragilityRuns runs =
        run_fragility(plan, text, method, wanted_samples(plan, shard), journal ? &*journal : nullptr, a.jobs, watch);
    if (!streams.quiet && runs.found) streams.talk << fmt::format("{} runs were finished before\n", runs.found);
    if (!runs.complete()) {
        streams.talk << fmt::format("interrupted: {} of {} runs are finished{}\n", runs.finished(), runs.wanted,
                                    journal ? "; go on with --resume" : "");
        return exit_no_answer;
    }
    if (shard.count > 1) {
        journal->mark_done();
        if (!streams.quiet)
            streams.talk << fmt::format("part {}/{}: {} runs; when all parts are there:  --merge\n", shard.index,
                                        shard.count, runs.wanted);
        return exit_ok;
    }
    const int code = finish_fragility(job, plan, runs, identity, watch);
    if (journal) journal->mark_done();
    return code;
}

} // namespace damslip::cli
