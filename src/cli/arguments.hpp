#pragma once

#include "cli/command.hpp"
#include "cli/terminal/terminal.hpp"

#include <string>
#include <vector>

namespace damslip::cli {

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
