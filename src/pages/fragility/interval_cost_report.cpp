#include "pages/fragility/interval_cost_report.hpp"

#include "pages/report/json_object.hpp"
#include "pages/report/table_text.hpp"
#include "pages/scene/report_provenance.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace damslip::pages {

namespace {

/// "P(slip > 50 mm) at PGA = 0.15 g by fe"
std::string what_is_estimated(const IntervalCostView& view)
{
    return fmt::format("P({}) at {} = {:.4g} {} by {}", view.cost.limit.text, view.measure, view.cost.level / view.unit,
                       view.unit_text, view.cost.method);
}

/// The estimator with the largest gain over plain Monte Carlo in its longest run.
std::string answer_on_cost(const IntervalCostView& view)
{
    std::vector<const IntervalPoint*> longest; // of each estimator
    for (const IntervalPoint& p : view.cost.points) {
        if (!p.done()) continue;
        if (longest.empty() || longest.back()->estimator != p.estimator)
            longest.push_back(&p);
        else
            longest.back() = &p;
    }
    std::string sentence = what_is_estimated(view);
    if (longest.empty()) return sentence + ": no estimate within the budget";
    const IntervalPoint* best = longest.front();
    for (const IntervalPoint* p : longest)
        if (p->gain.value_or(1.0) > best->gain.value_or(1.0)) best = p;
    sentence += fmt::format(" is {:.3g}, 95 % {:.3g} to {:.3g} in {:.3g} s", best->p, best->interval.lower,
                            best->interval.upper, best->seconds);
    return sentence + (best->gain ? fmt::format(": {} does with 1/{:.2g} of the time of plain Monte Carlo",
                                                best->estimator, *best->gain)
                                  : ": nothing beats plain Monte Carlo here");
}

const char* const cost_note =
    "Half of the width of the 95 % interval of the draws over processor time. Plain Monte Carlo falls with the root of "
    "the time, a slope of -1/2; a line below it costs less for the same interval.";

} // namespace

Table interval_cost_table(const IntervalCostView& view)
{
    using P = IntervalPoint;
    const auto done = [](auto get) { return [=](const P& p) { return p.done() ? Cell(get(p)) : Cell(); }; };
    return table_of<P>(
        "What the interval costs",
        {{{"estimator", "estimator"}, &P::estimator},
         {{"runs", "runs"}, [](const P& p) { return count_cell(p.runs); }},
         {{"seconds", "processor time", "s", 3}, done([](const P& p) { return p.seconds; })},
         {{"probability", "P", "–"}, done([](const P& p) { return p.p; })},
         {{"lower", "2.5 %", "–", 3}, done([](const P& p) { return p.interval.lower; })},
         {{"upper", "97.5 %", "–", 3}, done([](const P& p) { return p.interval.upper; })},
         {{"half_width", "half-width", "–", 3}, done([](const P& p) { return p.interval.half_width(); })},
         {{"gain", "gain", "–", 3}, [](const P& p) { return optional_cell(p.gain); }},
         {{"remark", "remark"}, [](const P& p) { return p.done() ? Cell() : Cell(p.remark); }}},
        view.cost.points,
        {"gain: variance of plain Monte Carlo for the same processor time over that of the estimate. An interval from "
         "few "
         "replicates is itself uncertain: by 16 of them its width to a fifth.",
         "All variables are drawn anew for each run here; those that are not known (epistemic) have the same mean P "
         "so."});
}

nlohmann::ordered_json interval_cost_json(const IntervalCostView& view)
{
    nlohmann::ordered_json j = json_header("accuracy-probability", view.scene);
    j["method"] = view.cost.method;
    j["limit"] = view.cost.limit.text;
    j["intensity"] = view.measure;
    j["level"] = view.cost.level / view.unit;
    j["unit"] = view.unit_text;
    j["estimates"] = json_of(interval_cost_table(view));
    return j;
}

std::string interval_cost_text(const IntervalCostView& view)
{
    return text(interval_cost_table(view)) + "\n" + answer_on_cost(view) + "\n";
}

Chart interval_cost_chart(const std::vector<IntervalPoint>& points, CostAxis axis, const std::string& title,
                          const std::string& note)
{
    const bool timed = axis == CostAxis::seconds;
    Chart chart{title,
                {timed ? "processor time" : "runs", timed ? "s" : "", Scale::log},
                {"half-width", "–", Scale::log},
                {},
                {},
                {},
                {},
                "",
                note,
                380};
    for (const IntervalPoint& p : points) {
        const double price = timed ? p.seconds : static_cast<double>(p.runs);
        if (!p.done() || !(price > 0.0) || !(p.interval.half_width() > 0.0)) continue;
        if (chart.curves.empty() || chart.curves.back().name != p.estimator)
            chart.curves.push_back({p.estimator, {}, {}, {}, {}, Mark::line_and_points, Weight::normal, -1});
        chart.curves.back().x.push_back(price);
        chart.curves.back().y.push_back(p.interval.half_width());
    }
    for (Curve& curve : chart.curves) { // times are measured: more runs need not take longer
        std::vector<std::pair<double, double>> order;
        for (std::size_t i = 0; i < curve.x.size(); ++i) order.emplace_back(curve.x[i], curve.y[i]);
        std::sort(order.begin(), order.end());
        for (std::size_t i = 0; i < order.size(); ++i) curve.x[i] = order[i].first, curve.y[i] = order[i].second;
    }
    return chart;
}

Page interval_cost_page(const IntervalCostView& view)
{
    Page page = begin_page(view.scene, "What the accuracy of a probability costs. ");
    page.headline.sentence = answer_on_cost(view);
    page.key_figures = {
        {"Level", fmt::format("{} = {:.4g} {}", view.measure, view.cost.level / view.unit, view.unit_text)},
        {"Limit", view.cost.limit.text},
        {"Method", view.cost.method}};
    page.sections.push_back(
        {"Half-width over time",
         {interval_cost_chart(view.cost.points, CostAxis::seconds, what_is_estimated(view), cost_note),
          rows_part(interval_cost_table(view))},
         Fold::open});
    page.sections.push_back({"Scene", {scene_listing(view.scene)}, Fold::open});
    page.provenance = scene_provenance(view.scene);
    add_record_provenance(view.records, page.provenance);
    return page;
}

} // namespace damslip::pages
