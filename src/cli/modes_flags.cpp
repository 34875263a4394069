#include "cli/flags.hpp"
#include "cli/modes_command.hpp"

namespace damslip::cli {

namespace {

void modes_flags(CLI::App& sub, ModesArguments& a)
{
    add_run_inputs(sub, a.inputs);
    add_rock(sub, a.inputs);
    sub.add_option("-n,--count", a.count, "number of modes")->check(CLI::Range(1, 200))->capture_default_str();
    sub.add_flag("--frf", a.frequency_response,
                 "transfer functions ground to crest and to the water's force, 0.1 ... 20 Hz");
    sub.add_option("--out", a.out, "folder for the mode shapes as VTU files and the transfer functions as CSV")
        ->check(output_to(OutputPath::folder, "--out"));
}

} // namespace

Command modes_command()
{
    return {"modes", "natural frequencies, effective masses, Rayleigh and modified Rayleigh coefficients",
            "damslip modes examples/reference_dam.toml --count 5", with_flags<ModesArguments>(modes_flags, modes)};
}

} // namespace damslip::cli
