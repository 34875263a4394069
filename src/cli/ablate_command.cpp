#include "cli/ablate_command.hpp"

#include "analysis/prepare/ready.hpp"
#include "cli/terminal/terminal_watch.hpp"
#include "core/file.hpp"
#include "core/usage_error.hpp"
#include "pages/ablation/ablation_report.hpp"
#include "pages/ablation/ablation_tables.hpp"
#include "pages/report/json_object.hpp"
#include "pages/report/page_html.hpp"
#include "pages/report/table_text.hpp"
#include "pages/scene/effect_table.hpp"
#include "scene/write.hpp"

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

nlohmann::ordered_json json_of_ablations(const Ablations& in)
{
    nlohmann::ordered_json j;
    j["removals"] = json_of(removal_table(in));
    if (in.runs.step)
        j["step"] = {{"substeps", in.runs.step->halvings},
                     {"dt_s", in.runs.step->largest_dt},
                     {"chosen", in.runs.step->chosen},
                     {"error_from_substeps", in.runs.step->other}};
    if (in.plan.method == Method::rigid_block) j["yield"] = json_of(yield_change_table(in));
    j["changes"] = json_of(change_table_of_all(in));
    j["notes"] = ablation_notes(in);
    j["seconds"] = {{"jobs", in.runs.jobs}, {"scenes", json_of(seconds_table(in))}};
    return j;
}

void print_text(const Scene& scene, const EffectPlan& plan, const Ablations& in, std::ostream& out)
{
    out << scene.title << "\n\n" << pages::text(effect_table(plan)) << "\n" << pages::text(removal_table(in)) << "\n";
    if (in.plan.method == Method::rigid_block) out << pages::text(yield_change_table(in)) << "\n";
    for (std::size_t r = 0; r < in.records.size(); ++r) out << pages::text(change_table(in, r)) << "\n";
    out << pages::text(seconds_table(in));
    for (const std::string& note : ablation_notes(in)) out << "note: " << note << "\n";
}

} // namespace

int ablate(const ExplainArguments& arguments, const Streams& streams)
{
    const Method method = arguments.method == "fe" ? Method::finite_elements : Method::rigid_block;
    const Scene given = read_run_scene(arguments.inputs, streams);
    need_section(given, "damslip explain --ablate", "damslip explain SCENE gives the effects of the wedge");
    check_records(given, method);
    const Ready ready =
        prepare(given, method, {.stop = streams.stop}); // the water is chosen once: no removal changes it
    const Scene& scene = ready.given;
    const EffectPlan& effects = ready.plan;
    const std::vector<RecordPair>& records = ready.records();
    const AblationPlan plan = make_ablations(scene, method, seepage_points(scene));

    TerminalWatch watch(streams);
    const AblationRuns runs = run_ablations(plan, ready.pairs, arguments.jobs, watch);
    const Ablations ablations{plan, records, runs, ready.reservoir ? ready.reservoir->reason : std::string()};
    if (streams.form == Form::json) {
        auto j = json_header("explain");
        j["scene"] = {{"title", scene.title}, {"file", scene.file.string()}, {"hash", scene_hash(given)}};
        j["method"] = arguments.method;
        j["effects"] = json_of(effect_table(effects));
        j["ablation"] = json_of_ablations(ablations);
        streams.out << j.dump(2) << "\n";
    } else {
        print_text(scene, effects, ablations, streams.out);
    }
    if (!arguments.report.empty()) {
        write_file(arguments.report, pages::page_html(ablation_page(ablations, given, effects)));
        if (!streams.quiet) streams.talk << "report: " << arguments.report.string() << "\n";
    }
    return unanswered_runs(runs).exit_code();
}

} // namespace damslip::cli
