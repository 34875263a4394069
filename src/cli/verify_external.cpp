#include "cli/verify_command.hpp"
#include "core/file.hpp"
#include "core/input_error.hpp"
#include "core/status.hpp"
#include "core/stopwatch.hpp"
#include "pages/report/json_object.hpp"
#include "pages/report/table_text.hpp"
#include "pages/verify/evidence.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <ostream>

namespace damslip::cli {

using namespace pages;

int verify_external(const VerifyArguments& arguments, const Streams& streams)
{
    const std::vector<external::Source> sources = external::all_sources();
    const std::filesystem::path folder = arguments.filter;
    if (!folder.empty()) // named: what it is named for has to be there
        for (const external::Source& source : sources)
            if (!source.folder.empty() && !std::filesystem::exists(folder / source.folder))
                throw InputError(
                    Diagnostic{(folder / source.folder).string(), 0, 0, "there is no such file.",
                               "the results of " + source.id + " in the folder that is named",
                               "correct the name, or leave the folder out: the sources in the program are run"});
    std::vector<SourceOutcome> outcomes;
    std::size_t numbers = 0, within = 0, unexplained = 0;
    bool whole = true; ///< every source was run
    double seconds = 0.0;
    for (const external::Source& source : sources) {
        outcomes.push_back({&source, {}, 0.0});
        if (!source.folder.empty() && folder.empty()) {
            if (!streams.quiet)
                streams.talk << fmt::format("{}: not run; name the folder that holds {}\n", source.id, source.folder);
            whole = false;
            continue;
        }
        const Stopwatch start;
        outcomes.back().results = source.run(folder);
        outcomes.back().seconds = start.seconds();
        seconds += outcomes.back().seconds;
        for (const external::Result& r : outcomes.back().results) {
            ++numbers;
            within += r.within();
            unexplained += !r.within() && r.reason.empty();
        }
    }
    const std::string figure = evidence_figure(outcomes);
    if (!arguments.svg.empty() && !figure.empty()) write_file(arguments.svg, figure);
    if (arguments.markdown) {
        streams.out << evidence_markdown(outcomes,
                                         arguments.svg.empty() ? "" : "figures/" + arguments.svg.filename().string());
    } else if (streams.form == Form::json) {
        auto j = json_header("verify-external");
        j["numbers"] = numbers;
        j["within"] = within;
        j["without_reason"] = unexplained;
        j["seconds"] = seconds;
        j["groups"] = json_of(evidence_table(outcomes));
        j["outside"] = json_of(missed_table(outcomes));
        streams.out << j.dump(2) << "\n";
    } else {
        streams.out << text(evidence_table(outcomes));
        if (const Table outside = missed_table(outcomes); !outside.rows.empty()) streams.out << "\n" << text(outside);
        streams.out << fmt::format(
            "\n{} numbers of others, {} within their accuracy ({:.2f} %), {} outside without a reason, {:.1f} s\n",
            numbers, within, numbers ? 100.0 * static_cast<double>(within) / static_cast<double>(numbers) : 0.0,
            unexplained, seconds);
    }
    // Of all sources: coupled slips whose own steps do not settle lie outside. Of the few in the program alone a share says little.
    constexpr double least_share = 0.97;
    const bool enough = !whole || static_cast<double>(within) >= least_share * static_cast<double>(numbers);
    return enough && unexplained == 0 ? exit_ok : exit_no_answer;
}

} // namespace damslip::cli
