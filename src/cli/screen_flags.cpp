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
    const char* const spectrum = "Response spectrum";
    CLI::Option* on = sub.add_flag("--response-spectrum", a.response_spectrum,
                                   "peaks of the dam on a bonded base by its modes: forces, stresses, factors")
                          ->group(spectrum);
    CLI::Option* file = sub.add_option("--spectrum", a.spectrum,
                                       "its spectrum at 5 % damping, period [s] and S_a over any unit, in place of the "
                                       "records'")
                            ->needs(on)
                            ->group(spectrum);
    CLI::Option* pga = sub.add_option("--spectrum-pga", a.pga, "S_a at period 0 of that spectrum [m/s^2]")
                           ->check(CLI::Range(1e-3, 100.0))
                           ->needs(file)
                           ->group(spectrum);
    file->needs(pga);
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
