#include "cli/assess_command.hpp"

#include "analysis/assess/assess.hpp"
#include "cli/print_pdf.hpp"
#include "cli/terminal/terminal_watch.hpp"
#include "core/file.hpp"
#include "core/usage_error.hpp"
#include "pages/assess/assess_report.hpp"
#include "pages/report/page_html.hpp"
#include "scene/write.hpp"

#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <ostream>

namespace damslip::cli {

using namespace pages;

namespace {

Scene scene_to_assess(const AssessArguments& a, const Streams& streams)
{
    if (!(a.budget > 0.0 && std::isfinite(a.budget)))
        refuse_usage(fmt::format("--budget {} is not allowed.", a.budget), "seconds > 0", "for example  --budget 120");
    Scene scene = read_run_scene(a.inputs, streams);
    need_section(scene, "damslip assess", "damslip screen SCENE gives the slip of the wedge");
    if (scene.motion.records.empty())
        throw InputError(Diagnostic{a.inputs.scene.string(), 0, 0, "the scene has no record.",
                                    "a [[motion.record]], or --record", "add  --record FILE"});
    return scene;
}

} // namespace

int assess_dam(const AssessArguments& a, const Streams& streams)
{
    const Scene given = scene_to_assess(a, streams);
    TerminalWatch watch(streams);
    const Assessment assessment = assess(given, {a.budget, a.jobs}, watch);
    const std::string json = assess_json(assessment, given).dump(2) + "\n";
    streams.out << (streams.form == Form::json ? json : assess_text(assessment, given));
    if (!a.out.empty()) {
        write_file(a.out / "assess.json", json);
        write_file(a.out / "scene.resolved.toml", resolved_toml(given));
        write_file(a.out / "report.html", page_html(assess_page(assessment, given)));
        if (!streams.quiet) streams.talk << "report: " << (a.out / "report.html").string() << "\n";
    }
    if (!a.pdf.empty()) print_pdf(page_html(assess_page(assessment, given)), a.pdf);
    return assessment.recommended || assessment.verdict == Verdict::fail ? exit_ok : exit_no_answer;
}

} // namespace damslip::cli
