#pragma once

#include "analysis/sweep/sweep_axes.hpp"
#include "cli/input/make_axes.hpp"

namespace damslip::cli {

/// The command line that runs this sweep, shell-quoted, without resume and part: "damslip sweep dam.toml --friction ...".
std::string sweep_command_line(const SweepArguments& arguments);

/// One command per line, each a part of the sweep that needs nothing of the others; a part begun before goes on.
std::string plan_text(const SweepArguments& arguments, std::size_t parts);

/// The command that puts the parts together.
std::string merge_command_line(const SweepArguments& arguments, std::size_t parts);

/// The head of a job script for Slurm's sbatch: an array of that many parts, named and with its time, memory and log.
std::string slurm_head(const std::string& name, std::size_t parts, int jobs);
/// Its end: what each part runs. @param command  with scene and --out
std::string slurm_exec(const std::string& command, std::size_t parts);

/// A job script for Slurm's sbatch: an array with one element per part, to be adjusted at the top.
std::string slurm_script(const SweepArguments& arguments, std::size_t parts);

} // namespace damslip::cli
