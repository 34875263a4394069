#include "cli/accuracy_command.hpp"
#include "cli/flags.hpp"

namespace damslip::cli {

namespace {

void accuracy_flags(CLI::App& sub, AccuracyArguments& a)
{
    add_run_inputs(sub, a.inputs);
    add_scale(sub, a.inputs);
    sub.add_flag("--all-records", a.all_records, "all records of the scene, the worst counts; else its first")
        ->group("Ground motion");
    add_friction(sub, a.inputs);
    sub.add_option("--tolerance", a.tolerance, "names the cheapest model level within this share of the finest's slip")
        ->capture_default_str();
    sub.add_option("--repeats", a.repeats, "runs of a model level for its median time; fewer of those above a second")
        ->capture_default_str();
    sub.add_option("--budget", a.budget,
                   "processor seconds for all model levels together; what would exceed them is listed as skipped")
        ->capture_default_str();
    sub.add_flag("--quick", a.quick, "fewer steps, no finer mesh, one reduced run, no other contact law or scheme");
    sub.add_option("--rung", a.rung, "run this model level alone, named as in the table: fe-acoustic:dt/4,2h");
    add_out(sub, a.out, OutputPath::folder,
            "folder for report.html, accuracy.csv, accuracy.svg, summary.json and the scenes of all model levels");
    sub.add_option("--report", a.report, "the report alone (.html)")->check(output_to(OutputPath::file, "--report"));
    add_pdf(sub, a.pdf);
    const char* const group = "Probability";
    sub.add_flag(
           "--probability", a.probability,
           "half-width of the 95 % interval of P over processor seconds, by plain Monte Carlo, Latin hypercubes and "
           "Sobol' points; of a scene for fragility, its first limit")
        ->group(group);
    sub.add_option("--method", a.method, "as of fragility; default: rigid-v or rigid")->group(group);
    sub.add_option("--level", a.level, "intensity in the unit of the levels; default: where P is nearest to 0.1")
        ->check(in_range(1e-9, 1e9))
        ->group(group);
    sub.add_option("--samples", a.samples, "runs of the largest estimate; default: 16384, of finite elements 128")
        ->check(CLI::Range(16, 10'000'000))
        ->group(group);
    add_jobs(sub, a.jobs)->group(group);
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
