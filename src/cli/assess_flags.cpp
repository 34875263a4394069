#include "cli/assess_command.hpp"
#include "cli/flags.hpp"

namespace damslip::cli {

namespace {

void assess_flags(CLI::App& sub, AssessArguments& a)
{
    add_run_inputs(sub, a.inputs);
    sub.add_option("--scale", a.inputs.scale, "factor on all records")->group("Ground motion");
    sub.add_option("--friction", a.inputs.friction, "Coulomb mu instead of the scene's");
    sub.add_option("--budget", a.budget, "seconds of wall time; what does not fit is left out and named")
        ->capture_default_str();
    sub.add_option("--out", a.out, "folder for report.html, assess.json and the resolved scene")
        ->check(output_to(OutputPath::folder, "--out"));
    add_pdf(sub, a.pdf);
    sub.add_option("-j,--jobs", a.jobs, "threads of the quick levels; 0: all cores")->check(CLI::Range(0, 1024));
}

} // namespace

Command assess_command()
{
    return {"assess", "every level on one dam: which one governs, what moves it, the slip to use and its range",
            "damslip assess examples/reference_dam.toml --out results/assess",
            with_flags<AssessArguments>(assess_flags, assess_dam)};
}

} // namespace damslip::cli
