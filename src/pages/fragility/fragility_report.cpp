#include "pages/fragility/fragility_pages.hpp"

#include "analysis/fragility/capacity_roots.hpp"
#include "pages/report/json.hpp"
#include "pages/report/table_text.hpp"
#include "pages/scene/scene_pages.hpp"
#include "probability/fragility_files.hpp"

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
    for (const auto& [status, n] : view.estimate.statuses)
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

/// Room for whole marks at both ends of a logarithmic axis.
void keep_marks_inside(Axis& x, const std::vector<double>& levels, double unit)
{
    constexpr double room = 1.05;
    if (levels.empty()) return;
    x.low = levels.front() / unit / room;
    x.high = levels.back() / unit * room;
}

Chart curve_chart(const FragilityView& view)
{
    Chart chart{"Fragility",
                {view.plan.input.intensity.text, view.unit_text, Scale::log},
                {"probability", "–"},
                {},
                {},
                {},
                {},
                "",
                "",
                380};
    chart.y.low = -0.03;
    chart.y.high = 1.03;
    keep_marks_inside(chart.x, view.plan.input.intensity.levels, view.unit);
    int colour = 0;
    for (const LimitEstimate& limit : view.estimate.limits) {
        Curve stripes{limit.limit.text, {}, {}, {}, {}, Mark::points, Weight::normal, colour};
        Curve band{
            limit.limit.text + ", 5 to 95 % of lack of knowledge", {}, {}, {}, {}, Mark::dashed, Weight::faint, colour};
        for (const LevelEstimate& level : limit.levels) {
            stripes.x.push_back(level.x / view.unit);
            stripes.y.push_back(level.p);
            if (!limit.cloud) {
                stripes.low.push_back(level.sampling.lower);
                stripes.high.push_back(level.sampling.upper);
            }
            if (!level.bands) continue;
            band.x.push_back(level.x / view.unit);
            band.y.push_back(level.bands->percentiles[2]);
            band.low.push_back(level.bands->percentiles.front());
            band.high.push_back(level.bands->percentiles.back());
        }
        if (limit.fit.method != probability::FitMethod::none && limit.levels.size() > 1) {
            Curve line{limit.limit.text +
                           (limit.fit.method == probability::FitMethod::firth ? ", lognormal (Firth)" : ", lognormal"),
                       {},
                       {},
                       {},
                       {},
                       limit.fit.lognormal() ? Mark::line : Mark::dashed,
                       Weight::strong,
                       colour};
            for (const double x : log_spaced(limit.levels.front().x, limit.levels.back().x)) {
                line.x.push_back(x / view.unit);
                line.y.push_back(limit.fit.curve.probability(x));
            }
            chart.curves.push_back(std::move(line));
        }
        chart.curves.push_back(std::move(stripes));
        if (!band.x.empty()) chart.curves.push_back(std::move(band));
        ++colour;
    }
    chart.note = "Points: stripes with the 95 % interval of the draws.";
    return chart;
}

Chart rate_chart(const FragilityView& view)
{
    Chart chart{"Rate by intensity",
                {view.plan.input.intensity.text, view.unit_text, Scale::log},
                {"rate per part of ln x", "1/year", Scale::log},
                {},
                {},
                {},
                {},
                "",
                "",
                330};
    keep_marks_inside(chart.x, view.plan.input.intensity.levels, view.unit);
    for (const LimitEstimate& limit : view.estimate.limits) {
        if (!limit.rate) continue;
        Curve curve{limit.limit.text, {}, {}, {}, {}, Mark::line_and_points, Weight::normal, -1};
        for (const probability::RatePart& part : limit.rate->raw.parts) {
            if (!(part.x_lower > 0.0) || !(part.x_upper > part.x_lower)) continue;
            curve.x.push_back(std::sqrt(part.x_lower * part.x_upper) / view.unit);
            curve.y.push_back(part.rate / std::log(part.x_upper / part.x_lower));
        }
        if (!curve.x.empty()) chart.curves.push_back(std::move(curve));
    }
    chart.note = "Which earthquakes the rate comes from: the area below a curve is its rate.";
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
                : fmt::format(" by earthquakes above {:.3g} {}", upper.x_first / view.unit, view.unit_text));
}

