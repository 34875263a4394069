#include "cli/completion_command.hpp"

#include "cli/arguments.hpp"
#include "cli/terminal/usage_error.hpp"

#include <fmt/format.h>
#include <ostream>

namespace damslip::cli {

namespace {

std::string single_quoted(const std::string& text)
{
    std::string out = "'";
    for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return out + "'";
}

std::string bash(const std::vector<CommandSummary>& commands)
{
    std::string names, cases;
    for (const CommandSummary& c : commands) {
        if (c.name.find(' ') == std::string::npos) names += (names.empty() ? "" : " ") + c.name;
        cases += fmt::format("        {}) words=\"{}\" ;;\n", single_quoted(c.name), fmt::join(c.flags, " "));
    }
    return fmt::format(R"(# bash completion for damslip:  source <(damslip completion bash)
_damslip() {{
    local current="${{COMP_WORDS[COMP_CWORD]}}" command="${{COMP_WORDS[1]}}" words=""
    [ "$command" = record ] && command="record ${{COMP_WORDS[2]}}"
    if [ "$COMP_CWORD" -eq 1 ]; then
        COMPREPLY=($(compgen -W "{}" -- "$current"))
        return
    fi
    if [ "$COMP_CWORD" -eq 2 ] && [ "${{COMP_WORDS[1]}}" = record ]; then
        COMPREPLY=($(compgen -W "info convert baseline scale spectrum generate" -- "$current"))
        return
    fi
    case "$command" in
{}    esac
    case "$current" in
        -*) COMPREPLY=($(compgen -W "$words" -- "$current")) ;;
        *) COMPREPLY=($(compgen -f -- "$current")) ;;
    esac
}}
complete -o filenames -F _damslip damslip
)",
                       names, cases);
}

std::string fish(const std::vector<CommandSummary>& commands)
{
    std::string out = "# fish completion for damslip:  damslip completion fish | source\n";
    for (const CommandSummary& c : commands) {
        const std::size_t blank = c.name.find(' ');
        if (blank == std::string::npos)
            out += fmt::format("complete -c damslip -f -n __fish_use_subcommand -a {} -d {}\n", c.name,
                               single_quoted(c.description));
        else
            out += fmt::format("complete -c damslip -f -n '__fish_seen_subcommand_from {}' -a {} -d {}\n",
                               c.name.substr(0, blank), c.name.substr(blank + 1), single_quoted(c.description));
        for (const std::string& flag : c.flags)
            out += fmt::format("complete -c damslip -n '__fish_seen_subcommand_from {}' -l {}\n",
                               c.name.substr(blank == std::string::npos ? 0 : blank + 1), flag.substr(2));
    }
    return out;
}

} // namespace

int completion(const std::string& shell, const Streams& streams)
{
    const std::vector<CommandSummary> commands = command_summaries();
    if (shell == "bash")
        streams.out << bash(commands);
    else if (shell == "zsh")
        streams.out << "#compdef damslip\n# zsh completion for damslip:  source <(damslip completion zsh)\nautoload -U "
                       "+X bashcompinit && bashcompinit\n"
                    << bash(commands);
    else if (shell == "fish")
        streams.out << fish(commands);
    else
        throw UsageError(Diagnostic{"", 0, 0, fmt::format("completion {}: this shell is not known.", shell),
                                    "bash, zsh or fish", "for example  damslip completion bash"});
    return exit_ok;
}

} // namespace damslip::cli
