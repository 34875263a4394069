#include "pages/screen/given_tables.hpp"

#include "analysis/screen/regression_rows.hpp"
#include "core/units.hpp"

#include <fmt/format.h>

namespace damslip::pages {

namespace {

using units::standard_gravity;

Cell slip_or_none(const GivenYieldRow& row, double slip)
{
    return optional_cell(reported(row.status(), slip / units::mm));
}

struct CoefficientRow {
    std::string id, model;
    std::optional<double> coefficient;
};

} // namespace

Table given_yield_table(const GivenYieldBlock& block, const std::vector<GivenYieldRow>& rows)
{
    using R = GivenYieldRow;
    std::vector<ColumnOf<R>> columns{
        {{"yield_g", "a_y", "g", 5}, [](const R& r) { return r.yield / standard_gravity; }},
        {{"record", "record"}, &R::record},
        {{"method", "method"}, &R::method},
        {{"pga_g", "PGA", "g", 4}, [](const R& r) { return r.pga / standard_gravity; }},
        {{"yield_over_pga", "a_y/PGA", "–", 4},
         [](const R& r) { return r.pga > 0 ? finite_cell(r.yield / r.pga) : Cell(); }},
        {{"slip_mm", "slip", "mm", 5}, [](const R& r) { return slip_or_none(r, r.normal.max_slip); }},
        {{"slip_inverse_mm", "slip, record flipped", "mm", 5},
         [](const R& r) { return slip_or_none(r, r.inverse.max_slip); }},
        {{"slip_mean_mm", "mean of both", "mm", 5}, [](const R& r) { return slip_or_none(r, r.mean_slip()); }},
        {{"largest_acceleration_g", "largest acceleration", "g", 4},
         [](const R& r) { return r.largest_acceleration / standard_gravity; }},
        {{"status", "status"}, [](const R& r) { return word(r.status()); }}};
    if (block.flexible) {
        const auto period = [](const R& r) { return r.mode ? Cell(r.mode->period) : Cell(); };
        const auto damping = [](const R& r) { return r.mode ? Cell(100.0 * r.mode->damping_ratio) : Cell(); };
        columns.insert(columns.end() - 1,
                       {{{"period_s", "period", "s", 4}, period}, {{"damping_percent", "damping", "%", 4}, damping}});
    }
    Table table = table_of<R>("Slip on a given yield acceleration", columns, rows);
    table.notes.push_back(
        fmt::format("{}{}.", block.yield.size() > 1 ? "a_y: at rest, then as the table over the slip; " : "",
                    block.two_way ? "the block slides both ways, slip: the largest on the way" : "one way, downhill"));
    table.notes.push_back("horizontal component alone; the largest acceleration is the mass's own on average.");
    return table;
}

Table allowable_coefficient_table(const sliding::RegressionInputs& inputs, double allowable)
{
    std::vector<CoefficientRow> rows;
    for (const sliding::Regression& r : sliding::regressions())
        if (const std::optional<double> k = yield_coefficient_for(r, inputs, allowable))
            rows.push_back({std::string(r.id), std::string(r.name), k});
    using R = CoefficientRow;
    Table table =
        table_of<R>(fmt::format("Yield coefficient for a median slip of {:.4g} mm", allowable / units::mm),
                    {{{"id", "id"}, &R::id},
                     {{"model", "regression"}, &R::model},
                     {{"k_allowable", "k(d*)", "g", 4}, [](const R& r) { return optional_cell(r.coefficient); }},
                     {{"k_allowable_over_pga", "k(d*)/PGA", "–", 3},
                      [&](const R& r) { return optional_cell(r.coefficient, inputs.pga_g); }}},
                    rows);
    table.notes.push_back(
        "regressions whose inputs are given; those that slip less even at the smallest yield of their data "
        "are left out. Half of the slips are larger than the median.");
    return table;
}

} // namespace damslip::pages
