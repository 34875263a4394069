#include "cli/command.hpp"
#include "core/file.hpp"
#include "core/input_error.hpp"
#include "core/version.hpp"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <ostream>
#include <string>
#include <vector>

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
        refuse_usage(fmt::format("completion {}: this shell is not known.", shell), "bash, zsh or fish",
                     "for example  damslip completion bash");
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

namespace {

struct ManArguments {
    std::vector<std::string> command; ///< "record", "info"; empty: the program's own page
    std::filesystem::path out;        ///< folder for all pages; empty: one page on standard output
};

constexpr const char* release_date = "2026-11-21"; ///< of this version; a page must not depend on when it was built

/// Text as roff prints it: no requests, no escapes, hyphens that can be copied.
std::string roff(const std::string& text)
{
    std::string out;
    for (const char c : text) {
        if ((c == '.' || c == '\'') && (out.empty() || out.back() == '\n')) out += "\\&";
        if (c == '\\')
            out += "\\e";
        else if (c == '-')
            out += "\\-";
        else
            out += c;
    }
    return out;
}

std::string page_name(const std::string& command)
{
    std::string name = command.empty() ? "damslip" : "damslip-" + command;
    std::replace(name.begin(), name.end(), ' ', '-');
    return name;
}

std::string sentence(const OptionSummary& o)
{
    std::string text = o.text;
    if (!o.choices.empty()) text += fmt::format("; one of {}", fmt::join(o.choices, ", "));
    if (!o.range.empty()) text += fmt::format("; {}", o.range);
    if (!o.default_value.empty()) text += fmt::format("; default {}", o.default_value);
    return roff(text);
}

std::string options_of(const CommandSummary& command)
{
    std::string out, group;
    for (const OptionSummary& o : command.options) {
        if (o.positional) continue;
        if (o.group != group) {
            group = o.group;
            if (group != "Options") out += fmt::format(".SS {}\n", roff(group));
        }
        std::string head = o.short_name.empty() ? "" : fmt::format("\\fB{}\\fR, ", roff(o.short_name));
        head += fmt::format("\\fB{}\\fR", roff(o.name));
        if (!o.value.empty()) head += fmt::format(" \\fI{}\\fR{}", roff(o.value), o.repeated ? " ..." : "");
        out += fmt::format(".TP\n{}\n{}\n", head, sentence(o));
    }
    return out;
}

/// Ungrouped options first, then one group after the other.
CommandSummary grouped(CommandSummary command)
{
    std::vector<std::string> groups{"Options"};
    for (const OptionSummary& o : command.options)
        if (std::find(groups.begin(), groups.end(), o.group) == groups.end()) groups.push_back(o.group);
    std::vector<OptionSummary> sorted;
    for (const std::string& group : groups)
        std::copy_if(command.options.begin(), command.options.end(), std::back_inserter(sorted),
                     [&](const OptionSummary& o) { return o.group == group; });
    command.options = std::move(sorted);
    return command;
}

std::string synopsis(const CommandSummary& command)
{
    std::string out = fmt::format(".B damslip{}{}\n[\\fIOPTIONS\\fR]", command.name.empty() ? "" : " ", command.name);
    for (const OptionSummary& o : command.options)
        if (o.positional)
            out += fmt::format(" {}\\fI{}\\fR{}{}", o.required ? "" : "[", o.name, o.repeated ? " ..." : "",
                               o.required ? "" : "]");
    return out + (command.has_subcommands ? " \\fICOMMAND\\fR ...\n" : "\n");
}

std::string arguments_of(const CommandSummary& command)
{
    std::string out;
    for (const OptionSummary& o : command.options)
        if (o.positional) out += fmt::format(".TP\n.I {}\n{}\n", o.name, sentence(o));
    return out.empty() ? out : ".SH ARGUMENTS\n" + out;
}

/// Is `below` one word more than `above`?
bool directly_below(const std::string& below, const std::string& above)
{
    if (below.empty() || (!above.empty() && !below.starts_with(above + " "))) return false;
    return below.find(' ', above.empty() ? 0 : above.size() + 1) == std::string::npos;
}

std::string commands_of(const CommandSummary& command, const std::vector<CommandSummary>& all)
{
    if (!command.has_subcommands) return {};
    std::string out = ".SH COMMANDS\nEach has its own page.\n";
    for (const CommandSummary& c : all)
        if (directly_below(c.name, command.name))
            out += fmt::format(".TP\n.BR {} (1)\n{}\n", roff(page_name(c.name)), roff(c.description));
    return out;
}

/// The lines of the help's footer that are commands.
std::string examples_of(const CommandSummary& command)
{
    std::string out;
    std::size_t at = 0;
    while (at < command.footer.size()) {
        const std::size_t end = std::min(command.footer.find('\n', at), command.footer.size());
        if (command.footer.compare(at, 2, "  ") == 0) out += roff(command.footer.substr(at + 2, end - at - 2)) + "\n";
        at = end + 1;
    }
    return out.empty() ? out : ".SH EXAMPLES\n.EX\n" + out + ".EE\n";
}

constexpr const char* exit_status = R"(.SH EXIT STATUS
.TP
.B 0
ok
.TP
.B 1
internal error
.TP
.B 2
command line
.TP
.B 3
a file that cannot be read or written, standard output included
.TP
.B 4
no answer (not resolved, tolerance missed, diverged, interrupted), or a check failed; the results so far are kept
)";

