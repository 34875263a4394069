#include "analysis/accuracy/climb.hpp"

#include "core/processor_clock.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace damslip {

namespace {

double median(std::vector<double> values)
{
    std::sort(values.begin(), values.end());
    const std::size_t n = values.size();
    return 0.5 * (values[(n - 1) / 2] + values[n / 2]);
}

RungResult skipped(const Rung& rung, double expected, double left)
{
    RungResult result;
    result.rung = rung;
    result.outcome = RungOutcome::skipped;
    result.seconds = expected;
    result.remark = fmt::format("about {:.3g} s, {:.3g} s of the budget left", expected, std::max(0.0, left));
    return result;
}

} // namespace

RungResult run_repeatedly(const Rung& rung, int repeats, const ClimbCalls& calls)
{
    RungResult result = calls.run(rung);
    std::vector<double> seconds{result.seconds}, set_up{result.set_up_seconds};
    double spent = result.seconds;
    while (result.done() && static_cast<int>(seconds.size()) < repeats && spent + result.seconds < repeat_seconds) {
        const RungResult again = calls.run(rung);
        if (!again.done()) break; // interrupted: the first run counts
        seconds.push_back(again.seconds);
        set_up.push_back(again.set_up_seconds);
        spent += again.seconds;
    }
    result.repeats = static_cast<int>(seconds.size());
    result.seconds = median(seconds);
    result.set_up_seconds = median(set_up);
    return result;
}

std::vector<RungResult> climb(const LadderFacts& facts, const ClimbOptions& options, const ClimbCalls& calls)
{
    const ProcessorClock clock(ProcessorTimeOf::process);
    std::vector<RungResult> results;
    while (const std::optional<Rung> rung = next_rung(facts, options.ladder, results)) {
        if (calls.interrupted && calls.interrupted()) break;
        const double left = options.budget ? *options.budget - clock.seconds() : 0.0;
        const double least = calls.least_seconds ? calls.least_seconds(*rung) : 0.0;
        const double expected = std::max(least, expected_seconds(*rung, results).value_or(0.0));
        if (options.budget && expected >= left)
            results.push_back(skipped(*rung, expected, left));
        else {
            if (calls.begins) calls.begins(*rung);
            RungResult result = run_repeatedly(*rung, options.repeats, calls);
            if (result.outcome == RungOutcome::stopped) {
                if (!options.budget || (calls.interrupted && calls.interrupted())) break;
                result.outcome = RungOutcome::skipped;
                result.remark = fmt::format("ended after {:.3g} s, when the budget was spent", result.seconds);
            }
            results.push_back(std::move(result));
        }
        if (calls.ends) calls.ends(results);
    }
    return results;
}

} // namespace damslip
