#include "analysis/fe/contact_runs.hpp"
#include "analysis/fe/state_file.hpp"
#include "analysis/fe/tied_runs.hpp"
#include "analysis/fe/variants.hpp"
#include "analysis/prepare/ready.hpp"
#include "analysis/spectrum/spectrum_level.hpp"
#include "cli/command.hpp"
#include "cli/model_commands.hpp"
#include "cli/terminal/terminal.hpp"
#include "cli/verifier.hpp"
#include "core/input_error.hpp"
#include "pages/fe/fe_pages.hpp"
#include "pages/modes/modes_pages.hpp"
#include "pages/report/page.hpp"
#include "pages/sheet/workbook.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <ostream>

namespace damslip::cli {

using namespace pages;

namespace {

struct FeArguments {
    RunInputs inputs;
    std::string base =
        "contact";               ///< "contact": the dam slides, opens and rocks on its base; "tied": it is bonded to it
    bool reduced = false;        ///< on few modes of the dam, with an error estimate; contact base only
    std::optional<int> frames;   ///< of a series for ParaView, by record, >= 2; none: no series
    std::optional<int> modes;    ///< elastic modes kept by a reduced run, 1 ... 1000; none: its own choice
    std::filesystem::path out;   ///< folder for summary.json, history_*.csv, fields; empty: none
    std::filesystem::path pdf;   ///< the report on paper; empty: none
    std::filesystem::path sheet; ///< forces on the base at the worst instant of each run, a workbook; empty: none
    std::optional<int> polarity; ///< -1 flips the horizontal component; none: the scene's, else both are run
    bool spread = false;         ///< run the other rock and the other water, too, on the worst record
    std::filesystem::path state_in, state_out; ///< files of the joints' state; empty: none
    SpectrumArguments spectrum;                ///< peaks by the modes, too
    int jobs = 0;                              ///< threads; 0: all cores
    bool mesh_error = true; ///< one more run on elements of twice the size tells what the mesh leaves open

