#include "pages/fragility/fragility_pages.hpp"

#include "analysis/prepare/records.hpp"
#include "core/units.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace damslip::pages {

namespace {

using units::mm;

struct SampleRow {
    std::size_t id;
    FragilitySample sample;
    FragilityDraw draw;
    std::optional<FinishedRow> row;
};

Cell cell_of_value(const KeyValue& value)
{
    if (const auto* d = std::get_if<double>(&value)) return *d;
    if (const auto* b = std::get_if<bool>(&value)) return *b;
    return std::get<std::string>(value);
}

struct LevelRow {
    const LimitEstimate& limit;
    const LevelEstimate& level;
};

std::string count_words(const probability::LognormalFit& fit)
{
    switch (fit.method) {
    case probability::FitMethod::likelihood:
        return fit.lognormal() ? "likelihood" : "likelihood; not lognormal, deviance p < 0.01";
    case probability::FitMethod::firth:
        return "Firth: " + fit.why;
    case probability::FitMethod::none:
        break;
    }
    return "none: " + fit.why;
}

/// Of the levels, its key and heading with their unit.
Column intensity_column(const FragilityView& view)
{
    std::string key = view.unit_text(); // m/s2 -> m_s2
    for (char& c : key)
        if (c == '/') c = '_';
    return {"intensity_" + key, view.plan.input.intensity.text, view.unit_text()};
}

} // namespace

Table sample_table(const FragilityView& view, std::size_t first, std::size_t end)
{
    std::vector<SampleRow> rows;
    for (std::size_t id = first; id < std::min(end, view.plan.samples.size()); ++id) {
        const FragilitySample sample = view.plan.samples[id];
        rows.push_back({id, sample, view.plan.draws[sample.draw], view.runs.rows[id]});
    }
    const auto result = [](auto member, double unit) {
        return [=](const SampleRow& r) { return r.row ? optional_cell(r.row->results.*member, unit) : Cell(); };
    };
    std::vector<ColumnOf<SampleRow>> columns = {
        {{"index", "run"}, &SampleRow::id},
        {{"replicate", "replicate"}, [](const SampleRow& r) { return r.sample.replicate; }},
        {{"epistemic_draw", "epistemic draw"}, [](const SampleRow& r) { return r.sample.outer; }},
        {{"aleatory_draw", "aleatory draw"}, [](const SampleRow& r) { return r.sample.inner; }},
        {intensity_column(view), [&](const SampleRow& r) { return r.sample.x / view.unit(); }},
        {{"record", "record"},
         [&](const SampleRow& r) { return (*view.plan.suite.pairs)[r.sample.record].files.name; }},
        {{"event", "event"}, [&](const SampleRow& r) { return view.plan.suite.event[r.sample.record]; }},
        {{"polarity", "polarity"}, [](const SampleRow& r) { return std::int64_t{r.sample.polarity}; }},
        {{"factor", "factor", "–"}, [](const SampleRow& r) { return r.sample.factor; }}};
    for (std::size_t v = 0; v < view.plan.variables().size(); ++v)
        columns.push_back({{view.plan.variables()[v].name, view.plan.variables()[v].name},
                           [v](const SampleRow& r) { return cell_of_value(r.draw.values[v]); }});
    columns.insert(
        columns.end(),
        {{{"method", "method"}, [&](const SampleRow&) { return view.study.method.id; }},
         {{"slip_mm", "slip", "mm"}, result(&RowResults::slip, mm)},
         {{"largest_slip_mm", "largest", "mm"}, result(&RowResults::max_slip, mm)},
         {{"error_mm", "error", "mm"}, result(&RowResults::slip_error, mm)},
         {{"critical_friction", "critical friction", "–"}, result(&RowResults::critical_friction, 1.0)},
         {{"status", "status"}, [](const SampleRow& r) { return r.row ? Cell(r.row->results.status) : Cell(); }}});
    const std::vector<LimitInput>& limits = view.plan.input.limits;
    if (!std::ranges::all_of(limits, is_of_slip)) {
        columns.push_back({{"opening_mm", "opening", "mm"}, result(&RowResults::opening, mm)});
        columns.push_back({{"factor_after", "factor after", "–"}, result(&RowResults::factor_after, 1.0)});
    }
    return table_of("Runs", columns, rows);
}

