#include "cli/verify_command.hpp"

#include "cli/select_cases.hpp"
#include "cli/terminal/progress.hpp"
#include "core/stopwatch.hpp"
#include "pages/report/json_object.hpp"
#include "pages/report/table_text.hpp"
#include "verification/cases/registry.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <ostream>

namespace damslip::cli {

using namespace pages;

namespace {

using verification::Case;
using verification::Check;
using verification::Measure;

struct Outcome {
    const Case* subject;
    std::vector<Check> checks;
    double seconds = 0.0;
};

std::string tolerance_text(const Check& check)
{
    switch (check.measure) {
    case Measure::relative:
        return fmt::format("{:.2g} rel", check.tolerance);
    case Measure::absolute:
        return fmt::format("{:.2g} abs", check.tolerance);
    case Measure::upper_bound:
        return "at most";
    case Measure::lower_bound:
        return "at least";
    }
    return "";
}

Table check_table(const std::vector<Outcome>& outcomes)
{
    struct Row {
        const Case& subject;
        const Check& check;
    };
    std::vector<Row> rows;
    for (const Outcome& o : outcomes)
        for (const Check& c : o.checks) rows.push_back({*o.subject, c});
    return table_of<Row>("",
                         {{{"case", "case"}, [](const Row& r) { return r.subject.id; }},
                          {{"quantity", "quantity"}, [](const Row& r) { return r.check.quantity; }},
                          {{"unit", "unit"}, [](const Row& r) { return r.check.unit; }},
                          {{"expected", "expected", "", 7}, [](const Row& r) { return r.check.expected; }},
                          {{"computed", "computed", "", 7}, [](const Row& r) { return r.check.computed; }},
                          {{"error", "error", "", 2}, [](const Row& r) { return r.check.error(); }},
                          {{"tolerance", "tolerance", "", 2}, [](const Row& r) { return tolerance_text(r.check); }},
                          {{"passed", ""}, [](const Row& r) { return r.check.passed() ? "pass" : "FAIL"; }}},
                         rows);
}

/// The claims and tolerances, which do not depend on the machine, and the errors of this run.
std::string markdown_of(const std::vector<Outcome>& outcomes)
{
    std::string out = "# Verification\n\nWhat the program is held against: closed and published solutions. Made by "
                      "`damslip verify --markdown`; every case is also a test "
                      "and is run by `damslip verify`.\n";
    for (const Outcome& o : outcomes) {
        out += fmt::format("\n## {}\n{}\n\nSource: {}\n\nTolerance: {}\n\n| quantity | unit | expected | tolerance "
                           "|\n| --- | --- | --- | --- |\n",
                           o.subject->id, o.subject->claim, o.subject->source, o.subject->tolerance);
        for (const Check& c : o.checks)
            out += fmt::format("| {} | {} | {:.7g} | {} |\n", c.quantity, c.unit, c.expected, tolerance_text(c));
    }
    return out;
}

} // namespace

int verify(const VerifyArguments& arguments, const Streams& streams)
{
    if (arguments.hard && !arguments.markdown) return verify_hard(arguments.filter, streams);
    const verification::Registry cases = verification::all_cases();
    const auto selected = select_cases(cases, arguments.filter, "verify");

    std::vector<Outcome> outcomes;
    std::size_t checks = 0, failed = 0;
    double seconds = 0.0;
    {
        Progress progress(streams, "verify", static_cast<double>(selected.size()));
        for (const Case* c : selected) {
            const Stopwatch start;
            outcomes.push_back({c, c->run(), 0.0});
            outcomes.back().seconds = start.seconds();
            seconds += outcomes.back().seconds;
            checks += outcomes.back().checks.size();
            for (const Check& check : outcomes.back().checks) failed += check.passed() ? 0 : 1;
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
