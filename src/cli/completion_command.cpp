#include "cli/arguments.hpp"
#include "cli/document.hpp"
#include "cli/flags.hpp"
#include "core/usage_error.hpp"

#include <fmt/format.h>
#include <ostream>

namespace damslip::cli {

namespace {

/// "info" of "record info".
std::string last_word(const std::string& name)
{
    return name.substr(name.rfind(' ') + 1);
}

std::string first_word(const std::string& name)
{
    return name.substr(0, name.find(' '));
}

bool nested(const CommandSummary& command)
{
    return command.name.find(' ') != std::string::npos;
}

/// Names one word long, or those below `above`.
std::vector<std::string> names(const std::vector<CommandSummary>& commands, const std::string& above)
{
    std::vector<std::string> out;
    for (const CommandSummary& c : commands)
        if (above.empty() ? !nested(c) : nested(c) && first_word(c.name) == above) out.push_back(last_word(c.name));
    return out;
}

std::string bash(const std::vector<CommandSummary>& commands)
{
    std::string below, cases;
    for (const CommandSummary& c : commands) {
        if (c.has_subcommands)
            below += fmt::format("    if [ \"$COMP_CWORD\" -eq 2 ] && [ \"$command\" = {} ]; then\n"
                                 "        COMPREPLY=($(compgen -W \"{}\" -- \"$current\"))\n        return\n    fi\n"
                                 "    [ \"$command\" = {} ] && command=\"{} ${{COMP_WORDS[2]}}\"\n",
                                 c.name, fmt::join(names(commands, c.name), " "), c.name, c.name);
        std::string flags, choices;
        for (const OptionSummary& o : c.options) {
            if (o.positional) continue;
            flags += (flags.empty() ? "" : " ") + o.name;
            if (!o.choices.empty())
                choices += fmt::format("            {}) COMPREPLY=($(compgen -W \"{}\" -- \"$current\")); return ;;\n",
                                       o.name, fmt::join(o.choices, " "));
        }
        if (!choices.empty()) choices = "        case \"$before\" in\n" + choices + "        esac\n";
        cases += fmt::format("    {})\n{}        words=\"{}\" ;;\n", single_quoted(c.name), choices, flags);
    }
    return fmt::format(R"(# bash completion for damslip:  source <(damslip completion bash)
_damslip() {{
    local current="${{COMP_WORDS[COMP_CWORD]}}" before="${{COMP_WORDS[COMP_CWORD-1]}}" command="${{COMP_WORDS[1]}}" words=""
    if [ "$COMP_CWORD" -eq 1 ]; then
        COMPREPLY=($(compgen -W "{} --help --version" -- "$current"))
        return
    fi
{}    case "$command" in
{}    esac
    case "$current" in
        -*) COMPREPLY=($(compgen -W "$words" -- "$current")) ;;
        *) COMPREPLY=($(compgen -f -- "$current")) ;;
    esac
}}
complete -o filenames -F _damslip damslip
)",
                       fmt::join(names(commands, ""), " "), below, cases);
}

std::string fish(const std::vector<CommandSummary>& commands)
{
    std::string out = "# fish completion for damslip:  damslip completion fish | source\n";
    for (const CommandSummary& c : commands) {
        // The condition under which the flags of the command count, and under which its name does.
        std::string here = "__fish_seen_subcommand_from " + c.name, offered = "__fish_use_subcommand";
        if (nested(c)) {
            const std::string above = first_word(c.name);
            here = fmt::format("__fish_seen_subcommand_from {}; and __fish_seen_subcommand_from {}", above,
                               last_word(c.name));
            offered = fmt::format("__fish_seen_subcommand_from {}; and not __fish_seen_subcommand_from {}", above,
                                  fmt::join(names(commands, above), " "));
        }
        out += fmt::format("complete -c damslip -f -n '{}' -a {} -d {}\n", offered, last_word(c.name),
                           single_quoted(c.description));
        for (const OptionSummary& o : c.options) {
            if (o.positional) continue;
            out += fmt::format("complete -c damslip -n '{}' -l {}", here, o.name.substr(2));
            if (!o.short_name.empty()) out += " -s " + o.short_name.substr(1);
            if (!o.value.empty()) out += " -r";
            if (!o.choices.empty()) out += fmt::format(" -f -a '{}'", fmt::join(o.choices, " "));
            out += fmt::format(" -d {}\n", single_quoted(o.text));
        }
    }
    return out;
}

