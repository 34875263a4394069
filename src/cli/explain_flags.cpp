#include "cli/explain_command.hpp"
#include "cli/flags.hpp"

namespace damslip::cli {

namespace {

void explain_flags(CLI::App& sub, ExplainArguments& a)
{
    add_run_inputs(sub, a.inputs);
    add_rock(sub, a.inputs);
    sub.add_option("--scale", a.inputs.scale, "factor on all records")->group("Ground motion");
    sub.add_option("--friction", a.inputs.friction, "Coulomb mu instead of the scene's");
    sub.add_option("--method", a.method, "rigid or fe")->check(CLI::IsMember({"rigid", "fe"}))->capture_default_str();
    const char* const group = "Ablation";
    CLI::Option* ablate =
        sub.add_flag("--ablate", a.ablate,
                     "runs the scene without each of its effects in turn: change of slip and crest motion, seconds")
            ->group(group);
    sub.add_option("--report", a.report, "HTML file with the changes as charts")
        ->check(output_to(OutputPath::file, "--report"))
        ->needs(ablate)
        ->group(group);
    sub.add_option("-j,--jobs", a.jobs, "threads; 0: all cores; with 1 (default) the seconds are fair")
        ->check(CLI::Range(0, 1024))
        ->needs(ablate)
        ->group(group);
}

} // namespace

Command explain_command()
{
    return {"explain", "the effect plan: what is taken into account, why, and what it costs",
            "damslip explain examples/reference_dam.toml --ablate --report ablation.html",
            with_flags<ExplainArguments>(explain_flags, explain)};
}

} // namespace damslip::cli
