#include "cli/screen_command.hpp"

#include "core/usage_error.hpp"
#include "pages/scene/report_provenance.hpp"
#include "pages/screen/screen_report.hpp"
#include "scene/plausible.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <ostream>

namespace damslip::cli {

using namespace pages;

int screen(const ScreenArguments& arguments, const Streams& streams)
{
    PrepareOptions options;
    options.flexible_modes = true;
    options.stop = streams.stop;
    const Ready ready = prepare(read_run_scene(arguments.inputs, streams), Method::rigid_block, options);
    if (!streams.quiet)
        for (const std::string& warning : record_warnings(ready.records())) streams.talk << "note: " << warning << "\n";

    if (arguments.rocking && ready.scene.wedge)
        refuse_usage("--rocking cannot take a [wedge]: it has no toe to rock on.", "a scene with a [section]",
                     "delete --rocking");
    Screening s = run_screening(ready, arguments.jobs,
                                arguments.rocking ? RockingRuns::always : RockingRuns::where_sliding_does_not_hold);
    for (std::string& note : note_texts(ready.given.notes)) s.warnings.push_back(std::move(note));
    if (!ready.flexible_modes.empty()) s.warnings.push_back(ready.flexible_modes);
    if (!ready.given.lift_joints.empty())
        s.warnings.push_back(fmt::format("Combinations and displacements are of the base only; slip on the {} "
                                         "[[lift_joint]] is left to `damslip fe`.",
                                         ready.given.lift_joints.size()));
    const ScreenReportInput in{ready.given, ready.scene, s, ready.records(), arguments.jobs};
    streams.out << (streams.form == Form::json ? screen_json(in).dump(2) + "\n" : screen_text(in));
    if (!arguments.out.empty()) {
        write_screening(arguments.out, in);
        if (!streams.quiet)
            streams.talk << "written: " << (arguments.out / "summary.json").string() << ", displacements.csv, "
                         << (has_rocking(s) ? "rocking_block.csv, " : "") << (s.flexible ? "flexible_block.csv, " : "")
                         << "scene.resolved.toml\nreport: " << (arguments.out / "report.html").string() << "\n";
    }
    return statuses_of(s).exit_code();
}

} // namespace damslip::cli