namespace {

/// Percentiles of P by lack of knowledge; none: there is none.
std::vector<ColumnOf<LevelRow>> band_columns(const FragilityView& view)
{
    std::vector<ColumnOf<LevelRow>> columns;
    if (view.plan.epistemic)
        for (std::size_t q = 0; q < probability::band_levels.size(); ++q)
            columns.push_back(
                {{fmt::format("band_{:02.0f}", 100.0 * probability::band_levels[q]),
                  fmt::format("{:.0f} % of P", 100.0 * probability::band_levels[q]), "–", 3},
                 [q](const LevelRow& r) { return r.level.bands ? Cell(r.level.bands->percentiles[q]) : Cell(); }});
    return columns;
}

std::vector<LevelRow> level_rows(const FragilityView& view)
{
    std::vector<LevelRow> rows;
    for (const LimitEstimate& limit : view.answer.estimate.limits)
        for (const LevelEstimate& level : limit.levels) rows.push_back({limit, level});
    return rows;
}

/// Weighted runs are no whole number.
Cell count_of(double n)
{
    return n == std::round(n) ? Cell(static_cast<std::int64_t>(n)) : Cell(n);
}

} // namespace

Table fragility_table(const FragilityView& view, Readers readers)
{
    const std::vector<LevelRow> rows = level_rows(view);
    using R = LevelRow;
    const bool counted = view.plan.input.intensity.design != FragilityDesign::cloud;
    const auto number = [counted](auto get) {
        return [=](const R& r) { return counted ? Cell(get(r.level)) : Cell(); };
    };
    std::vector<ColumnOf<R>> columns = {
        {{"limit", "limit"}, [](const R& r) { return r.limit.limit.text; }},
        {in_brief(intensity_column(view)), [&](const R& r) { return r.level.x / view.unit(); }},
        {in_brief({"probability", "P", "–"}),
         [counted](const R& r) { return counted || r.level.fitted ? Cell(r.level.p) : Cell(); }},
        {in_brief({"sampling_lower", "draws 2.5 %", "–", 3}),
         number([](const LevelEstimate& e) { return e.sampling.lower; })},
        {in_brief({"sampling_upper", "97.5 %", "–", 3}),
         number([](const LevelEstimate& e) { return e.sampling.upper; })},
        {{"records_lower", "records 2.5 %", "–", 3},
         [counted](const R& r) {
             return counted && r.level.records.clusters > 1 ? Cell(r.level.records.lower) : Cell();
         }},
        {{"records_upper", "97.5 %", "–", 3},
         [counted](const R& r) {
             return counted && r.level.records.clusters > 1 ? Cell(r.level.records.upper) : Cell();
         }},
        {in_brief({"runs", "runs"}), number([](const LevelEstimate& e) { return count_of(e.n); })},
        {in_brief({"failures", "failures"}), number([](const LevelEstimate& e) { return count_of(e.z); })}};
    const bool missing = std::ranges::any_of(rows, [](const R& r) { return r.level.missing > 0.0; });
    const auto bound = [counted](auto get) {
        return [=](const R& r) { return counted || r.level.missing > 0.0 ? Cell(get(r.level)) : Cell(); };
    };
    const std::vector<ColumnOf<R>> of_missing = {
        {in_brief({"missing", "missing"}), bound([](const LevelEstimate& e) { return e.missing; })},
        {{"probability_low", "missing survive", "–", 3}, bound([](const LevelEstimate& e) { return e.p_low; })},
        {{"probability_high", "missing fail", "–", 3}, bound([](const LevelEstimate& e) { return e.p_high; })}};
    if (missing || readers == Readers::files) columns.insert(columns.end(), of_missing.begin(), of_missing.end());
    columns.push_back({in_brief({"fitted", "curve", "–"}), [](const R& r) { return r.level.fitted; }});
    if (readers == Readers::files)
        for (ColumnOf<R>& column : band_columns(view)) columns.push_back(std::move(column));
    Table t = table_of("Probabilities", columns, rows);
    const SuitePolarity polarity = view.plan.input.suite.value_or(SuiteInput{}).polarity;
    t.notes = {"each record with " + polarity_words(polarity == SuitePolarity::both       ? std::vector{1, -1}
                                                    : polarity == SuitePolarity::reversed ? std::vector{-1}
                                                                                          : std::vector{1})};
    if (!counted) return t;
    t.notes.emplace_back("draws: 95 % by the draws of variables and records, the suite taken as all there is;");
    t.notes.emplace_back("records: 95 % by drawing its events anew. The two are never added up.");
    if (view.answer.estimate.clusters < 10)
        t.notes.push_back(
            fmt::format("records: {} event{}, fewer than 10: that interval is too short, or there is none.",
                        view.answer.estimate.clusters, view.answer.estimate.clusters == 1 ? "" : "s"));
    for (const LimitEstimate& limit : view.answer.estimate.limits)
        for (const LevelEstimate& level : limit.levels)
            if (level.bands && level.bands->add_inner) {
                t.notes.push_back(
                    "bands: inner draws add more than 20 % of their variance; more samples make them narrower.");
                return t;
            }
    return t;
}

