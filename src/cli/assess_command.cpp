#include "analysis/assess/assess.hpp"
#include "cli/flags.hpp"
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

struct AssessArguments {
    RunInputs inputs;
    double budget = 120.0;     ///< wall time [s]
    int jobs = 0;              ///< threads of the quick levels; 0: all cores
    std::filesystem::path out; ///< folder for report.html, assess.json, scene.resolved.toml; empty: none
    std::filesystem::path pdf; ///< the report as PDF; empty: none
};

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

/// Every level on one dam, with a recommended slip and its range.
/// @returns exit_code_of()
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
        name_report(a.out / "report.html", streams);
    }
    if (!a.pdf.empty()) print_pdf(page_html(assess_page(assessment, given)), a.pdf);
    return exit_code_of(assessment);
}

void assess_flags(CLI::App& sub, AssessArguments& a)
{
    add_run_inputs(sub, a.inputs);
    add_scale(sub, a.inputs);
    add_friction(sub, a.inputs);
    sub.add_option("--budget", a.budget, "seconds of wall time; what does not fit is left out and named")
        ->capture_default_str();
    add_out(sub, a.out, OutputPath::folder, "folder for report.html, assess.json and the resolved scene");
    add_pdf(sub, a.pdf);
    add_jobs(sub, a.jobs, "threads of the quick levels; 0: all cores");
}

} // namespace

Command assess_command()
{
    return {"assess", "every level on one dam: which one governs, what moves it, the slip to use and its range",
            "damslip assess examples/reference_dam.toml --out results/assess",
            with_flags<AssessArguments>(assess_flags, assess_dam)};
}

} // namespace damslip::cli
