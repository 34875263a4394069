#include "cli/sweep_plan.hpp"

#include "analysis/sweep/result_store.hpp"
#include "core/text.hpp"

#include <algorithm>
#include <fmt/format.h>

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

} // namespace damslip::cli
