#include "cli/sweep_plan.hpp"

#include "analysis/sweep/result_store.hpp"
#include "analysis/sweep/sweep_axes.hpp"
#include "cli/command.hpp"
#include "cli/sweep_command.hpp"
#include "core/text.hpp"
#include "scene/uplift_models.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace damslip::cli {

std::string sweep_command_line(const SweepArguments& a)
{
    std::string line = "damslip sweep " + shell_words(a.inputs);
    const auto add = [&line](const char* flag, const std::string& value) {
        if (!value.empty()) line += fmt::format(" {} {}", flag, shell_quoted(value));
    };
    for (const GridFlag& f : grid_flags) add(f.flag, a.*f.list);
    add("--method", a.method);
    if (a.modes) add("--modes", std::to_string(*a.modes));
    if (a.truncation_error) line += " --truncation-error";
    if (a.penalty_stiffness) add("--penalty-stiffness", shortest(*a.penalty_stiffness));
    add("--scheme", a.inputs.scheme);
    if (a.inputs.strict) line += " --strict";
    add("--out", a.out.string());
    return line;
}

std::string plan_text(const SweepArguments& arguments, std::size_t parts)
{
    const std::string command = sweep_command_line(arguments);
    std::string text;
    for (std::size_t i = 0; i < parts; ++i)
        text += fmt::format("{} --jobs {} --resume --shard {}/{}\n", command, std::max(1, arguments.jobs), i, parts);
    return text;
}

std::string merge_command_line(const SweepArguments& arguments, std::size_t parts)
{
    std::string line = "damslip sweep --merge";
    if (parts <= 20)
        for (std::size_t i = 0; i < parts; ++i)
            line += " " + shell_quoted(store_of(arguments.out, Shard{i, parts}).string());
    else {
        const auto folder = arguments.out.parent_path();
        line += " " + shell_quoted(folder.empty() ? "." : folder.string());
    }
    return line + " --out " + shell_quoted(arguments.out.string());
}

std::string slurm_head(const std::string& name, std::size_t parts, int jobs)
{
    return fmt::format(R"(#!/bin/sh
#SBATCH --job-name={0}
#SBATCH --array=0-{1}
#SBATCH --ntasks=1
#SBATCH --cpus-per-task={2}
#SBATCH --time=04:00:00
#SBATCH --mem-per-cpu=2G
#SBATCH --output={0}-%A-%a.log
)",
                       name, parts - 1, std::max(1, jobs));
}

std::string slurm_exec(const std::string& command, std::size_t parts)
{
    return fmt::format(R"(set -eu
exec {} --jobs "${{SLURM_CPUS_PER_TASK:-1}}" --resume --quiet --shard "$SLURM_ARRAY_TASK_ID/{}"
)",
                       command, parts);
}

std::string slurm_script(const SweepArguments& arguments, std::size_t parts)
{
    return slurm_head("damslip-sweep", parts, arguments.jobs) +
           fmt::format(
               R"(# Adjust time and memory; add partition and account. Submit in the folder the paths below start from:
#   sbatch this-script
# A part that was stopped goes on where it was when it is submitted again:  sbatch --array=3,7 this-script
# Sites limit the array (scontrol show config: MaxArraySize); fewer parts: write this script again with --parts N.
# When all parts are there:
#   {}
)",
               merge_command_line(arguments, parts)) +
           slurm_exec(sweep_command_line(arguments), parts);
}

