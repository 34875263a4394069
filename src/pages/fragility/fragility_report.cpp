#include "pages/fragility/fragility_report.hpp"

#include "analysis/fragility/stage_fragility.hpp"

#include "pages/fragility/fragility_tables.hpp"
#include "pages/fragility/interval_cost_report.hpp"
#include "pages/report/json_object.hpp"
#include "pages/report/table_text.hpp"
#include "pages/scene/report_provenance.hpp"
#include "probability/export/fragility_files.hpp"

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

/// The tables that have rows, in the order of the page.
std::vector<Table> tables_of(const FragilityView& view)
{
    std::vector<Table> tables;
    for (Table table : {fragility_table(view), conditioned_table(view), curve_table(view), rate_table(view),
                        rate_part_table(view), cause_table(view), needed_yield_table(view)})
        if (!table.rows.empty()) tables.push_back(std::move(table));
    return tables;
}

std::vector<double> log_spaced(double from, double to)
{
    constexpr int n = 80;
    std::vector<double> x;
    for (int i = 0; i <= n; ++i) x.push_back(from * std::pow(to / from, static_cast<double>(i) / n));
    return x;
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
    chart.y.low = 0.0;
    chart.y.high = 1.0;
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

nlohmann::ordered_json fragility_json(const FragilityView& view)
{
    nlohmann::ordered_json j = json_header("fragility", view.scene);
    j["method"] = view.method;
    j["intensity"] = view.plan.input.intensity.text;
    j["unit"] = view.unit_text;
    j["runs"] = view.plan.samples.size();
    j["draws"] = view.plan.draws.size();
    j["replicates"] = view.plan.replicates;
    j["epistemic_draws"] = view.plan.epistemic ? view.plan.replicates * view.plan.outer : 0;
    j["events"] = view.estimate.clusters;
    j["p_static"] = view.estimate.p_static;
    j["statuses"] = view.estimate.statuses;
    j["probabilities"] = json_of(fragility_table(view));
    j["curves"] = json_of(curve_table(view));
    j["rates"] = json_of(rate_table(view));
    if (view.conditioned) j["conditioned_on_friction"] = json_of(conditioned_table(view));
    if (view.causes) j["causes"] = json_of(cause_table(view));
    j["needed_yield"] = json_of(needed_yield_table(view));
    j["notes"] = view.notes;
    return j;
}

std::string fragility_text(const FragilityView& view)
{
    std::string out;
    for (const Table& table : tables_of(view)) out += text(table) + "\n";
    out += fmt::format("{} runs by {}: {}\n", view.plan.samples.size(), view.method, status_words(view));
    out += fmt::format("share of the draws that do not stand without an earthquake: {:.4g}\n", view.estimate.p_static);
    for (const LimitEstimate& limit : view.estimate.limits) out += answer_sentence(view, limit) + "\n";
    for (const std::string& note : view.notes) out += "note: " + note + "\n";
    return out;
}

Page fragility_page(const FragilityView& view)
{
    Page page = begin_page(view.scene, "How likely the dam slides too far, by the strength of the earthquake. ");
    page.headline.sentence = view.estimate.limits.empty() ? "" : answer_sentence(view, view.estimate.limits.front());
    page.key_figures = {{"Runs", fmt::format("{} by {}", view.plan.samples.size(), view.method)},
                        {"Events", std::to_string(view.estimate.clusters)},
                        {"Does not stand", fmt::format("{:.3g}", view.estimate.p_static)}};
    for (const LimitEstimate& limit : view.estimate.limits)
        if (limit.rate && page.key_figures.size() < 6)
            page.key_figures.emplace_back(limit.limit.text, rates_per_year(view, limit));
    page.warnings = view.notes;
    Section curves{"Fragility", {curve_chart(view)}, Fold::open};
    Section rates{"Rates", {}, Fold::open}, causes{"What it comes from", {}, Fold::open};
    for (Table table : {fragility_table(view), conditioned_table(view), curve_table(view)})
        if (!table.rows.empty()) curves.parts.push_back(rows_part(std::move(table)));
    page.sections.push_back(std::move(curves));
    if (const Table table = rate_table(view); !table.rows.empty()) {
        rates.parts = {rate_chart(view), rows_part(table),
                       TablePart{rate_part_table(view), Layout::rows, 1, Fold::folded}};
        page.sections.push_back(std::move(rates));
    }
    for (Table table : {cause_table(view), needed_yield_table(view)})
        if (!table.rows.empty()) causes.parts.push_back(rows_part(std::move(table)));
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

} // namespace damslip::pages
