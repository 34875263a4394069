#include "cli/flags.hpp"
#include "cli/verify_command.hpp"

namespace damslip::cli {

namespace {

void verify_flags(CLI::App& sub, VerifyArguments& a)
{
    sub.add_option("FILTER", a.filter,
                   "part of the case ids to run; with --external the folder of results that are not shipped");
    sub.add_flag("--hard", a.hard, "scenes chosen to break the numerics instead: two methods each");
    sub.add_flag("--external", a.external, "published results of others instead, each with its own accuracy");
    sub.add_option("--svg", a.svg, "with --external: scatter plot of slips, ours over theirs");
    sub.add_flag("--markdown", a.markdown, "print docs/verification.md, or with --external docs/evidence.md");
}

} // namespace

Command verify_command()
{
    return {"verify", "closed-form and published cases: expected, computed, error, pass",
            "damslip verify sliding.block", with_flags<VerifyArguments>(verify_flags, verify)};
}

} // namespace damslip::cli
