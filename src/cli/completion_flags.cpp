#include "cli/completion_command.hpp"
#include "cli/flags.hpp"

namespace damslip::cli {

namespace {

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