Table band_table(const FragilityView& view)
{
    std::vector<ColumnOf<LevelRow>> columns = {
        {{"limit", "limit"}, [](const LevelRow& r) { return r.limit.limit.text; }},
        {intensity_column(view), [&](const LevelRow& r) { return r.level.x / view.unit(); }}};
    for (ColumnOf<LevelRow>& column : band_columns(view)) columns.push_back(std::move(column));
    return view.plan.epistemic ? table_of("Bands of P by lack of knowledge", columns, level_rows(view)) : Table{};
}

Table curve_table(const FragilityView& view)
{
    using L = LimitEstimate;
    std::vector<ColumnOf<L>> columns = {
        {in_brief({"limit", "limit"}), [](const L& l) { return l.limit.text; }},
        {in_brief({"median", "median", view.unit_text()}),
         [&](const L& l) {
             return l.fit.method != probability::FitMethod::none ? Cell(l.fit.curve.median / view.unit()) : Cell();
         }},
        {in_brief({"beta", "β", "–"}),
         [](const L& l) { return l.fit.method != probability::FitMethod::none ? Cell(l.fit.curve.beta) : Cell(); }},
        {{"deviance_p", "deviance p", "–", 3},
         [](const L& l) { return l.fit.method != probability::FitMethod::none ? Cell(l.fit.deviance_p) : Cell(); }},
        {in_brief({"fit", "fit"}), [](const L& l) {
             return l.cloud ? Cell(l.cloud->found ? "cloud" : "none: " + l.cloud->why) : Cell(count_words(l.fit));
         }}};
    if (view.plan.input.intensity.design == FragilityDesign::ida) {
        const auto found = [](const L& l) { return l.capacities && l.capacities->found; };
        columns.push_back({{"capacity_median", "median of capacities", view.unit_text()}, [&, found](const L& l) {
                               return found(l) ? Cell(l.capacities->curve.median / view.unit()) : Cell();
                           }});
        columns.push_back({{"capacity_beta", "β", "–"},
                           [found](const L& l) { return found(l) ? Cell(l.capacities->curve.beta) : Cell(); }});
        columns.push_back({{"censored", "never reached"},
                           [](const L& l) { return l.capacities ? count_cell(l.capacities->censored) : Cell(); }});
        columns.push_back({{"came_back", "survive again above"}, &L::came_back});
    }
    Table t = table_of("Curves", columns, view.answer.estimate.limits);
    for (const LimitEstimate& limit : view.answer.estimate.limits)
        if (const std::string levels = levels_apart_from_median(view, limit); !levels.empty())
            t.notes.push_back(
                fmt::format("{}: the median is extrapolated from the levels, {}; levels about P = 0.5 would "
                            "say it.",
                            limit.limit.text, levels));
    for (const LimitEstimate& limit : view.answer.estimate.limits)
        if (limit.capacity_roots && limit.capacities)
            t.notes.push_back(fmt::format("{}: {} of {} capacities are the slip's own roots between two levels, the "
                                          "others the first level above.",
                                          limit.limit.text, *limit.capacity_roots, limit.capacities->reached));
    return t;
}

