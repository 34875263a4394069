#include "analysis/assess/assess.hpp"
#include "analysis/screen/regression_rows.hpp"
#include "analysis/spectrum/spectrum_level.hpp"
#include "cli/command.hpp"
#include "cli/model_commands.hpp"
#include "cli/terminal/terminal.hpp"
#include "cli/verifier.hpp"
#include "core/file.hpp"
#include "core/input_error.hpp"
#include "core/status.hpp"
#include "core/text.hpp"
#include "core/units.hpp"
#include "pages/assess/assess_pages.hpp"
#include "pages/report/answer.hpp"
#include "pages/report/page.hpp"
#include "pages/report/table_text.hpp"
#include "pages/scene/scene_pages.hpp"
#include "pages/screen/screen_pages.hpp"
#include "pages/sheet/workbook.hpp"
#include "scene/write.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <optional>
#include <ostream>

namespace damslip::cli {

using namespace pages;

namespace {

struct ScreenArguments {
    RunInputs inputs;
    std::filesystem::path out;  ///< folder for summary.json, tables (CSV) and the resolved scene; empty: none
    std::filesystem::path pdf;  ///< the report on paper; empty: none
    std::filesystem::path sheet; ///< limit equilibrium as a workbook of formulas; empty: none
    bool rigid_only = false;    ///< the elastic dam is left out
    bool rocking = false;       ///< the block that rocks, too, where the sliding one holds
    SpectrumArguments spectrum; ///< peaks by the modes, too
    bool mean_polarity = false; ///< a table with the mean of both polarities
    int jobs = 0;               ///< threads; 0: all cores
};

/// The response spectrum's answer, on the model of finite elements.
std::shared_ptr<const SpectrumLevel> spectrum_of_elements(const SpectrumArguments& a,
                                                          const std::vector<LevelSpectrum>& spectra, const Scene& given,
                                                          const Ready& ready, const Streams& streams)
{
    if (!a.wanted) return nullptr;
    check_spectrum_level(a, !ready.records().empty());
    return find_spectrum_level(a, spectra,
                               prepare(given, Method::finite_elements, ready.pairs, {.stop = streams.stop}));
}

/// Limit equilibrium, yield accelerations, rigid-block displacements and regressions for every record of the scene.
int screen(const ScreenArguments& arguments, const Streams& streams)
{
    PrepareOptions options;
    options.flexible_modes = true;
    options.stop = streams.stop;
    const Scene given = read_run_scene(arguments.inputs, streams);
    if (arguments.rocking && given.wedge)
        refuse_usage("--rocking cannot take a [wedge]: it has no toe to rock on.", "a scene with a [section]",
                     "delete --rocking");
    if (arguments.spectrum.wanted)
        need_section(given, "damslip screen --response-spectrum", "a wedge is rigid: leave the flag out");
    if (!arguments.sheet.empty() && given.wedge)
        refuse_usage("--sheet cannot take a [wedge]: it has no load combinations.", "a scene with a [section]", "delete --sheet");
    const std::vector<LevelSpectrum> spectra = given_spectra(arguments.spectrum);
    const Ready ready = prepare(given, Method::rigid_block, options);
    for (const std::string& warning : record_warnings(ready.records())) streams.remark("note: " + warning);

    const std::shared_ptr<const SpectrumLevel> spectrum =
        spectrum_of_elements(arguments.spectrum, spectra, given, ready, streams);
    Screening s = run_screening(ready, arguments.jobs,
                                arguments.rocking ? RockingRuns::always : RockingRuns::where_sliding_does_not_hold);
    if (!arguments.rigid_only) {
        TerminalWatch watch(streams);
        add_elastic_dam(ready, arguments.jobs, watch, s);
    }
    for (std::string& note : screen_notes(ready)) s.warnings.push_back(std::move(note));
    const ScreenReportInput in{
        ready.given, ready.scene, s, ready.records(), arguments.jobs, spectrum.get(), arguments.mean_polarity};
    const Answer answer = screen_answer(in);
    put_answer(answer, "--out DIR", streams);
    if (!arguments.out.empty()) {
        write_screening(arguments.out, in, answer);
        if (!streams.quiet)
            streams.talk << "written: " << (arguments.out / "summary.json").string() << ", displacements.csv, "
                         << (!given.wedge ? "equilibrium.csv, verdicts.csv, yield.csv, " : "")
                         << (has_rocking(s) ? "rocking_block.csv, " : "") << (s.flexible ? "flexible_block.csv, " : "")
                         << "scene.resolved.toml\nreport: " << (arguments.out / "report.html").string() << "\n";
    }
    if (!arguments.pdf.empty()) {
        print_pdf(page_html(screen_page(in)), arguments.pdf);
        name_report(arguments.pdf, streams);
    }
    if (!arguments.sheet.empty()) {
        write_sheet(arguments.sheet, [&](const auto& file) { write_equilibrium_sheets(file, ready, s.combinations); });
        name_report(arguments.sheet, streams);
    }
    return std::max(statuses_of(s).exit_code(), s.elastic ? exit_code_of(s.elastic->runs) : exit_ok);
}

void screen_flags(CLI::App& sub, ScreenArguments& a)
{
    add_run_inputs(sub, a.inputs);
    add_scale(sub, a.inputs);
    add_friction(sub, a.inputs);
    sub.add_option("--scheme", a.inputs.scheme, "of the rigid block: exact (default) or slammer");
    sub.add_flag("--rigid-only", a.rigid_only,
                 "leave out the elastic dam (reduced finite elements): faster, and no PASS for a dam");
    sub.add_flag("--rocking", a.rocking,
                 "the block that rocks and slides, too; without it where the sliding block does not hold");
    sub.add_flag("--mean-polarity", a.mean_polarity, "a table with the mean slip of both polarities of each record");
    add_response_spectrum(sub, a.spectrum);
    add_out(sub, a.out, OutputPath::folder, "folder for summary.json, tables (CSV) and the resolved scene");
    add_pdf(sub, a.pdf);
    add_sheet(sub, a.sheet, "workbook (.xlsx, .ods) of the load combinations as formulas, to check by hand");
    add_jobs(sub, a.jobs);
}

} // namespace

Command screen_command()
{
    return {"screen", "limit equilibrium, yield accelerations, rigid-block displacement and regressions",
            "damslip screen examples/reference_dam.toml --record records/data/rock_1.0_h.csv --vertical "
            "records/data/rock_1.0_v.csv",
            with_flags<ScreenArguments>(screen_flags, screen)};
}

namespace {

struct AssessArguments {
    RunInputs inputs;
    double budget = 120.0;     ///< wall time [s]
    int jobs = 0;              ///< threads of the quick levels; 0: all cores
    std::filesystem::path out; ///< folder for report.html, assess.json, scene.resolved.toml; empty: none
    std::filesystem::path pdf; ///< the report as PDF; empty: none
    bool plan = false;         ///< what it would do, in place of doing it
};

Scene scene_to_assess(const AssessArguments& a, const Streams& streams)
{
    if (!(a.budget > 0.0 && std::isfinite(a.budget)))
        refuse_usage(fmt::format("--budget {} is not allowed.", a.budget), "seconds > 0", "for example  --budget 120");
    Scene scene = read_run_scene(a.inputs, streams);
    need_section(scene, "damslip assess", "damslip screen SCENE gives the slip of the wedge");
    if (scene.motion.records.empty())
        refuse(a.inputs.scene, "the scene has no record.", "a [[motion.record]], or --record", "add  --record FILE");
    return scene;
}

/// Writes answer and page into the folder, and the page as PDF. @param name  of the JSON file
void write_assessment(const AssessArguments& a, const Scene& given, const Answer& answer, const Page& page, const char* name,
                      const Streams& streams)
{
    if (!a.out.empty()) {
        const std::filesystem::path report = a.out / (a.plan ? "plan.html" : "report.html");
        write_file(a.out / name, answer.json().dump(2) + "\n");
        write_file(a.out / "scene.resolved.toml", resolved_toml(given));
        write_file(report, page_html(page));
        name_report(report, streams);
    }
    if (!a.pdf.empty()) print_pdf(page_html(page), a.pdf);
}

/// Every level on one dam, with a recommended slip and its range.
/// @returns exit_code_of()
int assess_dam(const AssessArguments& a, const Streams& streams)
{
    const Scene given = scene_to_assess(a, streams);
    TerminalWatch watch(streams);
    const bool writes = !a.out.empty() || !a.pdf.empty();
    std::optional<WorkPlan> plan;
    if (a.plan || writes) plan = plan_work(given, {a.budget, a.jobs}, watch);
    if (a.plan) {
        const Answer answer = work_plan_answer(*plan, given);
        put_answer(answer, "--out DIR", streams);
        write_assessment(a, given, answer, work_plan_page(*plan, given), "plan.json", streams);
        return exit_ok;
    }
    const Assessment assessment = assess(given, {a.budget, a.jobs}, watch);
    const Answer answer = assess_answer(assessment, given);
    put_answer(answer, "--out DIR", streams);
    if (writes) write_assessment(a, given, answer, assess_page(assessment, given, *plan), "assess.json", streams);
    return exit_code_of(assessment);
}

void assess_flags(CLI::App& sub, AssessArguments& a)
{
    add_run_inputs(sub, a.inputs);
    add_scale(sub, a.inputs);
    add_friction(sub, a.inputs);
    sub.add_option("--budget", a.budget, "seconds of wall time; what does not fit is left out and named")
        ->capture_default_str();
    sub.add_flag("--plan", a.plan, "nothing runs: models in order, premises, what is judged by what, what is left out, seconds");
    add_out(sub, a.out, OutputPath::folder, "folder for report.html, assess.json (plan.html, plan.json) and the resolved scene");
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

namespace {

/// What is known of an earthquake without its record. In the units of the flags.
struct RegressArguments {
    double yield_g = 0.0, pga_g = 0.0;
    std::optional<double> pgv_cm_s, arias_m_s, mean_period_s, magnitude, period_s, sa_13_g, sa_15_g, cycles;
    std::optional<double> allowable_mm; ///< then k(d*) of each
};

sliding::RegressionInputs inputs_of(const RegressArguments& a)
{
    sliding::RegressionInputs in;
    in.yield_coefficient = a.yield_g;
    in.pga_g = a.pga_g;
    in.arias_m_s = a.arias_m_s;
    in.pgv_cm_s = a.pgv_cm_s;
    in.mean_period_s = a.mean_period_s;
    in.magnitude = a.magnitude;
    in.period_s = a.period_s;
    const bool rigid = a.period_s.value_or(0.0) == 0.0;
    in.sa_13_g = a.sa_13_g ? a.sa_13_g : rigid ? std::optional(a.pga_g) : std::nullopt;
    in.sa_15_g = a.sa_15_g ? a.sa_15_g : rigid ? std::optional(a.pga_g) : std::nullopt;
    in.cycles = a.cycles;
    return in;
}

/// Slips by the regressions from given measures of the motion.
int regress(const RegressArguments& a, const Streams& streams)
{
    const sliding::RegressionInputs inputs = inputs_of(a);
    const std::vector<RegressionRow> rows = regression_rows("given measures", inputs);
    std::optional<Table> coefficients;
    if (a.allowable_mm) coefficients = pages::allowable_coefficient_table(inputs, *a.allowable_mm * units::mm);
    Answer answer(nlohmann::ordered_json{{"command", "regress"}, {"yield_g", a.yield_g}, {"pga_g", a.pga_g}});
    answer.add("regressions", pages::regression_table(rows), {.text = false});
    answer.add("summary", pages::regression_summary(rows), {.brief = true, .data = false});
    if (coefficients) answer.add("k_allowable", *coefficients, {.brief = true});
    const RegressionRow& weighted = rows.back();
    answer.headline_in_brief(weighted.median
                                 ? Headline{fmt::format("Weighted median {:.4g} mm ({}).", *weighted.median / units::mm,
                                                        weighted.remark)}
                                 : Headline{"No regression gives a slip: " + weighted.status + "."});
    put_answer(std::move(answer), "", streams);
    return rows.back().valid ? exit_ok : exit_no_answer;
}

void regress_flags(CLI::App& sub, RegressArguments& a)
{
    sub.add_option("--yield-g", a.yield_g, "yield acceleration a_y [g]")->required()->check(in_range(1e-6, 10));
    sub.add_option("--pga-g", a.pga_g, "largest horizontal ground acceleration [g]")
        ->required()
        ->check(in_range(1e-6, 10));
    const char* const group = "What more is known of the motion";
    const auto optional = [&](const char* flag, std::optional<double>& target, const char* words, double low,
                              double high) {
        sub.add_option(flag, target, words)->check(in_range(low, high))->group(group);
    };
    optional("--pgv-cm-s", a.pgv_cm_s, "largest ground velocity [cm/s]", 1e-6, 1e4);
    optional("--arias-m-s", a.arias_m_s, "Arias intensity [m/s]", 1e-9, 1e4);
    optional("--magnitude", a.magnitude, "moment magnitude", 2, 10);
    optional("--mean-period-s", a.mean_period_s, "mean period T_m of Rathje et al. (1998) [s]", 1e-3, 100);
    optional("--cycles", a.cycles, "equivalent sine cycles", 1e-3, 1e4);
    optional("--period-s", a.period_s, "fundamental period of the sliding mass [s]; 0: rigid", 0, 100);
    optional("--sa13-g", a.sa_13_g, "5 % spectral acceleration at 1.3 periods [g]", 1e-6, 100);
    optional("--sa15-g", a.sa_15_g, "5 % spectral acceleration at 1.5 periods [g]", 1e-6, 100);
    sub.add_option("--allowable-mm", a.allowable_mm, "then also the yield coefficient for this slip [mm]")
        ->check(in_range(1e-3, 1e6));
}

} // namespace

Command regress_command()
{
    return {"regress", "slip by the regressions from PGA, PGV, magnitude and the like, without a record",
            "damslip regress --yield-g 0.08 --pga-g 0.35 --pgv-cm-s 28 --magnitude 6.8 --allowable-mm 50",
            with_flags<RegressArguments>(regress_flags, regress)};
}

} // namespace damslip::cli
