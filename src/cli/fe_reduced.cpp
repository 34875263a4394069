#include "cli/fe_command.hpp"

#include "analysis/fe/contact_runs.hpp"
#include "cli/terminal/terminal_watch.hpp"
#include "pages/fe/reduced_report.hpp"
#include "pages/fe/rock_lines.hpp"

namespace damslip::cli {

using namespace pages;

int run_reduced(const FeArguments& arguments, const Ready& ready, const SpectrumLevel* spectrum, const Streams& streams)
{
    TerminalWatch watch(streams);
    ReducedRuns all(ready, fe_options(arguments), watch);
    const std::vector<ReducedRecord> runs = all.run([&](const ReducedRecord& run) {
        if (!arguments.out.empty()) write_reduced_history(arguments.out, ready.scene, run);
    });
    std::vector<std::string> messages = reduced_messages(ready.scene, runs);
    for (std::string& message : radiating_messages(ready.scene, all.full())) messages.push_back(std::move(message));
    const ReducedReportInput in{ready.scene,  ready.plan, ready.records(), all.full(), all.rigid(),
                                all.uplift(), runs,       messages};
    const FieldSeries no_fields(arguments.out, all.full().model()); // a reduced run keeps no shapes
    put_answer(
        reduced_answer(in), arguments, ready.scene, spectrum, no_fields, [&] { return reduced_page(in); }, streams);
    return runs.size() == all.whole() ? exit_code_of(as_contact_runs(runs)) : exit_no_answer;
}

} // namespace damslip::cli
