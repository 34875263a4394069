#pragma once

#include "cli/record_command.hpp"
#include "cli/terminal/streams.hpp"
#include "core/file.hpp"

#include <CLI/CLI.hpp>

#include <functional>

/// Shared by the files that build the command-line parser; nothing else includes it (CLI11 is slow to compile).
namespace damslip::cli {

/// What every command has: a parser below its parent with --json and --quiet, and where the chosen command goes.
struct ParserBase {
    bool json = false, quiet = false;
    std::function<int(const Streams&)> chosen;
};

CLI::App* add_command(CLI::App& parent, ParserBase& base, const std::string& name, const std::string& description,
                      const std::string& example);

/// Check of an option that names output: what would fail after minutes is said before anything begins.
/// @throws UsageError, from the check
std::function<std::string(const std::string&)> output_to(OutputPath kind, const std::string& flag);

/// Arguments of all `record` commands.
struct RecordArguments {
    RecordInfoArguments info;
    std::vector<std::filesystem::path> info_files;
    RecordConvertArguments convert;
    RecordBaselineArguments baseline;
    RecordScaleArguments scale;
    RecordSpectrumArguments spectrum;
    RecordGenerateArguments generate;
    std::string form; ///< --to
};

void add_record_commands(CLI::App& app, ParserBase& base, RecordArguments& arguments);

} // namespace damslip::cli