std::string levels_apart_from_median(const FragilityView& view, const LimitEstimate& limit)
{
    if (limit.fit.method == probability::FitMethod::none) return "";
    const double first = limit.levels.front().x, last = limit.levels.back().x, median = limit.fit.curve.median;
    if (median >= first && median <= last) return "";
    return fmt::format("{:.4g} to {:.4g} {}", first / view.unit(), last / view.unit(), view.unit_text());
}

Table rate_table(const FragilityView& view)
{
    std::vector<LimitEstimate> rated;
    for (const LimitEstimate& limit : view.answer.estimate.limits)
        if (limit.rate) rated.push_back(limit);
    using L = LimitEstimate;
    std::vector<ColumnOf<L>> columns = {
        {{"limit", "limit"}, [](const L& l) { return l.limit.text; }},
        {{"rate_lower", "rate, stripes", "1/year"}, [](const L& l) { return l.rate->bounds().lower; }},
        {{"rate_upper", "to", "1/year"}, [](const L& l) { return l.rate->bounds().upper; }},
        {{"sampling_lower", "draws 2.5 %", "1/year", 3}, [](const L& l) { return l.rate->sampling.lower; }},
        {{"sampling_upper", "97.5 %", "1/year", 3}, [](const L& l) { return l.rate->sampling.upper; }},
        {{"records_lower", "records 2.5 %", "1/year", 3},
         [](const L& l) { return l.rate->records.clusters > 1 ? Cell(l.rate->records.lower) : Cell(); }},
        {{"records_upper", "97.5 %", "1/year", 3},
         [](const L& l) { return l.rate->records.clusters > 1 ? Cell(l.rate->records.upper) : Cell(); }},
        {{"fitted_lower", "rate, curve", "1/year"},
         [](const L& l) { return l.rate->fitted ? Cell(l.rate->fitted->lower) : Cell(); }},
        {{"fitted_upper", "to", "1/year"},
         [](const L& l) { return l.rate->fitted ? Cell(l.rate->fitted->upper) : Cell(); }},
        {{"outside_share", "outside the levels", "–", 2}, [](const L& l) { return l.rate->raw.outside_share; }},
        {{"in_50_years", "P in 50 years", "–", 3},
         [](const L& l) { return probability::probability_in(l.rate->bounds().lower, 50.0); }},
        {{"in_50_years_upper", "to", "–", 3},
         [](const L& l) { return probability::probability_in(l.rate->bounds().upper, 50.0); }}};
    if (view.plan.epistemic)
        for (std::size_t q = 0; q < probability::band_levels.size(); ++q)
            columns.push_back({{fmt::format("band_{:02.0f}", 100.0 * probability::band_levels[q]),
                                fmt::format("{:.0f} %", 100.0 * probability::band_levels[q]), "1/year", 3},
                               [q](const L& l) { return q < l.rate->bands.size() ? Cell(l.rate->bands[q]) : Cell(); }});
    Table t = table_of("Rates per year", columns, rated);
    for (const L& l : rated) {
        if (!l.rate->raw.mostly_tested)
            t.notes.push_back(
                fmt::format("{}: {:.0f} % of the upper bound stem from intensities outside the tested levels.",
                            l.limit.text, 100.0 * l.rate->raw.outside_share));
        if (!l.rate->raw_high.all_events)
            t.notes.push_back(fmt::format(
                "{}: earthquakes below {:.3g} {}, the curve's first point, are left out; P is {:.3g} at most there.",
                l.limit.text, l.rate->raw.x_first / view.unit(), view.unit_text(), l.rate->raw_high.p_first));
    }
    if (std::ranges::any_of(rated, [](const L& l) { return !l.rate->raw_high.all_events; }))
        t.notes.push_back("hazard.all_events, the rate of all earthquakes, counts the weaker ones, too.");
    if (!rated.empty()) {
        if (std::ranges::all_of(rated, [](const L& l) { return l.rate->growing; }))
            t.notes.push_back("from … to: P is 0 … P of the lowest level below it, P of the highest … 1 above it;");
        else
            t.notes.push_back("from … to: P is 0 … P of the lowest level below it, P of the highest … 1 above it; where P falls from a level to a "
                              "higher one it is 0 … 1 outside them;");
        t.notes.push_back("draws, records, lack of knowledge: of the lower end.");
    }
    if (!rated.empty())
        t.notes.push_back(view.plan.input.probability.static_failure == StaticFailure::infinite
                              ? "A dam that does not stand without an earthquake counts at every intensity."
                              : fmt::format("Of a dam that stands without an earthquake; {:.3g} of the draws do not.",
                                            view.answer.estimate.p_static));
    return t;
}

