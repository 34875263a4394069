#include "cli/flags.hpp"
#include "cli/man_command.hpp"

namespace damslip::cli {

namespace {

void man_flags(CLI::App& sub, ManArguments& a)
{
    sub.add_option("COMMAND", a.command, "the command whose page is printed; none: the program's own");
    sub.add_option("--out", a.out, "folder for the pages of all commands")
        ->check(output_to(OutputPath::folder, "--out"));
}

} // namespace

Command man_command()
{
    return {"man", "manual pages, made from the help texts", "damslip man fe | man -l -",
            with_flags<ManArguments>(man_flags, man)};
}

} // namespace damslip::cli
