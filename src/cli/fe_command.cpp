#include "cli/fe_command.hpp"

#include "analysis/prepare/fe_inputs.hpp"
#include "cli/contact_run.hpp"
#include "cli/reduced_command.hpp"
#include "cli/tied_run.hpp"
#include "core/usage_error.hpp"

#include <fmt/format.h>
#include <ostream>

namespace damslip::cli {

std::vector<int> polarities_of(const FeArguments& arguments, const Scene& scene)
{
    if (arguments.polarity || scene.motion.polarity) return {arguments.polarity.value_or(1)};
    return {1, -1};
}

int shown_polarity(const Scene& scene, int polarity)
{
    return scene.motion.polarity.value_or(1) * polarity;
}

void say_written(const std::filesystem::path& folder, const Streams& streams)
{
    if (folder.empty() || streams.quiet) return;
    streams.talk << "written: " << (folder / "summary.json").string()
                 << ", tables of each record (*.csv), fields.pvd, scene.resolved.toml\n";
}

int fe(const FeArguments& arguments, const Streams& streams)
{
    Scene given = read_run_scene(arguments.inputs, streams);
    need_section(given, "damslip fe", "damslip screen SCENE gives the slip of the wedge");
    EffectPlan plan = make_effect_plan(given, Method::finite_elements);
    Scene scene = fe_scene(given, plan);
    if (!arguments.reduced) // reduced runs have the modes of the dam alone
        if (const auto choice = resolve_reservoir_model(scene, streams.stop)) {
            if (!streams.quiet) streams.talk << choice->reason << "\n";
            given.reservoir->model = scene.reservoir->model; // the plan names what was chosen
            plan = make_effect_plan(given, Method::finite_elements);
        }
    const std::vector<RecordPair> records = read_records(scene, plan);
    if (const auto period = resolve_dam_period(scene, streams.stop); period && !streams.quiet)
        streams.talk << fmt::format("added mass for the dam's own period {:.5g} s\n", 1 / period->frequency);
    if (arguments.reduced) return run_reduced(arguments, scene, plan, records, streams);
    return arguments.base == "tied" ? run_tied(arguments, scene, plan, records, streams)
                                    : run_contact(arguments, scene, plan, records, streams);
}

} // namespace damslip::cli
