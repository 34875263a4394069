#pragma once

#include "cli/command.hpp"
#include "cli/input/run_inputs.hpp"
#include "cli/spectrum_input.hpp"
#include "core/file.hpp"

#include <CLI/CLI.hpp>

/// Flags that several commands have. Only the files that declare flags include it: CLI11 is slow to compile.
namespace damslip::cli {

/// SCENE and --strict.
void add_scene(CLI::App& sub, RunInputs& in);
/// The same, and records in place of the scene's.
void add_run_inputs(CLI::App& sub, RunInputs& in);
/// --scale and --friction, of commands that run the scene as one point.
void add_scale(CLI::App& sub, RunInputs& in);
void add_friction(CLI::App& sub, RunInputs& in);
/// --rock, of commands that run finite elements.
void add_rock(CLI::App& sub, RunInputs& in);

/// --response-spectrum and what belongs to it.
void add_response_spectrum(CLI::App& sub, SpectrumArguments& a);

/// Check of an option with a decimal number: low <= value <= high. Text that is no number, NaN and infinity are refused,
/// which CLI::Range lets through. For whole numbers CLI::Range does.
CLI::Validator in_range(double low, double high);

/// -j, --jobs.
CLI::Option* add_jobs(CLI::App& sub, int& jobs, const std::string& text = "threads; 0: all cores");

/// --out, checked before anything begins. @param names  with the short one where the command has it
CLI::Option* add_out(CLI::App& sub, std::filesystem::path& target, OutputPath kind, const std::string& text,
                     const std::string& names = "--out");

/// --pdf, of commands that have a report; checked before anything begins.
void add_pdf(CLI::App& sub, std::filesystem::path& target);

/// Check of an option that names output: what would fail after minutes is said before anything begins.
/// @throws UsageError, from the check
std::function<std::string(const std::string&)> output_to(OutputPath kind, const std::string& flag);

} // namespace damslip::cli
