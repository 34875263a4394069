#include "cli/explain_command.hpp"

#include "analysis/prepare/ready.hpp"
#include "cli/terminal/terminal_watch.hpp"
#include "core/file.hpp"
#include "core/usage_error.hpp"
#include "pages/ablation/ablation_tables.hpp"
#include "pages/report/page_html.hpp"

#include <nlohmann/json.hpp>
#include <ostream>

namespace damslip::cli {

using namespace pages;

namespace {

void check_records(const Scene& scene, Method method)
{
    if (method == Method::rigid_block || !scene.motion.records.empty()) return;
    throw UsageError(Diagnostic{scene.file.string(), 0, 0, "--ablate --method fe without a record.",
                                "at least one record: slips are what is compared",
                                "add  --record FILE  or a [[motion.record]]"});
}

} // namespace

int ablate(const ExplainArguments& arguments, const Streams& streams)
{
    const Method method = arguments.method == "fe" ? Method::finite_elements : Method::rigid_block;
    const Scene given = read_run_scene(arguments.inputs, streams);
    need_section(given, "damslip explain --ablate", "damslip explain SCENE gives the effects of the wedge");
    if (method == Method::finite_elements) say_base(given, streams);
    check_records(given, method);
    const Ready ready =
        prepare(given, method, {.stop = streams.stop}); // the water is chosen once: no removal changes it
    const AblationPlan plan = make_ablations(ready.given, method, seepage_points(ready.given));

    TerminalWatch watch(streams);
    const AblationRuns runs = run_ablations(plan, ready.pairs, arguments.jobs, watch);
    const Ablations ablations{plan, ready.records(), runs, ready.reservoir ? ready.reservoir->reason : std::string()};
    streams.out << (streams.form == Form::json ? ablation_json(ablations, given, ready.plan).dump(2) + "\n"
                                               : ablation_text(ablations, ready.plan));
    if (!arguments.report.empty()) {
        write_file(arguments.report, page_html(ablation_page(ablations, given, ready.plan)));
        if (!streams.quiet) streams.talk << "report: " << arguments.report.string() << "\n";
    }
    return unanswered_runs(runs).exit_code();
}

} // namespace damslip::cli
