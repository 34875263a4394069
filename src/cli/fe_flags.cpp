#include "cli/fe_command.hpp"
#include "cli/flags.hpp"

namespace damslip::cli {

namespace {

void fe_flags(CLI::App& sub, FeArguments& a)
{
    add_run_inputs(sub, a.inputs);
    sub.add_option("--scale", a.inputs.scale, "factor on all records")->group("Ground motion");
    sub.add_option(
           "--polarity", a.polarity,
           "run 1 or -1 alone; -1 flips the horizontal component (default: both, or motion.polarity of the scene)")
        ->check(CLI::IsMember({1, -1}))
        ->group("Ground motion");
    sub.add_option("--friction", a.inputs.friction, "Coulomb mu instead of the scene's");
    add_rock(sub, a.inputs);
    sub.add_option("--base", a.base, "contact: the dam slides, opens and rocks; tied: it is bonded to its base")
        ->check(CLI::IsMember({"contact", "tied"}))
        ->capture_default_str();
    sub.add_flag("!--no-mesh-error", a.mesh_error,
                 "leave out the run on elements of twice the size that tells what the mesh leaves open of the slip");
    sub.add_flag(
        "--spread", a.spread,
        "run the worst record on massless rock (or radiating, where the scene's has no mass) and with added mass in "
        "place of acoustic water, too: how far the models lie apart");
    sub.add_option("--state-out", a.state_out,
                   "file for the state of the joints after the earthquake, of one record and polarity")
        ->check(output_to(OutputPath::file, "--state-out"))
        ->group("State of the joints");
    sub.add_option("--state-in", a.state_in,
                   "go on from that file: the same dam as another earthquake has left it; the slip counts from there")
        ->group("State of the joints");
    CLI::Option* reduced =
        sub.add_flag("--reduced", a.reduced, "earthquake on few modes of the dam; slip with an error estimate")
            ->group("Reduced run");
    sub.add_option("--modes", a.modes, "elastic modes kept (12)")
        ->check(CLI::Range(1, 1000))
        ->needs(reduced)
        ->group("Reduced run");
    reduced->excludes(sub.get_option("--base"));
    CLI::Option* out =
        sub.add_option("--out", a.out, "folder for summary.json, histories (CSV), fields (VTU) and the resolved scene")
            ->check(output_to(OutputPath::folder, "--out"));
    sub.add_option("--frames", a.frames,
                   "so many instants of each record as a time series for ParaView: frames_*.pvd in the folder of --out")
        ->check(CLI::Range(2, 10000))
        ->needs(out)
        ->excludes(reduced);
    add_response_spectrum(sub, a.spectrum);
    add_pdf(sub, a.pdf);
}

} // namespace

Command fe_command()
{
    return {"fe", "staged finite-element run: gravity, impounding, uplift, earthquake",
            "damslip fe examples/reference_dam.toml --out results/fe", with_flags<FeArguments>(fe_flags, fe)};
}

} // namespace damslip::cli
