#pragma once

#include "cli/terminal/streams.hpp"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace damslip::cli {

/// What the command line asks for: the command to run and in which form it answers.
struct Invocation {
    std::function<int(const Streams&)> run;
    Form form = Form::text;
    bool quiet = false;
};

/// Names and flags of all commands, for suggestions and completion.
struct CommandSummary {
    std::string name;
    std::string description;
    std::vector<std::string> flags; ///< "--record"
};

/// Help or version text to print before leaving with exit code 0.
struct HelpText {
    std::string text;
};

/// Parses the command line. @throws HelpText, UsageError (with the nearest command or flag)
Invocation parse_arguments(const std::vector<std::string>& arguments);

std::vector<CommandSummary> command_summaries();

} // namespace damslip::cli