std::vector<Table> rate_tables(const FragilityView& view)
{
    struct Row {
        std::string what;
        std::optional<double> from, to = {};
    };
    std::vector<Table> tables;
    for (const LimitEstimate& limit : view.answer.estimate.limits) {
        if (!limit.rate) continue;
        const LimitRate& rate = *limit.rate;
        const auto between = [](std::string what, const probability::Interval& i) {
            return Row{std::move(what), i.lower, i.upper};
        };
        std::vector<Row> rows{between("rate per year, stripes", rate.bounds()), between("draws, 95 %", rate.sampling)};
        if (rate.records.clusters > 1) rows.push_back(between("records, 95 %", rate.records));
        if (rate.fitted) rows.push_back({"rate per year, curve", rate.fitted->lower, rate.fitted->upper});
        if (!rate.bands.empty()) {
            rows.push_back({"lack of knowledge, 5 … 95 %", rate.bands[0], rate.bands[4]});
            rows.push_back({"lack of knowledge, 16 … 84 %", rate.bands[1], rate.bands[3]});
            rows.push_back({"lack of knowledge, median", rate.bands[2]});
        }
        rows.push_back({"P in 50 years", probability::probability_in(rate.bounds().lower, 50.0),
                        probability::probability_in(rate.bounds().upper, 50.0)});
        tables.push_back(table_of<Row>("Rates: " + limit.limit.text,
                                       {{in_brief({"what", "what"}), &Row::what},
                                        {in_brief({"from", "from", "", 3}), &Row::from},
                                        {in_brief({"to", "to", "", 3}), &Row::to}},
                                       rows));
    }
    if (!tables.empty()) tables.back().notes = rate_table(view).notes;
    return tables;
}

Table rate_part_table(const FragilityView& view)
{
    struct Part {
        std::string limit;
        probability::RatePart part;
        double whole;
    };
    std::vector<Part> parts;
    for (const LimitEstimate& limit : view.answer.estimate.limits)
        if (limit.rate)
            for (const probability::RatePart& part : limit.rate->raw.parts)
                parts.push_back({limit.limit.text, part, limit.rate->raw.inside});
    return table_of<Part>(
        "Rate by intensity",
        {{{"limit", "limit"}, &Part::limit},
         {{"from", "from", view.unit_text()}, [&](const Part& p) { return p.part.x_lower / view.unit(); }},
         {{"to", "to", view.unit_text()}, [&](const Part& p) { return p.part.x_upper / view.unit(); }},
         {{"rate", "rate", "1/year"}, [](const Part& p) { return p.part.rate; }},
         {{"share", "share", "–", 3},
          [](const Part& p) { return p.whole > 0.0 ? Cell(p.part.rate / p.whole) : Cell(); }}},
        parts);
}

