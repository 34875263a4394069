#pragma once

#include "cli/terminal/streams.hpp"

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace CLI {
class App;
}

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

} // namespace damslip::cli
