#include "analysis/fragility/fragility_study.hpp"
#include "cli/accuracy_command.hpp"
#include "cli/print_pdf.hpp"
#include "cli/terminal/terminal_watch.hpp"
#include "core/file.hpp"
#include "core/usage_error.hpp"
#include "pages/fragility/interval_cost_report.hpp"
#include "pages/report/page_html.hpp"
#include "pages/report/table_text.hpp"
#include "pages/scene/report_provenance.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <ostream>

namespace damslip::cli {

using namespace pages;

namespace {

void check_probability_flags(const AccuracyArguments& a)
{
    const RunInputs& in = a.inputs;
    for (const auto& [flag, given] : {std::pair{"--rung", !a.rung.empty()},
                                      {"--quick", a.quick},
                                      {"--all-records", a.all_records},
                                      {"--record", !in.records.empty()},
                                      {"--friction", in.friction.has_value()},
                                      {"--scale", in.scale.has_value()},
                                      {"--svg", !a.svg.empty()}})
        if (given)
            refuse_usage(fmt::format("--probability together with {}.", flag),
                         "the scene's own tables [probability], [suite], [intensity], [[limit]]", "leave one out");
    need_scene_file(in, "--probability");
}

} // namespace

int accuracy_of_probability(const AccuracyArguments& a, const Streams& streams)
{
    check_probability_flags(a);
    const SceneText text = SceneText::read(a.inputs.scene);
    Scene scene = text.scene();
    say(scene.notes, a.inputs.strict, streams);
    FragilityInput input = read_fragility_input(a.inputs.scene);
    const FragilityStudy study = open_fragility(text, std::move(scene), std::move(input), a.method);
    const bool finite_elements = study.finite_elements();
    IntervalCostOptions options;
    options.method = study.method.id;
    options.rigid = study.rigid().id;
    if (a.level) options.level = *a.level * study.input.intensity.level_unit;
    options.runs = static_cast<std::size_t>(a.samples.value_or(finite_elements ? 128 : 16384));
    options.sizes = finite_elements ? 3 : 5;
    options.step = finite_elements ? 2 : 4;
    options.replicates = finite_elements ? 8 : 16;
    options.budget = a.budget;
    options.jobs = a.jobs;
    TerminalWatch watch(streams);
    const IntervalCost cost = interval_cost(study.input, study.suite, text, study.written, options, watch);
    const IntervalCostView view{study.scene,
                                cost,
                                *study.suite.pairs,
                                study.input.intensity.text,
                                study.input.intensity.level_unit,
                                study.input.intensity.level_unit_text};
    const std::string json = interval_cost_json(view).dump(2) + "\n";
    streams.out << (streams.form == Form::json ? json : interval_cost_text(view));
    const auto page = [&] { return page_html(interval_cost_page(view)); };
    if (!a.out.empty()) {
        write_file(a.out / "accuracy.csv",
                   csv(interval_cost_table(view), {fmt::format("scene {}", study.scene.file.string())}));
        write_file(a.out / "summary.json", json);
        write_file(a.out / "report.html", page());
        name_report(a.out / "report.html", streams);
    }
    if (!a.report.empty()) write_file(a.report, page());
    if (!a.pdf.empty()) print_pdf(page(), a.pdf);
    const bool any =
        std::any_of(cost.points.begin(), cost.points.end(), [](const IntervalPoint& p) { return p.done(); });
    return any && !watch.stop_asked() ? exit_ok : exit_no_answer;
}

} // namespace damslip::cli
