#include "analysis/spectrum/spectrum_level.hpp"
#include "cli/flags.hpp"
#include "cli/print_pdf.hpp"
#include "cli/spectrum_input.hpp"
#include "core/usage_error.hpp"
#include "pages/scene/report_provenance.hpp"
#include "pages/screen/screen_report.hpp"

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
    const std::vector<LevelSpectrum> spectra = given_spectra(arguments.spectrum);
    const Ready ready = prepare(given, Method::rigid_block, options);
    if (!streams.quiet)
        for (const std::string& warning : record_warnings(ready.records())) streams.talk << "note: " << warning << "\n";

    const std::shared_ptr<const SpectrumLevel> spectrum =
        spectrum_of_elements(arguments.spectrum, spectra, given, ready, streams);
    Screening s = run_screening(ready, arguments.jobs,
                                arguments.rocking ? RockingRuns::always : RockingRuns::where_sliding_does_not_hold);
    for (std::string& note : screen_notes(ready)) s.warnings.push_back(std::move(note));
    const ScreenReportInput in{
        ready.given, ready.scene, s, ready.records(), arguments.jobs, spectrum.get(), arguments.mean_polarity};
    streams.out << (streams.form == Form::json ? screen_json(in).dump(2) + "\n" : screen_text(in));
    if (!arguments.out.empty()) {
        write_screening(arguments.out, in);
        if (!streams.quiet)
            streams.talk << "written: " << (arguments.out / "summary.json").string() << ", displacements.csv, "
                         << (!given.wedge ? "equilibrium.csv, verdicts.csv, yield.csv, " : "")
                         << (has_rocking(s) ? "rocking_block.csv, " : "") << (s.flexible ? "flexible_block.csv, " : "")
                         << "scene.resolved.toml\nreport: " << (arguments.out / "report.html").string() << "\n";
    }
    if (!arguments.pdf.empty()) {
        print_pdf(screen_report(in), arguments.pdf);
        name_report(arguments.pdf, streams);
    }
    return statuses_of(s).exit_code();
}

void screen_flags(CLI::App& sub, ScreenArguments& a)
{
    add_run_inputs(sub, a.inputs);
    add_scale(sub, a.inputs);
    add_friction(sub, a.inputs);
    sub.add_option("--scheme", a.inputs.scheme, "of the rigid block: exact (default) or slammer");
    sub.add_flag("--rocking", a.rocking,
                 "the block that rocks and slides, too; without it where the sliding block does not hold");
    sub.add_flag("--mean-polarity", a.mean_polarity, "a table with the mean slip of both polarities of each record");
    add_response_spectrum(sub, a.spectrum);
    add_out(sub, a.out, OutputPath::folder, "folder for summary.json, tables (CSV) and the resolved scene");
    add_pdf(sub, a.pdf);
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

} // namespace damslip::cli
