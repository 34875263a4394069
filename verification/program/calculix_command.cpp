#include "verification/program/carry.hpp"

#include "cli/command.hpp"
#include "core/file.hpp"
#include "core/input_error.hpp"
#include "pages/report/table_text.hpp"
#include "pages/scene/scene_pages.hpp"
#include "verification/pages/verify_tables.hpp"
#include "verification/second_solver/second_solver.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <ostream>

namespace damslip::cli {

using namespace pages;

int calculix(const MeshArguments& arguments, const Streams& streams)
{
    if (arguments.out.empty() && arguments.results.empty())
        throw UsageError(Diagnostic{"", 0, 0, "--to calculix without --out and without --results.",
                                    "the deck to write, or the results to compare",
                                    "add  --out FILE.inp , or  --results FILE.dat"});
    const SecondAnalysis analysis = arguments.analysis == "tied"             ? SecondAnalysis::tied
                                    : arguments.analysis == "static-contact" ? SecondAnalysis::static_contact
                                                                             : SecondAnalysis::modes;
    const Scene given = read_run_scene(arguments.inputs, streams);
    need_section(given, "damslip mesh", "a wedge is rigid; damslip screen SCENE gives its slip");
    const Ready ready = prepare(given, Method::finite_elements, {.stop = streams.stop});
    Watch watch;
    if (!arguments.out.empty()) {
        write_file(arguments.out, calculix_deck(ready, analysis, arguments.modes, watch));
        if (arguments.results.empty()) put_json_document(streams, "mesh", {{"out", arguments.out.string()}});
        streams.talk << fmt::format("written: {} (CalculiX, {})\n", arguments.out.string(), arguments.analysis);
    }
    if (arguments.results.empty()) return exit_ok;
    const std::vector<SecondResult> results = beside_calculix(
        ready, analysis, arguments.modes, read_file(arguments.results), arguments.results.string(), watch);
    const Table table = second_solver_table(results);
    if (streams.form == Form::json) {
        auto j = json_header("mesh", given);
        j["second_solver"] = json_of(table);
        streams.out << j.dump(2) << "\n";
    } else {
        streams.out << given.title << "\n\n" << text(table);
    }
    const bool all = std::all_of(results.begin(), results.end(), [](const SecondResult& r) { return r.within(); });
    return all ? exit_ok : exit_no_answer;
}

} // namespace damslip::cli