namespace {

void add_sweep_parts(CLI::App& sub, SweepArguments& a)
{
    const char* const group = "Long sweeps";
    sub.add_flag("--resume", a.resume, "go on where a sweep with the same --out stopped")->group(group);
    sub.add_option("--shard", a.shard, "i/n: the i-th of n parts, i from 0, into OUT.i-of-n.sqlite")->group(group);
    sub.add_option("--merge", a.merge,
                   "put parts together: their databases, or folders of them; with SCENE its report has the section and "
                   "the records")
        ->group(group);
    sub.add_flag("--plan", a.plan, "print the commands of all parts, one a line")->group(group);
    sub.add_option("--slurm-array", a.slurm_array, "write a Slurm job script for all parts")
        ->check(output_to(OutputPath::file, "--slurm-array"))
        ->group(group);
    sub.add_option("--parts", a.parts, "of --plan and --slurm-array; default: one per scene variant and motion")
        ->check(CLI::Range(1, 1000000))
        ->group(group);
}

void sweep_flags(CLI::App& sub, SweepArguments& a)
{
    add_run_inputs(sub, a.inputs);
    sub.get_option("SCENE")->required(false); // --merge has none
    const auto list = [&](const char* flag, std::string& target, const std::string& text) {
        sub.add_option(flag, target, text)->group("Grid");
    };
    list("--friction", a.friction, "Coulomb mu: 1.00,0.84,0.77 or first:last:step 0.65:1.0:0.05");
    list("--friction-deg", a.friction_deg, "friction angles instead [deg]");
    list("--plane", a.plane,
         "what the dam slides on: base, seams by name, of rigid blocks lifts such as \"lift at 30 m\", too; each has its own "
         "friction unless --friction gives one for all");
    list("--level", a.level, "water levels above the heel, at size 1 [m]");
    list("--uplift", a.uplift, uplift_words());
    list("--opening-water", a.opening_water,
         "rules for the water in the opening base, side by side: unchanged, zero, full, mouth (with the scene's "
         "mouth_speed_m_s), reynolds");
    list("--reservoir", a.reservoir, fmt::format("{}", fmt::join(reservoir_axis_words(), ", ")));
    list("--size", a.size, "factors on all lengths of the scene: dam, rock, water, elements");
    list("--period", a.period, "periods of the flexible block [s], for decoupled and coupled");
    list("--damping", a.damping, "damping ratios of the flexible block, for decoupled and coupled");
    list("--scale", a.scale, "factors on the records");
    list("--polarity", a.polarity, "1, -1 or both (default: both, or motion.polarity of the scene)");
    sub.add_flag("--mean-polarity", a.mean_polarity, "a column with the mean slip of --polarity 1,-1");
    list("--method", a.method,
         "rigid (horizontal), rigid-v (with the vertical component), rocking (the same, free to rock on toe and heel), "
         "decoupled and coupled (the block that vibrates on its base: [flexible_block] or --period), "
         "fe (finite elements with the scene's contact law), "
         "fe-exact, fe-penalty, fe-slip-tolerance, fe-whole-steps, fe-goldgruber-2015, fe-radiating, fe-massless, "
         "fe-reduced, and regressions by "
         "id such as "
         "ambraseys-menu-1988, jibson-1993, jibson-1998");
    sub.add_option("--modes", a.modes, "elastic modes of fe-reduced (12)")->check(CLI::Range(1, 1000));
    sub.add_flag("--truncation-error", a.truncation_error,
                 "estimate for every row of fe-reduced what the modes left out change");
    sub.add_option("--penalty-stiffness", a.penalty_stiffness, "of fe-penalty [N/m3]")->check(in_range(1.0, 1e20));
    sub.add_option("--scheme", a.inputs.scheme, "exact (default) or slammer");
    add_out(sub, a.out, OutputPath::regular_file,
            "CSV file, beside it a report (.html) and a database of the rows (.sqlite) for --resume; without it the "
            "rows go to standard output",
            "-o,--out");
    add_pdf(sub, a.pdf);
    add_jobs(sub, a.jobs);
    add_sweep_parts(sub, a);
}

} // namespace

Command sweep_command()
{
    return {"sweep", "slip over a grid of friction, level, uplift, reservoir, size, scale, polarity and records; CSV",
            "damslip sweep examples/reference_dam.toml --friction 0.65:1.0:0.05 --uplift curtain,linear --scale 1,2",
            with_flags<SweepArguments>(sweep_flags, sweep)};
}

} // namespace damslip::cli