/// "the rigid block: no bound for an elastic dam", "finite elements": what the runs are of.
std::string method_words(const FragilityView& view)
{
    const SweepKind kind = sweep_method(view.method).kind;
    if (kind == SweepKind::finite_elements) return "finite elements";
    const bool dam = !view.scene.wedge && !view.scene.section.rock_slope;
    return std::string(kind == SweepKind::rocking ? "the rocking block" : "the rigid block") +
           (dam ? ": no bound for an elastic dam" : "");
}

/// "slip > 50 mm: P = 0.5 at PGA = 0.31 g; 1.1e-4 to 1.3e-4 per year"
std::string answer_sentence(const FragilityView& view, const LimitEstimate& limit)
{
    std::string sentence = limit.limit.text + ": ";
    const std::string apart = levels_apart_from_median(view, limit);
    if (limit.fit.method != probability::FitMethod::none)
        sentence += fmt::format("P = 0.5 at {} = {:.3g} {}{}", view.plan.input.intensity.text,
                                limit.fit.curve.median / view.unit, view.unit_text,
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
    Answer out(json_header("fragility", view.scene));
    const FragilityPlan& plan = view.plan;
    out.set("method", view.method);
    out.set("intensity", plan.input.intensity.text);
    out.set("unit", view.unit_text);
    out.set("runs", plan.samples.size());
    out.set("draws", plan.draws.size());
    out.set("replicates", plan.replicates);
    out.set("epistemic_draws", plan.epistemic ? plan.replicates * plan.outer : 0);
    out.set("events", view.estimate.clusters);
    out.set("p_static", view.estimate.p_static);
    out.set("statuses", view.estimate.statuses);
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
    if (view.conditioned) out.add("conditioned_on_friction", conditioned_table(view), {.text = false});
    if (view.causes) out.add("causes", cause_table(view), {.text = false});
    out.add("needed_yield", needed_yield_table(view), {.text = false});
    out += fmt::format("{} runs by {}: {}\n", plan.samples.size(), view.method, status_words(view));
    out += fmt::format("share of the draws that do not stand without an earthquake: {:.4g}\n", view.estimate.p_static);
    Headline headline;
    for (const LimitEstimate& limit : view.estimate.limits) {
        const std::string sentence = answer_sentence(view, limit);
        out += sentence + "\n";
        headline.sentence += sentence + "; ";
    }
    out += fmt::format("by {}\n", method_words(view));
    headline.sentence += fmt::format("by {}.", method_words(view));
    out.headline_in_brief(headline);
    out.point("runs", fmt::format("{} by {}: {}; {:.3g} of the draws do not stand without an earthquake",
                                  plan.samples.size(), view.method, status_words(view), view.estimate.p_static));
    out.set("notes", view.notes);
    for (const std::string& note : view.notes) out.note(note);
    return out;
}

Page fragility_page(const FragilityView& view)
{
    Page page = begin_page(view.scene, "How likely the dam slides too far, by the strength of the earthquake. ");
    page.headline.sentence =
        fmt::format("{}; by {}.", answer_sentence(view, view.estimate.limits.front()), method_words(view));
    page.key_figures = {{"Runs", fmt::format("{} by {}", view.plan.samples.size(), view.method)},
                        {"Events", std::to_string(view.estimate.clusters)},
                        {"Does not stand", fmt::format("{:.3g}", view.estimate.p_static)}};
    for (const LimitEstimate& limit : view.estimate.limits)
        if (limit.rate && page.key_figures.size() < 6)
            page.key_figures.emplace_back(limit.limit.text, rates_per_year(view, limit));
    page.warnings = view.notes;
    Section curves{"Fragility", {curve_chart(view)}, Fold::open};
    Section rates{"Rates", {}, Fold::open}, causes{"What it comes from", {}, Fold::open};
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
    if (view.own_cost.size() > 1)
        page.sections.push_back(
            {"What the interval costs",
             {interval_cost_chart(view.own_cost, CostAxis::runs, "Half-width of the interval of the draws over runs",
                                  "By the first draws of this run, where P is nearest to 0.1. damslip accuracy "
                                  "--probability sets other ways to draw beside it, with their seconds.")},
             Fold::open});
    page.sections.push_back(
        {"Runs", {Paragraph{status_words(view) + ". Each run is a row of samples.csv."}}, Fold::open});
    page.sections.push_back(limits_section(view.scene, sweep_method(view.method).kind == SweepKind::finite_elements
                                                           ? Method::finite_elements
                                                           : Method::rigid_block));
    page.sections.push_back({"Scene", {scene_listing(view.scene)}, Fold::open});
    page.provenance = scene_provenance(view.scene);
    add_record_provenance(*view.plan.suite.pairs, page.provenance);
    return page;
}

std::string fragility_nrml(const FragilityView& view)
{
    probability::NrmlModel model;
    model.id = "damslip";
    model.description = view.scene.title;
    model.imt = view.plan.input.intensity.text;
    for (const double x : view.plan.input.intensity.levels) model.levels.push_back(x / view.unit);
    if (view.plan.input.intensity.design == FragilityDesign::cloud) return "";
    // Curves that do not hold, or cross, have the discrete form: P at the levels. Of a limit without a curve that of the stripes, made
    // non-decreasing, for the file alone.
    const bool discrete = std::any_of(view.estimate.limits.begin(), view.estimate.limits.end(),
                                      [](const LimitEstimate& limit) { return !limit.fit.lognormal(); });
    for (const LimitEstimate& limit : view.estimate.limits) {
        probability::NrmlLimit& of = model.limits.emplace_back();
        of.name = name_of_limit(limit.limit.text);
        of.median = discrete ? 0.0 : limit.fit.curve.median / view.unit; // 0: the discrete form
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
    std::sort(model.limits.begin(), model.limits.end(), [&](const auto& a, const auto& b) { // the mildest first
        return discrete ? weight_of(a) > weight_of(b) : a.median < b.median;
    });
    return model.limits.empty() ? std::string() : probability::nrml_fragility(model);
}

std::string fragility_usace(const FragilityView& view)
{
    const std::vector<probability::UsaceLocation> locations = stage_fragility(view.plan, view.runs);
    return locations.empty() ? std::string() : probability::usace_fragility(view.scene.title, locations);
}

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
        {{in_brief({"estimator", "estimator"}), &P::estimator},
         {in_brief({"runs", "runs"}), [](const P& p) { return count_cell(p.runs); }},
         {in_brief({"seconds", "processor time", "s", 3}), done([](const P& p) { return p.seconds; })},
         {in_brief({"probability", "P", "–"}), done([](const P& p) { return p.p; })},
         {in_brief({"lower", "2.5 %", "–", 3}), done([](const P& p) { return p.interval.lower; })},
         {in_brief({"upper", "97.5 %", "–", 3}), done([](const P& p) { return p.interval.upper; })},
         {in_brief({"half_width", "half-width", "–", 3}), done([](const P& p) { return p.interval.half_width(); })},
         {in_brief({"gain", "gain", "–", 3}), [](const P& p) { return optional_cell(p.gain); }},
         {{"remark", "remark"}, [](const P& p) { return p.done() ? Cell() : Cell(p.remark); }}},
        view.cost.points,
        {"gain: variance of plain Monte Carlo for the same processor time over that of the estimate. An interval from "
         "few "
         "replicates is itself uncertain: by 16 of them its width to a fifth.",
         "All variables are drawn anew for each run here; those that are not known (epistemic) have the same mean P "
         "so."});
}

Answer interval_cost_answer(const IntervalCostView& view)
{
    Answer answer(json_header("accuracy-probability", view.scene));
    answer.set("method", view.cost.method);
    answer.set("limit", view.cost.limit.text);
    answer.set("intensity", view.measure);
    answer.set("level", view.cost.level / view.unit);
    answer.set("unit", view.unit_text);
    answer.add("estimates", interval_cost_table(view), {.brief = true, .file = "accuracy.csv"});
    answer += answer_on_cost(view) + "\n";
    answer.headline_in_brief({answer_on_cost(view)});
    return answer;
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
