#include "cli/fe_command.hpp"

#include "cli/contact_run.hpp"
#include "cli/reduced_command.hpp"
#include "cli/tied_run.hpp"

#include <fmt/format.h>
#include <ostream>

namespace damslip::cli {

FeOptions fe_options(const FeArguments& arguments)
{
    return {arguments.polarity, arguments.mesh_error, !arguments.out.empty(), arguments.modes};
}

void say_written(const std::filesystem::path& folder, const Streams& streams)
{
    if (folder.empty() || streams.quiet) return;
    streams.talk << "written: " << (folder / "summary.json").string()
                 << ", tables of each record (*.csv), fields.pvd, scene.resolved.toml\n";
}

int fe(const FeArguments& arguments, const Streams& streams)
{
    const Scene given = read_run_scene(arguments.inputs, streams);
    need_section(given, "damslip fe", "damslip screen SCENE gives the slip of the wedge");
    const Ready ready = prepare(given, Method::finite_elements, {.reduced = arguments.reduced, .stop = streams.stop});
    if (!streams.quiet && ready.reservoir) streams.talk << ready.reservoir->reason << "\n";
    if (!streams.quiet && ready.dam_period)
        streams.talk << fmt::format("added mass for the dam's own period {:.5g} s\n", 1 / ready.dam_period->frequency);
    if (arguments.reduced) return run_reduced(arguments, ready, streams);
    return arguments.base == "tied" ? run_tied(arguments, ready, streams) : run_contact(arguments, ready, streams);
}

} // namespace damslip::cli