/// A specification of zsh's _arguments.
std::string zsh_argument(const OptionSummary& o)
{
    std::string text;
    for (const char c : o.text) text += (c == '[' || c == ']' || c == ':' ? "\\" : "") + std::string(1, c);
    std::string values = "_files";
    if (!o.choices.empty()) values = fmt::format("({})", fmt::join(o.choices, " "));
    if (o.positional) return single_quoted(fmt::format("{}:{}:{}", o.repeated ? "*" : "", o.name, values));
    std::string out = fmt::format("{}{}[{}]", o.repeated ? "*" : "", o.name, text);
    if (!o.value.empty()) out += fmt::format(":{}:{}", o.value, values);
    return single_quoted(out);
}

/// Pairs 'name:description' for zsh's _describe.
std::string zsh_names(const std::vector<CommandSummary>& commands, const std::string& above)
{
    std::string out;
    for (const CommandSummary& c : commands)
        if (above.empty() ? !nested(c) : nested(c) && first_word(c.name) == above)
            out += fmt::format("        {}\n", single_quoted(last_word(c.name) + ":" + c.description));
    return out;
}

std::string zsh(const std::vector<CommandSummary>& commands)
{
    std::string below, cases;
    for (const CommandSummary& c : commands) {
        if (c.has_subcommands) {
            below +=
                fmt::format("    if (( CURRENT == 3 )) && [[ $command == {} ]]; then\n        names=(\n{}        )\n"
                            "        _describe command names\n        return\n    fi\n"
                            "    [[ $command == {} ]] && command=\"{} $words[3]\" skip=2\n",
                            c.name, zsh_names(commands, c.name), c.name, c.name);
            continue;
        }
        cases += fmt::format("    {}) arguments=(", single_quoted(c.name));
        for (const OptionSummary& o : c.options) cases += "\n        " + zsh_argument(o);
        cases += ") ;;\n";
    }
    return fmt::format(R"(#compdef damslip
# zsh completion for damslip:  source <(damslip completion zsh)
_damslip() {{
    local command="$words[2]" skip=1
    local -a names arguments
    if (( CURRENT == 2 )); then
        names=(
{}        )
        _describe command names
        return
    fi
{}    case $command in
{}    esac
    (( CURRENT -= skip ))
    shift $skip words
    _arguments $arguments
}}
if [ "$funcstack[1]" = "_damslip" ]; then
    _damslip "$@"
else
    compdef _damslip damslip
fi
)",
                       zsh_names(commands, ""), below, cases);
}

/// Prints a completion script for bash, zsh or fish.
int completion(const std::string& shell, const Streams& streams)
{
    std::vector<CommandSummary> commands = command_summaries();
    commands.erase(commands.begin()); // the program itself
    std::string script;
    if (shell == "bash")
        script = bash(commands);
    else if (shell == "zsh")
        script = zsh(commands);
    else if (shell == "fish")
        script = fish(commands);
    else
        throw UsageError(Diagnostic{"", 0, 0, fmt::format("completion {}: this shell is not known.", shell),
                                    "bash, zsh or fish", "for example  damslip completion bash"});
    if (!put_json_document(streams, "completion", {{"script", script}})) streams.out << script;
    return exit_ok;
}

void completion_flags(CLI::App& sub, std::string& shell)
{
    sub.add_option("SHELL", shell, "bash, zsh or fish")->required();
}

} // namespace

Command completion_command()
{
    return {"completion", "completion script for bash, zsh or fish", "source <(damslip completion bash)",
            with_flags<std::string>(completion_flags, completion)};
}

} // namespace damslip::cli
