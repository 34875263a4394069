#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace damslip::cli {

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

/// Of the app and of everything below it, the app first.
std::vector<CommandSummary> summaries_of(const CLI::App& app);

} // namespace damslip::cli