    bool reports() const { return !out.empty() || !pdf.empty(); }
};

FeOptions fe_options(const FeArguments& arguments)
{
    return {.polarity = arguments.polarity,
            .mesh_error = arguments.mesh_error,
            .pair_histories = arguments.reports() || !arguments.sheet.empty(),
            .frames = arguments.frames.value_or(0),
            .reduced = arguments.reduced,
            .modes = arguments.modes,
            .jobs = arguments.jobs};
}

/// The answer on standard output, and in the folder, if there is one, beside what the runs left there; the report on paper, if asked
/// for. The response spectrum's tables and section stand at the end.
/// @param spectrum  null: not asked for @param page  made where a report is wanted
void put_answer(Answer answer, const FeArguments& arguments, const Scene& scene, const SpectrumLevel* spectrum,
                const FieldSeries& fields, const std::function<Page()>& page, const Streams& streams)
{
    if (spectrum) {
        answer.set("response_spectrum", spectrum_json(*spectrum));
        answer += "\n" + spectrum_text(*spectrum);
        answer.point("response spectrum", spectrum_sentence(*spectrum));
    }
    put_answer(answer, "--out DIR", streams);
    if (!arguments.reports()) return;
    Page report = page();
    if (spectrum) report.sections.push_back(spectrum_section(*spectrum));
    if (!arguments.out.empty()) {
        write_fe_files(arguments.out, scene, answer, fields, report);
        if (!streams.quiet)
            streams.talk << "written: " << (arguments.out / "summary.json").string()
                         << ", tables of each record (*.csv), fields.pvd, scene.resolved.toml\n"
                         << "report: " << (arguments.out / "report.html").string() << "\n";
    }
    if (arguments.pdf.empty()) return;
    print_pdf(page_html(report), arguments.pdf);
    name_report(arguments.pdf, streams);
}

/// @throws UsageError, InputError
FeOptions options_with_state(const FeArguments& arguments, const Ready& ready)
{
    FeOptions options = fe_options(arguments);
    if (!arguments.state_out.empty()) {
        check_state_file(ready.scene, "--state-out");
        if (ready.records().size() != 1 || polarities_of(ready.scene, options.polarity).size() != 1)
            refuse_usage("--state-out with several runs.", "one record, or one sequence, of one polarity",
                         "add  --polarity 1 , and one  --record FILE  where the scene has several");
    }
    if (arguments.state_in.empty()) return options;
    check_state_file(ready.scene, "--state-in");
    options.start = read_state(arguments.state_in, ready.given);
    return options;
}

/// `fe`: the dam slides, opens and rocks on its base. Static stages, earthquake with exact Coulomb contact, run-out, static state after
/// it; the rigid block's slip beside it. On few modes of the dam (--reduced) with an estimate of what the reduction changes.
int run_contact(const FeArguments& arguments, const Ready& prepared, const SpectrumLevel* spectrum, const Streams& streams)
{
    TerminalWatch watch(streams);
    ContactRuns all(prepared, options_with_state(arguments, prepared), watch);
    const Ready& ready = all.ready();
    const fe2d::EarthquakeRun& model = all.model();
    const FeReport::Input shared{ready.scene, ready.plan, ready.records(), model, all.rigid(), all.uplift(),
                                 all.combinations(), arguments.reduced, all.traced()};
    FieldSeries fields(arguments.out, model.model());
    std::optional<FeReport> page;
    if (arguments.reports()) page.emplace(shared);
    ModelNotes of_model(ready.scene, model);
    for (const std::string& note : bond_messages(ready.scene, model.model().mesh)) streams.remark(note);
    std::vector<BaseInstant> instants;
    const std::vector<ContactRun> runs = all.run([&](ContactRun& r, const GroundMotion& motion) {
        of_model.add(r.record, motion);
        if (!arguments.sheet.empty() && !r.fe.history.time.empty())
            instants.push_back(worst_instant(r, base_strength(ready.scene)));
        keep_contact_run(arguments.out, shared, r, fields);
        if (page) page->add(r, motion);
        if (const std::string series = write_frames(arguments.out, shared, r); !series.empty() && !streams.quiet)
            streams.talk << "for ParaView: " << (arguments.out / series).string() << "\n";
        r.fe.history.by_pair = {};
        r.fe.history.frames = {};
        r.fe.history.states = {};
    });
    if (!arguments.state_out.empty() && !runs.empty() && has_slip(runs.front()))
        write_state(arguments.state_out, ready.given, runs.front().fe.state, runs.front().label());
    const std::string spread = spread_line(model_spread(ready, runs, arguments.spread, watch), runs);
    const std::vector<std::string> messages = contact_messages(ready.scene, runs, of_model.lines());
    put_answer(
        contact_answer(shared, runs, messages, spread), arguments, ready.scene, spectrum, fields,
        [&] { return page->page(runs, messages, spread); }, streams);
    if (!instants.empty()) {
        write_sheet(arguments.sheet, [&](const auto& file) { write_base_sheets(file, base_strength(ready.scene), instants); });
        name_report(arguments.sheet, streams);
    } else if (!arguments.sheet.empty()) {
        streams.remark("note: no workbook is written, for no run came to its earthquake");
    }
    return runs.size() == all.whole() ? exit_code_of(runs) : exit_no_answer;
}

/// `fe --base tied`: static stages and the linear earthquake run of a dam bonded to its base.
int run_tied(const FeArguments& arguments, const Ready& ready, const SpectrumLevel* spectrum, const Streams& streams)
{
    TerminalWatch watch(streams);
    TiedRuns all(ready, fe_options(arguments), watch);
    const fe2d::Model& model = all.model();
    FieldSeries fields(arguments.out, model);
    for (const fe2d::StaticStage& s : all.statics().stages) fields.add(s.name, 0.0, s.displacement, s.elastic);
    std::vector<TiedRun> runs = all.run([&](TiedRun& r) {
        if (r.history.displacement.size())
            fields.add(r.label() + ", end", r.history.rows.empty() ? 0.0 : r.history.rows.back().time,
                       r.history.displacement, r.history.displacement);
        if (!arguments.out.empty()) write_tied_history(arguments.out, ready.scene, ready.plan.scene_hash, r);
    });
    for (TiedRun& r : runs) {
        if (all.water()) {
            r.notes.push_back(water_counts(*all.water()));
            for (std::string& warning : reservoir_warnings(ready.scene, 20.0)) r.notes.push_back(std::move(warning));
        }
        for (std::string& warning : rock_warnings(ready.scene, model.mesh, r.motion))
            r.notes.push_back(std::move(warning));
    }
    const FePageFrame frame = tied_frame(ready.scene, ready.plan, ready.records(), model, all.water());
    put_answer(
        tied_answer(frame, all.statics(), runs), arguments, ready.scene, spectrum, fields,
        [&] { return tied_page(frame, all.statics(), runs); }, streams);
    const bool whole = runs.size() == all.whole() &&
                       std::all_of(runs.begin(), runs.end(),
                                   [](const TiedRun& r) { return r.history.status == fe2d::TiedRunStatus::complete; });
    return whole ? exit_ok : exit_no_answer;
}

/// Staged finite-element run of every record of the scene, both polarities beside each other. @returns exit_no_answer when a run did not end properly; what was
/// computed is written all the same.
int fe(const FeArguments& arguments, const Streams& streams)
{
    const Scene given = read_run_scene(arguments.inputs, streams);
    need_section(given, "damslip fe", "damslip screen SCENE gives the slip of the wedge");
    const bool tied = arguments.base == "tied";
    const char* const simpler = arguments.reduced ? "--reduced" : tied ? "--base tied" : nullptr;
    const auto refuse_with = [](const char* flag, const char* other, const char* expected) {
        refuse_usage(fmt::format("{} with {}.", flag, other), expected, "leave one of them out");
    };
    if (simpler && !(arguments.state_in.empty() && arguments.state_out.empty()))
        refuse_with("--state-in or --state-out", simpler, "the state of joints that slide and open, of a full run");
    if (!given.planes.slides_on.empty() && (simpler || arguments.spectrum.wanted))
        refuse_with("--plane", simpler ? simpler : "--response-spectrum", "a seam in a full run");
    if (!arguments.sheet.empty() && tied) refuse_with("--sheet", simpler, "a dam that slides on its base");
    if (arguments.frames && tied) refuse_with("--frames", simpler, "a time series of a dam that slides and opens");
    const std::vector<LevelSpectrum> spectra = given_spectra(arguments.spectrum);
    const Ready ready = prepare(given, Method::finite_elements, {.joints_of_lifts = !arguments.reduced, .stop = streams.stop});
    if (arguments.reduced || !tied) say_base(ready.scene, streams);
    if (ready.reservoir) streams.remark(ready.reservoir->reason);
    if (ready.dam_period)
        streams.remark(fmt::format("added mass for the dam's own period {:.4g} s", 1 / ready.dam_period->frequency));
    const std::shared_ptr<const SpectrumLevel> found = find_spectrum_level(arguments.spectrum, spectra, ready);
    return (tied ? run_tied : run_contact)(arguments, ready, found.get(), streams);
}

void fe_flags(CLI::App& sub, FeArguments& a)
{
    add_run_inputs(sub, a.inputs);
    add_scale(sub, a.inputs);
    sub.add_option(
           "--polarity", a.polarity,
           "run 1 or -1 alone, the sign on the horizontal component as filed (default: both, or motion.polarity of the "
           "scene)")
        ->check(CLI::IsMember({1, -1}))
        ->group("Ground motion");
    add_friction(sub, a.inputs);
    add_rock(sub, a.inputs);
    add_plane(sub, a.inputs);
    sub.add_option("--base", a.base, "contact: the dam slides, opens and rocks; tied: it is bonded to its base")
        ->check(CLI::IsMember({"contact", "tied"}))
        ->capture_default_str();
    sub.add_flag("!--no-mesh-error", a.mesh_error,
                 "leave out the run on elements of twice the size that tells what the mesh leaves open of the slip");
    sub.add_flag(
        "--spread", a.spread,
        "run the worst record on massless rock (or radiating, where the scene's has no mass) and with added mass in "
        "place of acoustic water, too: how far the models lie apart");
    sub.add_option("--state-out", a.state_out,
                   "file for the state of the joints after the earthquake, of one record and polarity")
        ->check(output_to(OutputPath::file, "--state-out"))
        ->group("State of the joints");
    sub.add_option("--state-in", a.state_in,
                   "go on from that file: the same dam as another earthquake has left it; the slip counts from there")
        ->group("State of the joints");
    CLI::Option* reduced =
        sub.add_flag("--reduced", a.reduced, "earthquake on few modes of the dam; slip with an error estimate")
            ->group("Reduced run");
    sub.add_option("--modes", a.modes, "elastic modes kept (12)")
        ->check(CLI::Range(1, 1000))
        ->needs(reduced)
        ->group("Reduced run");
    reduced->excludes(sub.get_option("--base"));
    CLI::Option* out = add_out(sub, a.out, OutputPath::folder,
                               "folder for summary.json, histories (CSV), fields (VTU) and the resolved scene");
    sub.add_option("--frames", a.frames,
                   "so many instants of each record as a time series for ParaView: frames_*.pvd in the folder of --out")
        ->check(CLI::Range(2, 10000))
        ->needs(out)
        ->excludes(reduced);
    add_response_spectrum(sub, a.spectrum);
    add_pdf(sub, a.pdf);
    add_sheet(sub, a.sheet, "workbook (.xlsx, .ods) of the forces on the base where each run is nearest to sliding");
    add_jobs(sub, a.jobs, "threads, for both polarities side by side; 0: all cores");
}

} // namespace

Command fe_command()
{
    return {"fe", "staged finite-element run: gravity, impounding, uplift, earthquake",
            "damslip fe examples/reference_dam.toml --out results/fe", with_flags<FeArguments>(fe_flags, fe)};
}

} // namespace damslip::cli
