#include "cli/fe_command.hpp"

#include "analysis/fe/contact_runs.hpp"
#include "analysis/fe/model_spread.hpp"
#include "analysis/fe/state_file.hpp"
#include "cli/terminal/terminal_watch.hpp"
#include "core/usage_error.hpp"
#include "pages/fe/fe_report.hpp"
#include "pages/fe/frame_files.hpp"
#include "pages/fe/rock_lines.hpp"

#include <optional>

namespace damslip::cli {

using namespace pages;

namespace {

/// @throws UsageError, InputError
FeOptions options_with_state(const FeArguments& arguments, const Ready& ready)
{
    FeOptions options = fe_options(arguments);
    if (!arguments.state_out.empty()) {
        check_state_file(ready.scene, "--state-out");
        if (ready.records().size() != 1 || polarities_of(options, ready.scene).size() != 1)
            refuse_usage("--state-out with several runs.", "one record, or one sequence, of one polarity",
                         "add  --polarity 1 , and one  --record FILE  where the scene has several");
    }
    if (arguments.state_in.empty()) return options;
    check_state_file(ready.scene, "--state-in");
    options.start = read_state(arguments.state_in, ready.given);
    return options;
}

} // namespace

int run_contact(const FeArguments& arguments, const Ready& ready, const SpectrumLevel* spectrum, const Streams& streams)
{
    TerminalWatch watch(streams);
    ContactRuns all(ready, options_with_state(arguments, ready), watch);
    const fe2d::EarthquakeRun& model = all.model();
    const FeReport::Input shared{ready.scene, ready.plan, ready.records(), model, all.rigid(), all.uplift()};
    FieldSeries fields(arguments.out, model.model());
    std::optional<FeReport> page;
    if (arguments.reports()) page.emplace(shared);
    ModelNotes of_model(ready.scene, model);
    const std::vector<ContactRun> runs = all.run([&](ContactRun& r, const GroundMotion& motion) {
        of_model.add(r.record, motion);
        keep_contact_run(arguments.out, shared, r, fields);
        if (page) page->add(r, motion);
        if (const std::string series = write_frames(arguments.out, {ready.scene, model, all.uplift()}, r);
            !series.empty() && !streams.quiet)
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
    return runs.size() == all.whole() ? exit_code_of(runs) : exit_no_answer;
}

} // namespace damslip::cli
