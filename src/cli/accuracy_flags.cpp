#include "cli/accuracy_command.hpp"
#include "cli/flags.hpp"

namespace damslip::cli {

namespace {

void accuracy_flags(CLI::App& sub, AccuracyArguments& a)
{
    add_run_inputs(sub, a.inputs);
    sub.add_option("--scale", a.inputs.scale, "factor on all records")->group("Ground motion");
    sub.add_flag("--all-records", a.all_records, "all records of the scene, the worst counts; else its first")
        ->group("Ground motion");
    sub.add_option("--friction", a.inputs.friction, "Coulomb mu instead of the scene's");
    sub.add_option("--tolerance", a.tolerance, "names the cheapest rung within this share of the finest's slip")
        ->capture_default_str();
    sub.add_option("--repeats", a.repeats, "runs of a rung for its median time; fewer of rungs above a second")
        ->capture_default_str();
    sub.add_option("--budget", a.budget,
                   "processor seconds for all rungs together; what would exceed them is listed as skipped")
        ->capture_default_str();
    sub.add_flag("--quick", a.quick, "fewer steps, no finer mesh, one reduced run, no other contact law or scheme");
    sub.add_option("--rung", a.rung, "run this rung alone, named as in the table: fe-acoustic:dt/4,2h");
    sub.add_option("--out", a.out,
                   "folder for report.html, accuracy.csv, accuracy.svg, summary.json and the rungs' scenes")
        ->check(output_to(OutputPath::folder, "--out"));
    sub.add_option("--report", a.report, "the report alone (.html)")->check(output_to(OutputPath::file, "--report"));
    add_pdf(sub, a.pdf);
    sub.add_option("--svg", a.svg, "the chart alone (.svg)")->check(output_to(OutputPath::file, "--svg"));
}

} // namespace

Command accuracy_command()
{
    return {"accuracy", "what accuracy costs: every method on this scene, its error and its seconds",
            "damslip accuracy examples/reference_dam.toml --tolerance 0.02 --out results/accuracy",
            with_flags<AccuracyArguments>(accuracy_flags, accuracy)};
}

} // namespace damslip::cli