namespace {

/// Variance of plain Monte Carlo with the same runs and seconds over that of the conditioned runs; all that was spent is charged by the level's runs.
std::optional<double> speed_up_of(const FragilityView& view, const LevelEstimate& level, std::size_t at)
{
    const ConditionedPlan& c = *view.answer.conditioned;
    const std::size_t computed = view.runs.finished() - view.runs.found;
    if (c.exact() || !(level.se > 0.0) || !(level.p > 0.0) || !(level.p < 1.0) || computed == 0) return std::nullopt;
    const double spent = view.runs.seconds + c.pilot.seconds + c.rigid_seconds;
    const double plain_runs = static_cast<double>(c.runs_at[at]) * spent / view.runs.seconds;
    return level.p * (1.0 - level.p) / plain_runs / (level.se * level.se);
}

std::string pilot_sentence(const FragilityView& view)
{
    const ConditionedPlan& c = *view.answer.conditioned;
    std::string words =
        fmt::format("pilot: {} runs, thrown away, {:.3g} processor seconds;", c.pilot.runs, c.pilot.seconds);
    for (std::size_t l = 0; l < c.pilot.correlation.size(); ++l)
        words += fmt::format(
            "{} {}: prediction and answer correlate by {:.2f}, scale of ln μ about the prediction {:.3f}", l ? "," : "",
            view.answer.estimate.limits[l].limit.text, c.pilot.correlation[l], c.pilot.spread[l]);
    return words + fmt::format(". Rigid block: {} motions, {:.3g} s. Runs that count: {}, {:.3g} s.", c.motions,
                               c.rigid_seconds, view.runs.finished(), view.runs.seconds);
}

} // namespace

Table conditioned_table(const FragilityView& view)
{
    struct Row {
        std::string limit;
        const LevelEstimate& level;
        std::size_t at;
    };
    std::vector<Row> rows;
    if (view.answer.conditioned)
        for (const LimitEstimate& limit : view.answer.estimate.limits)
            for (std::size_t k = 0; k < limit.levels.size(); ++k)
                rows.push_back({limit.limit.text, limit.levels[k], k});
    Table t = table_of<Row>(
        "Conditioned on friction",
        {{{"limit", "limit"}, &Row::limit},
         {intensity_column(view), [&](const Row& r) { return r.level.x / view.unit(); }},
         {{"probability", "P", "–"}, [](const Row& r) { return r.level.p; }},
         {{"standard_error", "standard error", "–", 3}, [](const Row& r) { return r.level.se; }},
         {{"variation", "c.o.v.", "–", 3},
          [](const Row& r) { return r.level.p > 0.0 ? Cell(r.level.se / r.level.p) : Cell(); }},
         {{"runs", "FE runs"}, [&](const Row& r) { return count_cell(view.answer.conditioned->runs_at[r.at]); }},
         {{"speed_up", "speed-up", "–", 3},
          [&](const Row& r) { return optional_cell(speed_up_of(view, r.level, r.at)); }}},
        rows);
    if (!view.answer.conditioned) return t;
    if (view.answer.conditioned->exact())
        t.notes = {fmt::format("P = F(μ*) of each of {} motions: no friction is drawn. {:.3g} processor seconds.",
                               view.answer.conditioned->motions, view.answer.conditioned->rigid_seconds)};
    else
        t.notes = {"Friction is drawn only where the rigid block, corrected by a pilot, does not know whether the dam "
                   "slides too far; standard error "
                   "by the replicates.",
                   pilot_sentence(view),
                   "speed-up: variance of plain Monte Carlo for the same processor seconds, all of the above in it, "
                   "over that of this estimate."};
    t.notes.push_back(fmt::format("p_static = {:.4g}: share of the draws that do not stand without an earthquake.",
                                  view.answer.estimate.p_static));
    return t;
}

