#include "verification/pages/verify_tables.hpp"

#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace damslip::pages {

using hard::HardCase;
using hard::HardResult;
using verification::Case;
using verification::Check;
using verification::Measure;

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

Table check_table(const std::vector<CaseOutcome>& outcomes)
{
    struct Row {
        const Case& subject;
        const Check& check;
    };
    std::vector<Row> rows;
    for (const CaseOutcome& o : outcomes)
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

std::string markdown_of(const std::vector<CaseOutcome>& outcomes)
{
    std::string out = "# Verification\n\nWhat the program is held against: closed and published solutions. Made by "
                      "`damslip verify --markdown`; every case is also a test "
                      "and is run by `damslip verify`.\n";
    for (const CaseOutcome& o : outcomes) {
        out += fmt::format("\n## {}\n{}\n\nSource: {}\n\nTolerance: {}\n\n| quantity | unit | expected | tolerance "
                           "|\n| --- | --- | --- | --- |\n",
                           o.subject->id, o.subject->claim, o.subject->source, o.subject->tolerance);
        for (const Check& c : o.checks)
            out += fmt::format("| {} | {} | {:.7g} | {} |\n", c.quantity, c.unit, c.expected, tolerance_text(c));
    }
    return out;
}

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

std::string hard_markdown()
{
    std::string out = fmt::format(
        "\n# Hard cases\n\nScenes chosen to break the numerics, run by `damslip verify --hard` and as tests. Each "
        "gives one figure by two methods, or by one and its limit. Contact is solved to {:g} of N' in every step, and "
        "energy "
        "closes to {:g} of its largest term in every row of the history.\n\n| case | why it is hard | figure | method "
        "a "
        "| method b | tolerance | ends |\n| --- | --- | --- | --- | --- | --- | --- |\n",
        hard::largest_complementarity, hard::largest_energy_closure);
    for (const HardCase& c : hard::all_hard_cases())
        out += fmt::format("| {} | {} | {} [{}] | {} | {} | {} | {} |\n", c.id, c.why, c.quantity, c.unit, c.method_a,
                           c.method_b, c.tolerance, c.expected_status);
    return out;
}

Table second_solver_table(const std::vector<SecondResult>& results)
{
    const std::vector<ColumnOf<SecondResult>> columns{
        {{"quantity", "quantity"}, [](const SecondResult& r) { return r.what; }},
        {{"unit", "unit"}, [](const SecondResult& r) { return r.unit; }},
        {{"damslip", "damslip", "", 7}, [](const SecondResult& r) { return r.ours; }},
        {{"calculix", "CalculiX", "", 7}, [](const SecondResult& r) { return r.theirs; }},
        {{"difference", "difference", "–", 2}, [](const SecondResult& r) { return r.difference; }},
        {{"allowed", "allowed", "–", 2}, [](const SecondResult& r) { return r.allowed; }},
        {{"within", "within"}, [](const SecondResult& r) { return r.within(); }}};
    return table_of<SecondResult>("Beside CalculiX", columns, results);
}

} // namespace damslip::pages
