#pragma once

#include "cli/input/run_inputs.hpp"
#include "cli/model_commands.hpp"
#include "cli/terminal/terminal.hpp"
#include "core/file.hpp"
#include "pages/report/answer.hpp"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <functional>
#include <initializer_list>
#include <iosfwd>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

/// The table of commands: one row for each word after `damslip`. Command line, help, completion and manual pages follow from it.
namespace damslip::cli {

/// What a command does with what was typed. @returns the exit code
using Run = std::function<int(const Streams&)>;

struct Command {
    std::string name;        ///< "screen"
    std::string description; ///< one line
    std::string example;     ///< "damslip screen dam.toml"
    /// Declares the flags on the command's own parser, and returns what runs once they are parsed; see with_flags().
    /// --json and --quiet are every command's.
    std::function<Run(CLI::App&)> declare = {};
    std::vector<Command> below = {}; ///< `info` of `record`; then the command itself runs nothing
};

/// Command::declare of arguments of its own.
/// @param flags  void(CLI::App&, Arguments&): binds flags to the members @param run  int(const Arguments&, const Streams&)
template <class Arguments, class Flags, class Function>
std::function<Run(CLI::App&)> with_flags(Flags flags, Function run)
{
    return [flags, run](CLI::App& sub) -> Run {
        auto arguments = std::make_shared<Arguments>();
        flags(sub, *arguments);
        return [arguments, run](const Streams& streams) { return run(*arguments, streams); };
    };
}

/// All rows, in the order of the help.
std::span<const Command> commands();

/// The --json object of a command whose answer is a text or a file, such as a drawing or a script: printed where --json was asked for.
/// @param what  of the schema: "draw" @param members  names and texts @returns whether it was printed
bool put_json_document(const Streams& streams, const std::string& what,
                       std::initializer_list<std::pair<const char*, std::string>> members);

/// The answer, in the form that was asked for: as a JSON object, in full, in brief with the remarks that waited for it, or its line
/// alone. @param files  as of Answer::brief() @param to  null: standard output
void put_answer(pages::Answer answer, const std::string& files, const Streams& streams, std::ostream* to = nullptr);

/// Flags that several commands have. Only the files that declare flags include it: CLI11 is slow to compile.

/// SCENE and --strict.
void add_scene(CLI::App& sub, RunInputs& in);
/// The same, and records in place of the scene's.
void add_run_inputs(CLI::App& sub, RunInputs& in);
/// --scale and --friction, of commands that run the scene as one point.
void add_scale(CLI::App& sub, RunInputs& in);
void add_friction(CLI::App& sub, RunInputs& in);
/// --rock, of commands that run finite elements.
void add_rock(CLI::App& sub, RunInputs& in);
/// --plane, of commands that run finite elements.
void add_plane(CLI::App& sub, RunInputs& in);

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
void add_sheet(CLI::App& sub, std::filesystem::path& target, const std::string& help); ///< --sheet, a workbook

/// What would keep output from being written there is refused, and so will be an input that is this file.
/// @param flag  how the user gave it: "--out" @throws UsageError
void check_output(const std::filesystem::path& path, OutputPath kind, const std::string& flag);

/// Check of an option that names output: what would fail after minutes is said before anything begins.
/// @throws UsageError, from the check
std::function<std::string(const std::string&)> output_to(OutputPath kind, const std::string& flag);

struct WorkerArguments {
    std::filesystem::path scene;
    std::string method;                        ///< where a line names none; empty: rigid-v, rigid without vertical
    std::string record;                        ///< where a line names none
    std::vector<std::filesystem::path> dakota; ///< two: parameters in, results out
    std::vector<std::filesystem::path> quofem; ///< the same
};

/// Answers points of the scene: JSON lines from `in`, or one file of Dakota or quoFEM.
int worker(const WorkerArguments& arguments, const Streams& streams, std::istream& in);

/// What the command line asks for: the command to run and in which form it answers.
struct Invocation {
    Run run;
    Form form = Form::text;
    bool quiet = false;
    bool cache = true; ///< the user's cache folder may be used
    bool brief = false; ///< the answer in brief, wherever it goes
};

/// Help or version text to print before leaving with exit code 0.
struct HelpText {
    std::string text;
};

/// Parses the command line of a program with those commands. @throws HelpText, UsageError (with the nearest command or flag)
Invocation parse_arguments(const std::vector<std::string>& arguments, std::span<const Command> rows);

/// An option or a positional argument of a command, as its help says it.
struct OptionSummary {
    std::string name;                 ///< "--record"; of a positional argument "SCENE"
    std::string short_name;           ///< "-o"; empty: none
    std::string value;                ///< kind of value: "TEXT", "FLOAT"; empty: a flag
    std::vector<std::string> choices; ///< the only values; empty: any
    std::string range;                ///< "1 - 1000"; empty: any
    std::string default_value;        ///< empty: none is said
    std::string text;                 ///< what it means
    std::string group;                ///< "Options", "Ground motion"
    bool positional = false, required = false, repeated = false;
};

/// A command as its help says it, for completion, manual pages and the tests.
struct CommandSummary {
    std::string name; ///< "record info"; of the program itself empty
    std::string description;
    std::vector<OptionSummary> options; ///< positional ones first
    std::string footer;                 ///< "Example:\n  damslip ..."
    bool has_subcommands = false;
};

/// The program itself (its name is empty) and all its commands, each before those below it.
std::vector<CommandSummary> command_summaries();

} // namespace damslip::cli
