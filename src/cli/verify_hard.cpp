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

int verify_hard(const std::string& filter, const Streams& streams)
{
    const hard::HardCases cases = hard::all_hard_cases();
    const auto selected = select_cases(cases, filter, "verify --hard");
    std::vector<HardOutcome> outcomes;
    double seconds = 0.0;
    std::size_t failed = 0;
    {
        Progress progress(streams, "verify --hard", static_cast<double>(selected.size()));
        for (const hard::HardCase* c : selected) {
            const Stopwatch start;
            outcomes.push_back({c, c->run(), 0.0});
            outcomes.back().seconds = start.seconds();
            seconds += outcomes.back().seconds;
            failed += outcomes.back().passed() ? 0 : 1;
            progress.advance(1);
        }
    }
    if (streams.form == Form::json) {
        auto j = json_header("verify-hard");
        j["cases"] = outcomes.size();
        j["failed"] = failed;
        j["seconds"] = seconds;
        j["results"] = json_of(hard_table(outcomes));
        streams.out << j.dump(2) << "\n";
    } else {
        streams.out << pages::text(hard_table(outcomes))
                    << fmt::format("{} hard cases, {} failed, {:.2f} s\n", outcomes.size(), failed, seconds);
    }
    return failed == 0 ? exit_ok : exit_no_answer;
}

} // namespace damslip::cli