Table cause_table(const FragilityView& view)
{
    struct Row {
        std::string variable;
        const probability::TornadoBar* bar;
        const probability::SobolIndex* index;
        const probability::Estimated* shapley;
    };
    std::vector<Row> rows;
    if (view.answer.causes)
        for (const probability::TornadoBar& bar : view.answer.causes->bars) {
            Row row{bar.variable, &bar, nullptr, nullptr};
            for (std::size_t v = 0; v < view.plan.variables().size(); ++v) {
                if (view.plan.variables()[v].name != bar.variable) continue;
                if (view.answer.causes->shares) row.index = &view.answer.causes->shares->variables[v];
                if (view.answer.causes->shapley) row.shapley = &view.answer.causes->shapley->shares[v];
            }
            rows.push_back(row);
        }
    const auto index = [](auto get) { return [=](const Row& r) { return r.index ? Cell(get(*r.index)) : Cell(); }; };
    using I = probability::SobolIndex;
    const auto shapley = [](auto get) {
        return [=](const Row& r) { return r.shapley ? Cell(get(*r.shapley)) : Cell(); };
    };
    using S = probability::Estimated;
    std::vector<ColumnOf<Row>> columns = {
        {{"variable", "variable"}, &Row::variable},
        {{"at", "at"}, [](const Row& r) { return fmt::format("{}", fmt::join(r.bar->at, ", ")); }},
        {{"probability", "P there"}, [](const Row& r) { return fmt::format("{:.3g}", fmt::join(r.bar->y, ", ")); }},
        {{"swing", "swing", "–", 3}, [](const Row& r) { return r.bar->swing(); }}};
    const std::vector<ColumnOf<Row>> of_sobol = {
        {{"first", "share alone", "–", 3}, index([](const I& i) { return i.first.value; })},
        {{"first_lower", "2.5 %", "–", 3}, index([](const I& i) { return i.first.lower; })},
        {{"first_upper", "97.5 %", "–", 3}, index([](const I& i) { return i.first.upper; })},
        {{"total", "share in all", "–", 3}, index([](const I& i) { return i.total.value; })},
        {{"total_lower", "2.5 %", "–", 3}, index([](const I& i) { return i.total.lower; })},
        {{"total_upper", "97.5 %", "–", 3}, index([](const I& i) { return i.total.upper; })}};
    const std::vector<ColumnOf<Row>> of_shapley = {
        {{"shapley", "share (Shapley)", "–", 3}, shapley([](const S& s) { return s.value; })},
        {{"shapley_lower", "2.5 %", "–", 3}, shapley([](const S& s) { return s.lower; })},
        {{"shapley_upper", "97.5 %", "–", 3}, shapley([](const S& s) { return s.upper; })}};
    const bool correlated = view.answer.causes && view.answer.causes->shapley;
    for (const ColumnOf<Row>& column : correlated ? of_shapley : of_sobol) columns.push_back(column);
    Table t = table_of<Row>("What P comes from", columns, rows);
    if (view.answer.causes) {
        t.notes = {fmt::format("P({}) at {:.4g} {} by the rigid block under the whole suite; others at their medians.",
                               view.answer.causes->limit.text,
                               view.plan.input.intensity.levels[view.answer.causes->level] / view.unit(),
                               view.unit_text()),
                   correlated ? "share: of the variance of P (Shapley) among correlated variables; they sum up to 1."
                              : "share: of the variance of P (Sobol'), alone and with all others."};
        if (!view.answer.causes->shares && !correlated)
            t.notes.push_back(fmt::format("No shares: P does not vary, or there are more than {} correlated variables.",
                                          most_shapley));
    }
    return t;
}

Table needed_yield_table(const FragilityView& view)
{
    struct Row {
        std::string limit;
        NeededYield yield;
    };
    std::vector<Row> rows;
    for (const auto& [limit, yields] : view.answer.needed_yields)
        for (const NeededYield& yield : yields) rows.push_back({limit.text, yield});
    return table_of<Row>("Yield acceleration that the limit needs, one-way rigid block",
                         {{{"limit", "limit"}, &Row::limit},
                          {intensity_column(view), [&](const Row& r) { return r.yield.x / view.unit(); }},
                          {{"k_16", "16 %", "g"}, [](const Row& r) { return r.yield.k16; }},
                          {{"k_50", "median", "g"}, [](const Row& r) { return r.yield.k50; }},
                          {{"k_84", "84 %", "g"}, [](const Row& r) { return r.yield.k84; }}},
                         rows);
}

} // namespace damslip::pages
