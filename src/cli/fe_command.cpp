#include "cli/fe_command.hpp"

#include "analysis/spectrum/spectrum_level.hpp"
#include "cli/print_pdf.hpp"
#include "core/usage_error.hpp"
#include "pages/report/page_html.hpp"
#include "pages/spectrum/spectrum_tables.hpp"

#include <fmt/format.h>
#include <ostream>

namespace damslip::cli {

using namespace pages;

FeOptions fe_options(const FeArguments& arguments)
{
    return {arguments.polarity, arguments.mesh_error, arguments.reports(), arguments.frames.value_or(0),
            arguments.modes};
}

void put_answer(FeAnswer answer, const FeArguments& arguments, const Scene& scene, const SpectrumLevel* spectrum,
                const FieldSeries& fields, const std::function<Page()>& page, const Streams& streams)
{
    if (spectrum) {
        answer.json["response_spectrum"] = spectrum_json(*spectrum);
        answer.text += "\n" + spectrum_text(*spectrum);
    }
    streams.out << (streams.form == Form::json ? answer.json.dump(2) + "\n" : answer.text);
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
    if (!streams.quiet) streams.talk << "report: " << arguments.pdf.string() << "\n";
}

int fe(const FeArguments& arguments, const Streams& streams)
{
    const Scene given = read_run_scene(arguments.inputs, streams);
    need_section(given, "damslip fe", "damslip screen SCENE gives the slip of the wedge");
    if ((arguments.reduced || arguments.base == "tied") && !(arguments.state_in.empty() && arguments.state_out.empty()))
        refuse_usage(arguments.reduced ? "--state-in or --state-out with --reduced."
                                       : "--state-in or --state-out with --base tied.",
                     "the state of joints that slide and open, of a full run", "leave one of them out");
    if (arguments.frames && arguments.base == "tied")
        refuse_usage("--frames with --base tied.", "a time series of a dam that slides and opens",
                     "leave one of them out");
    const std::vector<LevelSpectrum> spectra = given_spectra(arguments.spectrum);
    const Ready ready = prepare(given, Method::finite_elements, {.reduced = arguments.reduced, .stop = streams.stop});
    if (arguments.reduced || arguments.base != "tied") say_base(ready.scene, streams);
    if (!streams.quiet && ready.reservoir) streams.talk << ready.reservoir->reason << "\n";
    if (!streams.quiet && ready.dam_period)
        streams.talk << fmt::format("added mass for the dam's own period {:.5g} s\n", 1 / ready.dam_period->frequency);
    const std::shared_ptr<const SpectrumLevel> found = find_spectrum_level(arguments.spectrum, spectra, ready);
    if (arguments.reduced) return run_reduced(arguments, ready, found.get(), streams);
    return arguments.base == "tied" ? run_tied(arguments, ready, found.get(), streams)
                                    : run_contact(arguments, ready, found.get(), streams);
}

} // namespace damslip::cli
