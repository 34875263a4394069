#include "pages/fragility/fragility_pages.hpp"

#include "analysis/fragility/capacity_roots.hpp"
#include "analysis/fragility/hazard_file.hpp"
#include "pages/report/answer.hpp"
#include "pages/report/table_text.hpp"
#include "pages/scene/scene_pages.hpp"
#include "probability/annual_rate.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <numeric>

namespace damslip::pages {

namespace {

std::string status_words(const FragilityView& view)
{
    std::string words;
    for (const auto& [status, n] : view.answer.estimate.statuses)
        words += fmt::format("{}{} {}", words.empty() ? "" : ", ", n, status);
    return words;
}

/// A table for each run of rows with the same first cell, which moves into its title; the notes stand below the last.
std::vector<Table> by_first_column(Table table)
{
    std::vector<Table> parts;
    const Cell* of = nullptr;
    for (std::vector<Cell>& row : table.rows) {
        if (!of || *of != row.front())
            parts.push_back({fmt::format("{}: {}", table.title, std::get<std::string>(row.front())),
                             {table.columns.begin() + 1, table.columns.end()},
                             {},
                             {}});
        of = &row.front();
        parts.back().rows.emplace_back(row.begin() + 1, row.end());
    }
    if (!parts.empty()) parts.back().notes = std::move(table.notes);
    return parts;
}

/// What is shown of P: of each limit a table of its levels, then the curves.
std::vector<Table> probability_tables(const FragilityView& view)
{
    std::vector<Table> tables = by_first_column(fragility_table(view, Readers::people));
    for (Table& table : by_first_column(band_table(view))) tables.push_back(std::move(table));
    for (Table& table : by_first_column(conditioned_table(view))) tables.push_back(std::move(table));
    tables.push_back(curve_table(view));
    return tables;
}

/// What P comes from.
std::vector<Table> cause_tables(const FragilityView& view)
{
    std::vector<Table> tables{cause_table(view)};
    for (Table& table : by_first_column(needed_yield_table(view))) tables.push_back(std::move(table));
    return tables;
}

std::vector<double> log_spaced(double from, double to)
{
    constexpr int n = 80;
    std::vector<double> x;
    for (int i = 0; i <= n; ++i) x.push_back(from * std::pow(to / from, static_cast<double>(i) / n));
    return x;
}

/// Room for whole marks at both ends.
Axis intensity_axis(const FragilityView& view)
{
    constexpr double room = 1.05;
    Axis x{view.plan.input.intensity.text, view.unit_text(), Scale::log};
    const std::vector<double>& levels = view.plan.input.intensity.levels;
    if (levels.empty()) return x;
    x.low = levels.front() / view.unit() / room;
    x.high = levels.back() / view.unit() * room;
    return x;
}

Chart curve_chart(const FragilityView& view)
{
    Chart chart{.title = "Fragility",
                .x = intensity_axis(view),
                .y = {.label = "probability", .unit = "–", .low = -0.03, .high = 1.03},
                .note = "Points: stripes with the 95 % interval of the draws.",
                .height = 380};
    int colour = 0;
    for (const LimitEstimate& limit : view.answer.estimate.limits) {
        const std::string& name = limit.limit.text;
        Curve stripes{.name = name, .mark = Mark::points, .colour = colour};
        Curve band{.name = name + ", 5 to 95 % of lack of knowledge",
                   .mark = Mark::dashed,
                   .weight = Weight::faint,
                   .colour = colour};
        for (const LevelEstimate& level : limit.levels) {
            const double x = level.x / view.unit();
            if (limit.cloud)
                stripes.add(x, level.p);
            else
                stripes.add(x, level.p, level.sampling.lower, level.sampling.upper);
            if (!level.bands) continue;
            const auto& percentiles = level.bands->percentiles;
            band.add(x, percentiles[2], percentiles.front(), percentiles.back());
        }
        if (limit.fit.method != probability::FitMethod::none && limit.levels.size() > 1) {
            const bool firth = limit.fit.method == probability::FitMethod::firth;
            Curve line{.name = name + (firth ? ", lognormal (Firth)" : ", lognormal"),
                       .mark = limit.fit.lognormal() ? Mark::line : Mark::dashed,
                       .weight = Weight::strong,
                       .colour = colour};
            for (const double x : log_spaced(limit.levels.front().x, limit.levels.back().x))
                line.add(x / view.unit(), limit.fit.curve.probability(x));
            chart.curves.push_back(std::move(line));
        }
        chart.curves.push_back(std::move(stripes));
        if (!band.x.empty()) chart.curves.push_back(std::move(band));
        ++colour;
    }
    return chart;
}

Chart rate_chart(const FragilityView& view)
{
    Chart chart{"Rate by intensity", intensity_axis(view), {"rate per part of ln x", "1/year", Scale::log}};
    for (const LimitEstimate& limit : view.answer.estimate.limits) {
        if (!limit.rate) continue;
        Curve curve{.name = limit.limit.text, .mark = Mark::line_and_points};
        for (const probability::RatePart& part : limit.rate->raw.parts) {
            if (!(part.x_lower > 0.0) || !(part.x_upper > part.x_lower)) continue;
            curve.add(std::sqrt(part.x_lower * part.x_upper) / view.unit(),
                      part.rate / std::log(part.x_upper / part.x_lower));
        }
        if (!curve.x.empty()) chart.curves.push_back(std::move(curve));
    }
    chart.note = "Which earthquakes the rate comes from: the area below a curve is its rate.";
    return chart;
}

enum class CostAxis { seconds, runs };

/// Half-width of the 95 % interval over processor time or over runs, both logarithmic, a line an estimator.
Chart interval_cost_chart(const std::vector<IntervalPoint>& points, CostAxis axis, const std::string& title,
                          const std::string& note)
{
    const bool timed = axis == CostAxis::seconds;
    Chart chart{.title = title,
                .x = {timed ? "processor time" : "runs", timed ? "s" : "", Scale::log},
                .y = {"half-width", "–", Scale::log},
                .note = note,
                .height = 380};
    for (const IntervalPoint& p : points) {
        const double price = timed ? p.seconds : static_cast<double>(p.runs);
        if (!p.done() || !(price > 0.0) || !(p.interval.half_width() > 0.0)) continue;
        if (chart.curves.empty() || chart.curves.back().name != p.estimator)
            chart.curves.push_back({.name = p.estimator, .mark = Mark::line_and_points});
        chart.curves.back().add(price, p.interval.half_width());
    }
    for (Curve& curve : chart.curves) { // times are measured: more runs need not take longer
        std::vector<std::pair<double, double>> order;
        for (std::size_t i = 0; i < curve.x.size(); ++i) order.emplace_back(curve.x[i], curve.y[i]);
        std::ranges::sort(order);
        for (std::size_t i = 0; i < order.size(); ++i) curve.x[i] = order[i].first, curve.y[i] = order[i].second;
    }
    return chart;
}

/// "9.17e-06 to 0.016 per year by earthquakes above 0.01 g". @pre limit.rate
std::string rates_per_year(const FragilityView& view, const LimitEstimate& limit)
{
    const probability::Interval bounds = limit.rate->bounds();
    const std::string from = fmt::format("{:.3g}", bounds.lower), to = fmt::format("{:.3g}", bounds.upper);
    const probability::AnnualRate& upper = limit.rate->raw_high;
    return (from == to ? from : from + " to " + to) + " per year" +
           (upper.all_events
                ? ""
                : fmt::format(" by earthquakes above {:.3g} {}", upper.x_first / view.unit(), view.unit_text()));
}

/// "the rigid block: no bound for an elastic dam", "finite elements": what the runs are of.
std::string method_words(const FragilityView& view)
{
    if (view.study.finite_elements()) return "finite elements";
    const bool dam = !view.study.scene.wedge && !view.study.scene.section.rock_slope;
    return std::string(view.study.method.kind == SweepKind::rocking ? "the rocking block" : "the rigid block") +
           (dam ? ": no bound for an elastic dam" : "");
}

/// "0.0021 to 0.37": the least and the largest at the levels.
std::string probabilities_of(const std::vector<LevelEstimate>& levels)
{
    const auto [least, most] = std::ranges::minmax(levels, {}, &LevelEstimate::p);
    return fmt::format("{:.3g} to {:.3g}", least.p, most.p);
}

/// "slip > 50 mm: P = 0.5 at PGA = 0.31 g; 1.1e-4 to 1.3e-4 per year"
std::string answer_sentence(const FragilityView& view, const LimitEstimate& limit)
{
    std::string sentence = limit.limit.text + ": ";
    const std::string apart = levels_apart_from_median(view, limit);
    if (limit.fit.method != probability::FitMethod::none && !limit.fit.lognormal())
        sentence += fmt::format("P = {} by the stripes, which are not lognormal", probabilities_of(limit.levels));
    else if (limit.fit.method != probability::FitMethod::none)
        sentence += fmt::format("P = 0.5 at {} = {:.3g} {}{}", view.plan.input.intensity.text,
                                limit.fit.curve.median / view.unit(), view.unit_text(),
                                apart.empty() ? "" : ", extrapolated from levels of " + apart);
    else if (limit.cloud && limit.cloud->found)
        sentence += "a cloud of unscaled records";
    else
        sentence += "no curve, " + (limit.cloud ? limit.cloud->why : limit.fit.why);
    if (limit.rate) sentence += "; " + rates_per_year(view, limit);
    return sentence;
}

/// Letters, digits, - and _ of a text.
std::string name_of_limit(const std::string& text)
{
    std::string name;
    for (const char c : text)
        if (std::isalnum(static_cast<unsigned char>(c)))
            name += c;
        else if (!name.empty() && name.back() != '-')
            name += '-';
    while (!name.empty() && name.back() == '-') name.pop_back();
    return name.empty() ? "limit" : name;
}

} // namespace

Answer fragility_answer(const FragilityView& view)
{
    Answer out(json_header("fragility", view.study.scene));
    const FragilityPlan& plan = view.plan;
    out.set("method", view.study.method.id);
    out.set("intensity", plan.input.intensity.text);
    out.set("unit", view.unit_text());
    out.set("runs", plan.samples.size());
    out.set("draws", plan.draws.size());
    out.set("replicates", plan.replicates);
    out.set("epistemic_draws", plan.epistemic ? plan.replicates * plan.outer : 0);
    out.set("events", view.answer.estimate.clusters);
    out.set("p_static", view.answer.estimate.p_static);
    out.set("statuses", view.answer.estimate.statuses);
    const auto for_people = [&out](const std::vector<Table>& tables, bool brief) {
        for (const Table& table : tables) out.add("", table, {.brief = brief, .data = false});
    };
    for_people(probability_tables(view), true);
    for_people(rate_tables(view), true);
    for_people(by_first_column(rate_part_table(view)), false);
    for_people(cause_tables(view), false);
    out.add("probabilities", fragility_table(view), {.text = false});
    out.add("curves", curve_table(view), {.text = false});
    out.add("rates", rate_table(view), {.text = false});
    if (view.answer.conditioned) out.add("conditioned_on_friction", conditioned_table(view), {.text = false});
    if (view.answer.causes) out.add("causes", cause_table(view), {.text = false});
    out.add("needed_yield", needed_yield_table(view), {.text = false});
    out += fmt::format("{} runs by {}: {}\n", plan.samples.size(), view.study.method.id, status_words(view));
    out += fmt::format("share of the draws that do not stand without an earthquake: {:.4g}\n",
                       view.answer.estimate.p_static);
    Headline headline;
    for (const LimitEstimate& limit : view.answer.estimate.limits) {
        const std::string sentence = answer_sentence(view, limit);
        out += sentence + "\n";
        headline.sentence += sentence + "; ";
    }
    out += fmt::format("by {}\n", method_words(view));
    headline.sentence += fmt::format("by {}.", method_words(view));
    out.headline_in_brief(headline);
    out.point("runs",
              fmt::format("{} by {}: {}; {:.3g} of the draws do not stand without an earthquake", plan.samples.size(),
                          view.study.method.id, status_words(view), view.answer.estimate.p_static));
    out.notes("notes", view.answer.notes);
    return out;
}

Page fragility_page(const FragilityView& view)
{
    Page page = begin_page(view.study.scene, "How likely the dam slides too far, by the strength of the earthquake. ");
    page.headline.sentence =
        fmt::format("{}; by {}.", answer_sentence(view, view.answer.estimate.limits.front()), method_words(view));
    page.key_figures = {{"Runs", fmt::format("{} by {}", view.plan.samples.size(), view.study.method.id)},
                        {"Events", std::to_string(view.answer.estimate.clusters)},
                        {"Does not stand", fmt::format("{:.3g}", view.answer.estimate.p_static)}};
    for (const LimitEstimate& limit : view.answer.estimate.limits)
        if (limit.rate && page.key_figures.size() < 6)
            page.key_figures.emplace_back(limit.limit.text, rates_per_year(view, limit));
    page.warnings = view.answer.notes;
    Section curves{"Fragility", {curve_chart(view)}};
    Section rates{"Rates"}, causes{"What it comes from", {}};
    const auto add = [](Section& to, std::vector<Table> tables, Fold fold = Fold::open) {
        for (Table& table : tables)
            if (!table.rows.empty()) to.parts.push_back(TablePart{std::move(table), Layout::rows, 1, fold});
    };
    add(curves, probability_tables(view));
    page.sections.push_back(std::move(curves));
    if (std::vector<Table> tables = rate_tables(view); !tables.empty()) {
        rates.parts = {rate_chart(view)};
        add(rates, std::move(tables));
        add(rates, by_first_column(rate_part_table(view)), Fold::folded);
        page.sections.push_back(std::move(rates));
    }
    add(causes, cause_tables(view));
    if (!causes.parts.empty()) page.sections.push_back(std::move(causes));
    if (view.answer.own_cost.size() > 1)
        page.sections.push_back(
            {"What the interval costs",
             {interval_cost_chart(view.answer.own_cost, CostAxis::runs,
                                  "Half-width of the interval of the draws over runs",
                                  "By the first draws of this run, where P is nearest to 0.1. damslip accuracy "
                                  "--probability sets other ways to draw beside it, with their seconds.")}});
    page.sections.push_back({"Runs", {Paragraph{status_words(view) + ". Each run is a row of samples.csv."}}});
    page.sections.push_back(
        limits_section(view.study.scene, view.study.finite_elements() ? Method::finite_elements : Method::rigid_block));
    end_page(view.study.scene, *view.plan.suite.pairs, page);
    return page;
}

std::string fragility_nrml(const FragilityView& view)
{
    probability::NrmlModel model;
    model.id = "damslip";
    model.description = view.study.scene.title;
    const IntensityInput& of_levels = view.plan.input.intensity;
    model.imt = of_levels.first_period ? fmt::format("SA({:.4g})", first_period_of(view.study.scene)) : of_levels.text;
    const double unit = openquake_unit({of_levels.measure, of_levels.first_period, of_levels.periods});
    for (const double x : of_levels.levels) model.levels.push_back(x / unit);
    if (view.plan.input.intensity.design == FragilityDesign::cloud) return "";
    // Curves that do not hold, or cross, have the discrete form: P at the levels. Of a limit without a curve that of the stripes, made
    // non-decreasing, for the file alone.
    const bool discrete = std::ranges::any_of(view.answer.estimate.limits,
                                              [](const LimitEstimate& limit) { return !limit.fit.lognormal(); });
    for (const LimitEstimate& limit : view.answer.estimate.limits) {
        probability::NrmlLimit& of = model.limits.emplace_back();
        of.name = name_of_limit(limit.limit.text);
        of.median = discrete ? 0.0 : limit.fit.curve.median / unit; // 0: the discrete form
        of.beta = limit.fit.curve.beta;
        std::vector<double> stripes, runs;
        for (const LevelEstimate& level : limit.levels) {
            stripes.push_back(level.p);
            runs.push_back(std::max(level.n, 1e-9));
        }
        of.poes = non_decreasing(std::move(stripes), runs);
        if (!limit.fit.lognormal()) continue;
        of.poes.clear();
        for (const double x : view.plan.input.intensity.levels) of.poes.push_back(limit.fit.curve.probability(x));
    }
    const auto weight_of = [](const probability::NrmlLimit& of) {
        return std::accumulate(of.poes.begin(), of.poes.end(), 0.0);
    };
    std::ranges::sort(model.limits, [&](const auto& a, const auto& b) { // the mildest first
        return discrete ? weight_of(a) > weight_of(b) : a.median < b.median;
    });
    return model.limits.empty() ? std::string() : probability::nrml_fragility(model);
}

std::string fragility_usace(const FragilityView& view)
{
    const std::vector<probability::UsaceLocation> locations = stage_fragility(view.plan, view.runs);
    return locations.empty() ? std::string() : probability::usace_fragility(view.study.scene.title, locations);
}

namespace {

/// "P(slip > 50 mm) at PGA = 0.15 g by fe"
std::string what_is_estimated(const FragilityStudy& study, const IntervalCost& cost)
{
    return fmt::format("P({}) at {} = {:.4g} {} by {}", cost.limit.text, study.input.intensity.text,
                       cost.level / study.input.intensity.level_unit, study.input.intensity.level_unit_text,
                       cost.method);
}

/// The estimator with the largest gain over plain Monte Carlo in its longest run.
std::string answer_on_cost(const FragilityStudy& study, const IntervalCost& cost)
{
    std::vector<const IntervalPoint*> longest; // of each estimator
    for (const IntervalPoint& p : cost.points) {
        if (!p.done()) continue;
        if (longest.empty() || longest.back()->estimator != p.estimator)
            longest.push_back(&p);
        else
            longest.back() = &p;
    }
    std::string sentence = what_is_estimated(study, cost);
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

/// One row an estimator and number of runs.
Table interval_cost_table(const IntervalCost& cost)
{
    using P = IntervalPoint;
    const auto done = [](auto get) { return [=](const P& p) { return p.done() ? Cell(get(p)) : Cell(); }; };
    return table_of<P>(
        "What the interval costs",
        {{in_brief({"estimator", "estimator"}), &P::estimator},
         {in_brief({"runs", "runs"}), &P::runs},
         {in_brief({"seconds", "processor time", "s", 3}), done([](const P& p) { return p.seconds; })},
         {in_brief({"probability", "P", "–"}), done([](const P& p) { return p.p; })},
         {in_brief({"lower", "2.5 %", "–", 3}), done([](const P& p) { return p.interval.lower; })},
         {in_brief({"upper", "97.5 %", "–", 3}), done([](const P& p) { return p.interval.upper; })},
         {in_brief({"half_width", "half-width", "–", 3}), done([](const P& p) { return p.interval.half_width(); })},
         {in_brief({"gain", "gain", "–", 3}), &P::gain},
         {{"remark", "remark"}, [](const P& p) { return p.done() ? Cell() : Cell(p.remark); }}},
        cost.points,
        {"gain: variance of plain Monte Carlo for the same processor time over that of the estimate. An interval from "
         "few "
         "replicates is itself uncertain: by 16 of them its width to a fifth.",
         "All variables are drawn anew for each run here; those that are not known (epistemic) have the same mean P "
         "so."});
}

} // namespace

Answer interval_cost_answer(const FragilityStudy& study, const IntervalCost& cost)
{
    Answer answer(json_header("accuracy-probability", study.scene));
    answer.set("method", cost.method);
    answer.set("limit", cost.limit.text);
    answer.set("intensity", study.input.intensity.text);
    answer.set("level", cost.level / study.input.intensity.level_unit);
    answer.set("unit", study.input.intensity.level_unit_text);
    answer.add("estimates", interval_cost_table(cost), {.brief = true, .file = "accuracy.csv"});
    answer += answer_on_cost(study, cost) + "\n";
    answer.headline_in_brief({answer_on_cost(study, cost)});
    return answer;
}

Page interval_cost_page(const FragilityStudy& study, const IntervalCost& cost)
{
    Page page = begin_page(study.scene, "What the accuracy of a probability costs. ");
    page.headline.sentence = answer_on_cost(study, cost);
    page.key_figures = {
        {"Level", fmt::format("{} = {:.4g} {}", study.input.intensity.text,
                              cost.level / study.input.intensity.level_unit, study.input.intensity.level_unit_text)},
        {"Limit", cost.limit.text},
        {"Method", cost.method}};
    page.sections.push_back(
        {"Half-width over time",
         {interval_cost_chart(cost.points, CostAxis::seconds, what_is_estimated(study, cost), cost_note),
          rows_part(interval_cost_table(cost))}});
    end_page(study.scene, *study.suite.pairs, page);
    return page;
}

} // namespace damslip::pages
