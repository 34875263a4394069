#include "pages/screen/screen_charts.hpp"

#include "analysis/screen/variation.hpp"
#include "core/statistics.hpp"
#include "core/units.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <numeric>

namespace damslip::pages {

namespace {

using units::mm;
constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t named_records = 6; ///< so many curves can be told apart

Axis slip_axis()
{
    return {"largest slip", "mm", Scale::asinh};
}

std::vector<std::vector<double>> in_mm(std::vector<std::vector<double>> slips)
{
    for (std::vector<double>& row : slips)
        for (double& slip : row) slip /= mm;
    return slips;
}

std::vector<double> column(const std::vector<std::vector<double>>& grid, std::size_t j)
{
    std::vector<double> out;
    for (const auto& row : grid) out.push_back(row[j]);
    return out;
}

/// A statistic of each row; none for a row that is not complete.
template <class Statistic>
std::vector<double> row_statistic(const std::vector<std::vector<double>>& grid, Statistic&& statistic)
{
    std::vector<double> out;
    for (const auto& row : grid) {
        const bool whole = std::all_of(row.begin(), row.end(), [](double v) { return std::isfinite(v); });
        out.push_back(whole ? statistic(row) : nothing);
    }
    return out;
}

void add_set_curves(Chart& chart, const std::vector<double>& x, const std::vector<std::vector<double>>& grid)
{
    const auto share = [](double q) { return [q](const std::vector<double>& row) { return percentile(row, q); }; };
    Curve median{"median, band 16 to 84 %",
                 x,
                 row_statistic(grid, share(0.5)),
                 row_statistic(grid, share(0.16)),
                 row_statistic(grid, share(0.84)),
                 Mark::line,
                 Weight::strong,
                 0};
    Curve largest{"largest",
                  x,
                  row_statistic(grid, [](const auto& row) { return *std::max_element(row.begin(), row.end()); }),
                  {},
                  {},
                  Mark::dashed,
                  Weight::normal,
                  1};
    chart.curves = {std::move(median), std::move(largest)};
}

/// For people [mm]; not a number where the slide has none.
double largest_slip(const sliding::SlideResult& slide)
{
    return reported(slide.status, slide.max_slip).value_or(nothing) / mm;
}

/// Of the flexible block, by the analysis that is judged.
Curve governing_by_record(const Screening& s)
{
    Curve curve{"flexible, judged", {}, {}, {}, {}, Mark::points, Weight::normal, 3};
    for (std::size_t i = 0; 2 * i + 1 < s.slips.size(); ++i) {
        curve.x.push_back(static_cast<double>(i));
        curve.y.push_back(largest_slip(worse_judged(s, i).judged()));
    }
    return curve;
}

} // namespace

std::optional<Chart> slip_over_friction(const Scene& scene, const Screening& s,
                                        const std::vector<GroundMotion>& motions, int jobs)
{
    const std::optional<SlipVariation> found = slips_by_friction(scene, s, motions, jobs);
    if (!found) return std::nullopt;
    const RigidModel& own = s.bases.front().model;
    const std::vector<double>& friction = found->friction;
    const auto grid = in_mm(found->slip);
    Chart chart;
    chart.title = "Slip over friction";
    chart.x = {scene.wedge ? "friction μ of " + scene.wedge->planes.front().name : "friction μ", "–"};
    chart.y = slip_axis();
    if (motions.size() <= named_records)
        for (std::size_t j = 0; j < motions.size(); ++j)
            chart.curves.push_back(
                {motions[j].name, friction, column(grid, j), {}, {}, Mark::line, Weight::normal, -1});
    else
        add_set_curves(chart, friction, grid);
    chart.vertical.push_back({own.block.friction, "scene"});
    if (own.critical_friction > 0.6 * own.block.friction && std::isfinite(own.critical_friction)) {
        chart.vertical.push_back({own.critical_friction, "holds without earthquake"});
        chart.x.low = std::min(0.98 * own.critical_friction, friction.front());
    }
    if (scene.criteria.allowable_slip && !s.flexible)
        chart.horizontal.push_back({*scene.criteria.allowable_slip / mm, "allowable"});
    chart.note = "Worse polarity of each record, with the vertical component where it has one. Linear near zero, "
                 "logarithmic above.";
    if (s.flexible) chart.note += " The rigid block; the flexible one is judged by its own slip.";
    if (scene.wedge) chart.note += " The friction of the other plane keeps its share of this one.";
    return chart;
}

Chart slip_by_record(const Screening& s, const std::optional<double>& allowable)
{
    Chart chart;
    chart.title = "Largest slip of each record";
    chart.x.label = "record";
    chart.y = slip_axis();
    Curve h{"horizontal", {}, {}, {}, {}, Mark::points, Weight::normal, 0};
    Curve hv{"with vertical", {}, {}, {}, {}, Mark::points, Weight::normal, 1};
    for (std::size_t i = 0; 2 * i + 1 < s.slips.size(); ++i) {
        chart.x.categories.push_back(s.slips[2 * i].record);
        h.x.push_back(static_cast<double>(i));
        h.y.push_back(largest_slip(worse_horizontal(s, i).horizontal));
        const SlipRow* row = worse_with_vertical(s, i);
        hv.x.push_back(static_cast<double>(i));
        hv.y.push_back(row ? largest_slip(*row->with_vertical) : nothing);
    }
    chart.curves.push_back(std::move(h));
    if (std::any_of(hv.y.begin(), hv.y.end(), [](double v) { return std::isfinite(v); }))
        chart.curves.push_back(std::move(hv));
    if (s.flexible) chart.curves.push_back(governing_by_record(s));
    if (allowable) chart.horizontal.push_back({*allowable / mm, "allowable"});
    chart.note = "Worse polarity of each record.";
    return chart;
}

Chart slip_over_ratio(const Screening& s)
{
    Chart chart;
    chart.title = "Slip over a_y/PGA";
    chart.x = {"a_y/PGA", "–"};
    chart.y = slip_axis();
    const double a_y = s.bases.front().model.downstream.law.constant;
    std::vector<std::size_t> order(s.slips.size() / 2);
    std::iota(order.begin(), order.end(), 0u);
    std::erase_if(order, [&](std::size_t i) { return !(s.slips[2 * i].pga > 0); });
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return s.slips[2 * a].pga > s.slips[2 * b].pga; });
    Curve h{"horizontal", {}, {}, {}, {}, Mark::points, Weight::normal, 0};
    Curve hv{"with vertical", {}, {}, {}, {}, Mark::points, Weight::normal, 1};
    for (const std::size_t i : order) {
        const double ratio = a_y / s.slips[2 * i].pga;
        h.x.push_back(ratio);
        h.y.push_back(largest_slip(worse_horizontal(s, i).horizontal));
        if (const SlipRow* row = worse_with_vertical(s, i)) {
            hv.x.push_back(ratio);
            hv.y.push_back(largest_slip(*row->with_vertical));
        }
    }
    if (a_y < 0) // the ratio falls with the PGA's fall: back into ascending order
        for (Curve* c : {&h, &hv}) {
            std::reverse(c->x.begin(), c->x.end());
            std::reverse(c->y.begin(), c->y.end());
        }
    chart.curves.push_back(std::move(h));
    if (!hv.x.empty()) chart.curves.push_back(std::move(hv));
    chart.note = "One point for each record, worse polarity.";
    return chart;
}

