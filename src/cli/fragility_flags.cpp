#include "cli/flags.hpp"
#include "cli/fragility_command.hpp"

namespace damslip::cli {

namespace {

void fragility_flags(CLI::App& sub, FragilityArguments& a)
{
    add_scene(sub, a.inputs);
    sub.add_option("--method", a.method,
                   "rigid (horizontal), rigid-v (with the vertical component), rocking (a block that rocks and "
                   "slides), fe, fe-exact, fe-penalty, "
                   "fe-slip-tolerance, fe-whole-steps, "
                   "fe-radiating, fe-massless, fe-reduced (few modes); default: rigid-v where a record has a vertical "
                   "component, else rigid");
    sub.add_option("--samples", a.samples,
                   "runs per level, rounded up to whole blocks; default: 1024, of finite elements 128")
        ->check(CLI::Range(1, 10'000'000));
    sub.add_option("--budget", a.budget,
                   "processor seconds of finite elements in place of --samples; a pilot of a tenth fixes the number")
        ->check(in_range(1.0, 1e9));
    sub.add_option("--conditioning", a.conditioning,
                   "on, off, auto: runs draw friction only where the rigid block, corrected by a pilot, does not know "
                   "whether the dam slides too far; auto: with finite elements, if no variable is epistemic. The rigid "
                   "block alone: P = F(mu*) of each draw of the rest, no friction drawn")
        ->check(CLI::IsMember({"auto", "on", "off"}))
        ->capture_default_str();
    sub.add_option("--aim-at", a.aim,
                   "a probability, where friction is conditioned on: two thirds of the runs go to the level whose P is "
                   "nearest to it; without it half of the runs make all P equally sure, half the annual rate")
        ->check(in_range(1e-9, 1.0));
    sub.add_option("--share-rows", a.rows, "rows of each of two samples for what P comes from; 0: not asked for")
        ->check(CLI::Range(0, 1'000'000))
        ->capture_default_str();
    sub.add_flag("--allow-scaling", a.allow_scaling, "records may be scaled beyond suite.max_scale; they are listed");
    add_out(sub, a.out, OutputPath::folder,
            "folder for samples.csv, fragility.csv, hazard.csv, summary.json, report.html, fragility.xml "
            "(OpenQuake) and a database of the runs for --resume",
            "-o,--out");
    add_pdf(sub, a.pdf);
    add_jobs(sub, a.jobs);
    const char* const group = "Long runs";
    sub.add_flag("--resume", a.resume, "go on where a run with the same --out stopped")->group(group);
    sub.add_option("--shard", a.shard, "i/n: the i-th of n parts, i from 0; its runs stay in a database in --out")
        ->group(group);
    sub.add_flag("--merge", a.merge, "put the parts in --out together")->group(group);
    sub.add_option("--slurm-array", a.slurm_array, "write a Slurm job script for all parts")
        ->check(output_to(OutputPath::file, "--slurm-array"))
        ->group(group);
    sub.add_option("--parts", a.parts, "of --slurm-array")
        ->check(CLI::Range(1, 1'000'000))
        ->capture_default_str()
        ->group(group);
}

} // namespace

Command fragility_command()
{
    return {"fragility", "how likely the dam slides too far: P by the strength of the earthquake, rates per year",
            "damslip fragility examples/fragility/dam.toml --out results/fragility",
            with_flags<FragilityArguments>(fragility_flags, fragility)};
}

} // namespace damslip::cli
