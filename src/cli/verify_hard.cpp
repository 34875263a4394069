#include "cli/verify_command.hpp"

#include "cli/select_cases.hpp"
#include "cli/terminal/progress.hpp"
#include "core/stopwatch.hpp"
#include "pages/report/json_object.hpp"
#include "pages/report/table_text.hpp"
#include "verification/hard/hard_case.hpp"

#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <ostream>

namespace damslip::cli {

using namespace pages;

namespace {

using hard::HardCase;
using hard::HardResult;

struct HardOutcome {
    const HardCase* subject;
    HardResult result;
    double seconds = 0.0;
    bool passed() const { return hard::passed(*subject, result); }
};

Table hard_table(const std::vector<HardOutcome>& outcomes)
{
    using O = HardOutcome;
    const auto if_measured = [](std::optional<double> HardResult::*value) {
        return [=](const O& o) { return (o.result.*value).value_or(std::numeric_limits<double>::quiet_NaN()); };
    };
    return table_of<O>(
        "",
        {{{"case", "case"}, [](const O& o) { return o.subject->id; }},
         {{"quantity", "quantity"}, [](const O& o) { return o.subject->quantity; }},
         {{"unit", "unit"}, [](const O& o) { return o.subject->unit; }},
         {{"method_a", "method a"}, [](const O& o) { return o.subject->method_a; }},
         {{"value_a", "a", "", 7}, [](const O& o) { return o.result.value_a; }},
         {{"method_b", "method b"}, [](const O& o) { return o.subject->method_b; }},
         {{"value_b", "b", "", 7}, [](const O& o) { return o.result.value_b; }},
         {{"difference", "difference", "", 2},
          [](const O& o) { return std::abs(o.result.value_a - o.result.value_b); }},
         {{"tolerance", "tolerance", "", 2}, [](const O& o) { return o.result.tolerance; }},
         {{"complementarity", "complementarity", "", 2}, if_measured(&HardResult::complementarity)},
         {{"energy_closure", "energy", "", 2}, if_measured(&HardResult::energy_closure)},
         {{"status", "status"}, [](const O& o) { return o.result.status; }},
         {{"seconds", "s", "", 2}, &O::seconds},
         {{"passed", ""}, [](const O& o) { return o.passed() ? "pass" : "FAIL"; }}},
        outcomes,
        {fmt::format("complementarity: largest residual of contact and Coulomb's law over N', at most {:g}; energy: "
                     "largest imbalance over the largest energy, at most {:g}.",
                     hard::largest_complementarity, hard::largest_energy_closure)});
}

} // namespace

int verify_hard(const std::string& filter, const Streams& streams)
{
    const hard::HardCases cases = hard::all_hard_cases();
    const auto selected = select_cases(cases, filter, "verify --hard");
    std::vector<HardOutcome> outcomes;
    double seconds = 0.0;
    std::size_t failed = 0;
    {
        Progress progress(streams, "verify --hard", static_cast<double>(selected.size()));
        for (const HardCase* c : selected) {
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

std::string hard_markdown()
{
    std::string out = fmt::format(
        "\n# Hard cases\n\nScenes chosen to break the numerics, run by `damslip verify --hard` and as tests. Each "
        "gives "
        "one figure by two methods, or by one and its limit. Contact is solved to {:g} of N' in every step, and energy "
        "closes to {:g} of its largest term in every row of the history.\n\n| case | why it is hard | figure | method "
        "a "
        "| method b | tolerance | ends |\n| --- | --- | --- | --- | --- | --- | --- |\n",
        hard::largest_complementarity, hard::largest_energy_closure);
    for (const HardCase& c : hard::all_hard_cases())
        out += fmt::format("| {} | {} | {} [{}] | {} | {} | {} | {} |\n", c.id, c.why, c.quantity, c.unit, c.method_a,
                           c.method_b, c.tolerance, c.expected_status);
    return out;
}

} // namespace damslip::cli