std::string page(const CommandSummary& given, const std::vector<CommandSummary>& all)
{
    const CommandSummary command = grouped(given);
    std::string title = page_name(command.name);
    std::transform(title.begin(), title.end(), title.begin(), [](char c) { return c >= 'a' && c <= 'z' ? c - 32 : c; });
    std::string out =
        fmt::format(".TH {} 1 {} \"damslip {}\" \"damslip manual\"\n", roff(title), release_date, program_version());
    out += fmt::format(".SH NAME\n{} \\- {}\n", roff(page_name(command.name)), roff(command.description));
    out += ".SH SYNOPSIS\n" + synopsis(command) + arguments_of(command) + commands_of(command, all);
    out += ".SH OPTIONS\n" + options_of(command) + examples_of(command) + exit_status;
    if (command.name.empty())
        out += ".SH FILES\nScene files are TOML; the user guide and all keys are in the documents installed with the "
               "program.\n";
    else
        out += ".SH SEE ALSO\n.BR damslip (1)\n";
    return out;
}

/// Manual pages from the help texts: damslip.1, damslip-screen.1, damslip-record-info.1, ...
int man(const ManArguments& arguments, const Streams& streams)
{
    const std::vector<CommandSummary> all = command_summaries();
    if (!arguments.out.empty()) {
        for (const CommandSummary& c : all) write_file(arguments.out / (page_name(c.name) + ".1"), page(c, all));
        put_json_document(streams, "man", {{"out", arguments.out.string()}});
        return exit_ok;
    }
    const std::string wanted = fmt::format("{}", fmt::join(arguments.command, " "));
    const auto found = std::find_if(all.begin(), all.end(), [&](const CommandSummary& c) { return c.name == wanted; });
    if (found == all.end())
        refuse_usage(fmt::format("man {}: there is no such command.", wanted), "a command that damslip --help lists",
                     "for example  damslip man fe");
    const std::string text = page(*found, all);
    if (!put_json_document(streams, "man", {{"page", text}})) streams.out << text;
    return exit_ok;
}

void man_flags(CLI::App& sub, ManArguments& a)
{
    sub.add_option("COMMAND", a.command, "the command whose page is printed; none: the program's own");
    add_out(sub, a.out, OutputPath::folder, "folder for the pages of all commands");
}

} // namespace

Command man_command()
{
    return {"man", "manual pages, made from the help texts", "damslip man fe | man -l -",
            with_flags<ManArguments>(man_flags, man)};
}

} // namespace damslip::cli