std::optional<Chart> regressions_beside(const Screening& s, std::size_t number)
{
    Chart chart;
    chart.title = "Regressions beside the rigid block";
    chart.x.label = "regression";
    chart.y = {"slip", "mm", Scale::asinh};
    Curve curve{"regression, 16 to 84 %", {}, {}, {}, {}, Mark::points, Weight::normal, 0};
    for (const RegressionRow& row : s.regressions) {
        if (row.record != s.slips[2 * number].record || !row.valid) continue;
        curve.x.push_back(static_cast<double>(chart.x.categories.size()));
        chart.x.categories.push_back(row.model);
        curve.y.push_back(row.median.value_or(nothing) / mm);
        curve.low.push_back(row.low.value_or(row.median.value_or(nothing)) / mm); // no published sigma: no band
        curve.high.push_back(row.high.value_or(row.median.value_or(nothing)) / mm);
    }
    if (std::none_of(curve.y.begin(), curve.y.end(), [](double v) { return v > 0; })) return std::nullopt;
    const auto add_line = [&chart](const sliding::SlideResult& slide, const char* name) {
        if (reported(slide.status, slide.max_slip)) chart.horizontal.push_back({largest_slip(slide), name});
    };
    add_line(worse_horizontal(s, number).horizontal, "rigid block, horizontal");
    if (const SlipRow* row = worse_with_vertical(s, number))
        add_line(*row->with_vertical, "rigid block, with vertical");
    const bool any_zero =
        std::any_of(curve.low.begin(), curve.low.end(), [](double v) { return v <= 0; }) ||
        std::any_of(chart.horizontal.begin(), chart.horizontal.end(), [](const Line& line) { return line.at <= 0; });
    if (!any_zero) chart.y.scale = Scale::log;
    chart.curves.push_back(std::move(curve));
    chart.note = "Regressions take the horizontal component only; no point where a_y, record or magnitude lie outside "
                 "their data.";
    return chart;
}

} // namespace damslip::pages
