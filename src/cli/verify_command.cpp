#include "cli/verify_command.hpp"

#include "cli/select_cases.hpp"
#include "cli/terminal/progress.hpp"
#include "core/stopwatch.hpp"
#include "pages/report/json_object.hpp"
#include "pages/report/table_text.hpp"
#include "pages/verify/verify_tables.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <ostream>

namespace damslip::cli {

using namespace pages;

int verify(const VerifyArguments& arguments, const Streams& streams)
{
    if (arguments.external) return verify_external(arguments, streams);
    if (arguments.hard && !arguments.markdown) return verify_hard(arguments.filter, streams);
    const verification::Registry cases = verification::all_cases();
    const auto selected = select_cases(cases, arguments.filter, "verify");

    std::vector<CaseOutcome> outcomes;
    std::size_t checks = 0, failed = 0;
    double seconds = 0.0;
    {
        Progress progress(streams, "verify", static_cast<double>(selected.size()));
        for (const verification::Case* c : selected) {
            const Stopwatch start;
            outcomes.push_back({c, c->run(), 0.0});
            outcomes.back().seconds = start.seconds();
            seconds += outcomes.back().seconds;
            checks += outcomes.back().checks.size();
            for (const verification::Check& check : outcomes.back().checks) failed += check.passed() ? 0 : 1;
            progress.advance(1);
        }
    }
    if (arguments.markdown) {
        streams.out << markdown_of(outcomes) << hard_markdown();
    } else if (streams.form == Form::json) {
        auto j = json_header("verify");
        j["cases"] = outcomes.size();
        j["checks"] = checks;
        j["failed"] = failed;
        j["seconds"] = seconds;
        j["results"] = json_of(check_table(outcomes));
        streams.out << j.dump(2) << "\n";
    } else {
        streams.out << pages::text(check_table(outcomes))
                    << fmt::format("{} cases, {} checks, {} failed, {:.2f} s\n", outcomes.size(), checks, failed,
                                   seconds);
    }
    return failed == 0 ? exit_ok : exit_no_answer;
}

} // namespace damslip::cli
