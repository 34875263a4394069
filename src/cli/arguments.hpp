#pragma once

#include "cli/command.hpp"
#include "cli/terminal/terminal.hpp"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace damslip::cli {

/// What the command line asks for: the command to run and in which form it answers.
struct Invocation {
    std::function<int(const Streams&)> run;
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

/// The program itself (its name is empty) and all its commands.
std::vector<CommandSummary> command_summaries();

} // namespace damslip::cli
