#include "verification/program/carry.hpp"

#include "analysis/sweep/fe_sweep.hpp"
#include "cli/command.hpp"
#include "cli/input/make_axes.hpp"
#include "cli/terminal/terminal.hpp"
#include "core/file.hpp"
#include "core/input_error.hpp"
#include "pages/report/page.hpp"
#include "pages/report/table_text.hpp"
#include "pages/sweep/sweep_pages.hpp"
#include "records/measure/measures.hpp"
#include "studies/goldgruber_2015/study_page.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <numeric>
#include <ostream>

namespace damslip::cli {

using namespace pages;
using namespace study;

namespace {

SweepArguments grid_arguments(const StudyArguments& a)
{
    SweepArguments grid;
    grid.inputs = a.inputs;
    grid.friction = fmt::format("{}", fmt::join(chapter_4::frictions, ","));
    grid.uplift = fmt::format("{}", fmt::join(chapter_4::uplifts, ","));
    grid.reservoir = fmt::format("{}", fmt::join(chapter_4::waters, ","));
    grid.size = fmt::format("{}", fmt::join(chapter_4::sizes, ","));
    grid.method = a.method;
    grid.out = a.out / "rows.csv";
    return grid;
}

void check_scene(const Scene& scene)
{
    const auto usage = [&scene](const std::string& problem, const char* expected, const std::string& fix) {
        throw UsageError(Diagnostic{scene.file.string(), 0, 0, problem, expected, fix});
    };
    std::string missing;
    const auto need = [&missing](bool given, const char* table) {
        if (!given) missing += (missing.empty() ? "" : ", ") + std::string(table);
    };
    need(scene.reservoir.has_value(), "[reservoir]");
    need(scene.curtain.has_value(), "[curtain]");
    need(scene.foundation.has_value(), "[foundation]");
    if (!missing.empty())
        usage("damslip study needs " + missing + ".", "a dam with water, curtain and rock: the study varies them",
              "add " + missing + ", or take damslip sweep, which needs none of them");
    if (scene.motion.records.empty())
        usage("there is no record.", "a [[motion.record]] in the scene or --record", "add  --record FILE");
}

/// `damslip study`: the grid of Goldgruber (2015), chapter 4, on the scene's dam under its first record, and what of the source's
/// findings came out.

} // namespace

int study(const StudyArguments& arguments, const Streams& streams)
{
    // 1. the scene and the grid of the chapter
    Scene scene = read_run_scene(arguments.inputs, streams);
    need_section(scene, "damslip study", "damslip screen or sweep SCENE for the wedge");
    check_scene(scene);
    scene.motion.records.resize(1);
    const SweepArguments sweep = grid_arguments(arguments);
    Axes axes = make_axes(sweep, scene);
    axes.polarity = {study_polarity(scene)};
    const TaskList tasks = make_tasks(axes, 1);
    const Records records = load_records(scene, Method::rigid_block);

    // 2. its rows
    const Sweep inputs{scene, axes, tasks, records};
    check_fe_scenes(inputs);
    const SweepIdentity identity = sweep_identity(inputs);
    make_folder(arguments.out);
    ResultStore store(store_of(sweep.out), identity, {}, arguments.resume ? StoreStart::resume : StoreStart::fresh);
    const Grid grid = make_grid(scene, axes, tasks, records, arguments.jobs);
    std::vector<std::size_t> wanted(tasks.rows());
    std::iota(wanted.begin(), wanted.end(), 0u);
    TerminalWatch watch(streams);
    const SweepOutcome outcome = run_sweep(inputs, grid, wanted, &store, arguments.jobs, watch);
    if (!outcome.complete()) {
        streams.talk << fmt::format("interrupted: {} of {} rows are finished; go on with --resume\n",
                                    outcome.rows.size(), outcome.wanted);
        return exit_no_answer;
    }

    // 3. what they say of the chapter's findings
    const StudyRows rows(grid, outcome);
    const Table table = sweep_table(grid, wanted, outcome);
    const SweepView view = sweep_view(grid, wanted, outcome);
    const std::vector<StudyUplift> uplifts = study_uplifts(scene);
    const std::vector<ModelModes> modes = study_modes(scene);
    const RegressionsBeside regressions = regressions_beside_block(scene, records->front());
    const double pga = grid.measured.front().pga_g * units::standard_gravity;
    const std::vector<Finding> findings = study_findings({scene, rows, uplifts, modes, regressions, pga});

    std::vector<SettingsStep> settings;
    if (axes.finite_elements()) settings = settings_steps(scene, records, arguments.jobs, watch);

    // 4. files
    write_file(sweep.out, csv(table, csv_comments(identity)));
    write_file(arguments.out / "findings.csv", csv(findings_table(findings)));
    const std::filesystem::path page = arguments.out / "report.html";
    const StudyPageInput in{scene, rows, table, view, *records, uplifts, modes, regressions, findings, settings};
    write_file(page, page_html(study_page(in)));
    store.mark_done();
    streams.out << (streams.form == Form::json ? study_json(in).dump(2) + "\n" : findings_text(findings));
    if (!streams.quiet)
        streams.talk << fmt::format("{} rows in {}\nreport: {}\n", table.rows.size(), sweep.out.string(),
                                    page.string());
    if (const std::string words = view.unanswered.words(); !words.empty()) streams.talk << words << "\n";
    int code = outcome.all_good() ? exit_ok : exit_no_answer;
    for (const SettingsStep& step : settings) {
        if (!step.unanswered.empty()) streams.talk << fmt::format("{}: {}\n", step.change, step.unanswered.words());
        code = worse_exit_code(code, step.unanswered.exit_code());
    }
    return code;
}

} // namespace damslip::cli
