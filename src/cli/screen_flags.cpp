#include "cli/flags.hpp"
#include "cli/screen_command.hpp"

namespace damslip::cli {

namespace {

void screen_flags(CLI::App& sub, ScreenArguments& a)
{
    add_run_inputs(sub, a.inputs);
    sub.add_option("--scale", a.inputs.scale, "factor on all records")->group("Ground motion");
    sub.add_option("--friction", a.inputs.friction, "Coulomb mu instead of the scene's");
    sub.add_option("--scheme", a.inputs.scheme, "of the rigid block: exact (default) or slammer");
    sub.add_flag("--rocking", a.rocking,
                 "the block that rocks and slides, too; without it where the sliding block does not hold");
    sub.add_flag("--mean-polarity", a.mean_polarity, "a table with the mean slip of both polarities of each record");
    add_response_spectrum(sub, a.spectrum);
    sub.add_option("--out", a.out, "folder for summary.json, displacements.csv and the resolved scene")
        ->check(output_to(OutputPath::folder, "--out"));
    add_pdf(sub, a.pdf);
    sub.add_option("-j,--jobs", a.jobs, "threads; 0: all cores")->check(CLI::Range(0, 1024));
}

} // namespace

Command screen_command()
{
    return {"screen", "limit equilibrium, yield accelerations, rigid-block displacement and regressions",
            "damslip screen examples/reference_dam.toml --record ns.at2 --vertical up.at2",
            with_flags<ScreenArguments>(screen_flags, screen)};
}

} // namespace damslip::cli
