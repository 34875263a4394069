#include "cli/fe_command.hpp"

#include "analysis/fe/tied_runs.hpp"
#include "analysis/prepare/rock_warnings.hpp"
#include "cli/terminal/terminal_watch.hpp"
#include "pages/fe/tied_report.hpp"
#include "pages/fe/water_notes.hpp"

#include <algorithm>

namespace damslip::cli {

using namespace pages;

int run_tied(const FeArguments& arguments, const Ready& ready, const SpectrumLevel* spectrum, const Streams& streams)
{
    TerminalWatch watch(streams);
    TiedRuns all(ready, fe_options(arguments), watch);
    const fe2d::Model& model = all.model();
    FieldSeries fields(arguments.out, model);
    for (const fe2d::StaticStage& s : all.statics().stages) fields.add(s.name, 0.0, s.displacement, s.elastic);
    std::vector<TiedRun> runs = all.run([&](TiedRun& r) {
        if (r.history.displacement.size())
            fields.add(r.record + ", end", r.history.rows.empty() ? 0.0 : r.history.rows.back().time,
                       r.history.displacement, r.history.displacement);
        if (!arguments.out.empty()) write_tied_history(arguments.out, ready.scene, r);
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
    const bool whole = runs.size() == ready.records().size() &&
                       std::all_of(runs.begin(), runs.end(),
                                   [](const TiedRun& r) { return r.history.status == fe2d::TiedRunStatus::complete; });
    return whole ? exit_ok : exit_no_answer;
}

} // namespace damslip::cli
