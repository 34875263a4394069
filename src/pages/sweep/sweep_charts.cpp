#include "pages/sweep/sweep_pages.hpp"

#include "analysis/prepare/records.hpp"
#include "analysis/screen/screening.hpp"
#include "core/statistics.hpp"
#include "core/units.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <tuple>

namespace damslip::pages {

namespace {

using units::mm;
constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t named_variants = 8;
constexpr std::size_t drawn_points = 6000; ///< of a scatter chart in all

Axis slip_axis(const std::string& label)
{
    return {label, "mm", Scale::asinh};
}

/// The worse polarity's slip [mm] of each record that has one.
std::vector<double> slips_of(const SweepView& view, std::size_t variant, const std::string& method, double friction)
{
    std::map<std::string_view, double> worst;
    for (const std::size_t i : view.group(variant, method, friction)) {
        const SweepRow& r = view.rows[i];
        if (!r.slip) continue;
        const auto [at, first] = worst.try_emplace(r.record, std::abs(*r.slip) / mm);
        if (!first) at->second = std::max(at->second, std::abs(*r.slip) / mm);
    }
    std::vector<double> slips;
    for (const auto& [record, slip] : worst) slips.push_back(slip);
    return slips;
}

bool many_records(const SweepView& view)
{
    return view.records.size() > 3;
}

enum class Band { none, least_to_largest };

Curve slip_curve(const SweepView& view, std::size_t variant, const std::string& method, const std::string& name,
                 Band band)
{
    Curve curve{.name = name, .mark = Mark::line_and_points};
    for (const double friction : view.frictions) {
        const std::vector<double> slips = slips_of(view, variant, method, friction);
        curve.add(friction, slips.empty() ? nothing : percentile(slips, many_records(view) ? 0.5 : 1.0));
        if (band == Band::none) continue;
        curve.low.push_back(slips.empty() ? nothing : std::ranges::min(slips));
        curve.high.push_back(slips.empty() ? nothing : std::ranges::max(slips));
    }
    return curve;
}

bool has_value(const Curve& curve)
{
    return std::ranges::any_of(curve.y, [](double v) { return std::isfinite(v); });
}

/// Critical friction of a variant; that of FE runs and of the block is the same but for round-off, as statics alone decide.
std::optional<double> critical_of(const SweepView& view, std::size_t variant)
{
    for (const SweepRow& r : view.rows)
        if (r.variant == variant && r.critical_friction) return r.critical_friction;
    return std::nullopt;
}

Chart empty_chart(const SweepView& view, const std::string& title, const std::optional<double>& allowable)
{
    Chart chart{title, {"friction μ"}, slip_axis("largest slip")};
    if (view.records.size() > 1)
        chart.note = many_records(view) ? fmt::format("Median of {} records.", view.records.size())
                                        : fmt::format("The largest of {} records.", view.records.size());
    if (allowable) chart.horizontal.push_back({*allowable / mm, "allowable"});
    return chart;
}

/// Line at the critical friction where it lies among the frictions, so that some of them fail.
void mark_critical(Chart& chart, const SweepView& view, double critical)
{
    if (!(critical > view.frictions.front()) || critical > view.frictions.back() + 0.25) return;
    chart.vertical.push_back({critical, fmt::format("slides statically below {:.4g}", critical)});
    chart.x.low = view.frictions.front();
    chart.x.high = std::max(view.frictions.back(), critical);
}

/// Logarithmic where no slip is near zero: more room for the curves.
void fit_scale(Chart& chart)
{
    double least = std::numeric_limits<double>::infinity();
    for (const Curve& curve : chart.curves)
        for (const std::vector<double>* values : {&curve.y, &curve.low})
            for (const double v : *values)
                if (std::isfinite(v)) least = std::min(least, v);
    if (least > 0.1) chart.y.scale = Scale::log;
}

std::string with_name(const std::string& title, const std::string& name)
{
    return name.empty() ? title : title + ": " + name;
}

/// Points in ascending order of x, thinned evenly to a share of what a scatter chart may hold.
Curve points(const std::string& name, std::vector<std::pair<double, double>> values, std::size_t curves)
{
    std::ranges::sort(values);
    const std::size_t largest = std::max<std::size_t>(200, drawn_points / std::max<std::size_t>(1, curves)),
                      every = (values.size() + largest - 1) / std::max<std::size_t>(1, largest);
    Curve curve{.name = name, .mark = Mark::points};
    for (std::size_t i = 0; i < values.size(); i += std::max<std::size_t>(1, every)) {
        // Abscissae of a curve are distinct: a value at the same place moves by an invisible amount.
        const double x = values[i].first;
        const bool taken = !curve.x.empty() && x <= curve.x.back();
        curve.add(taken ? std::nextafter(curve.x.back(), 1e300) : x, values[i].second);
    }
    return curve;
}

} // namespace

Curve history_curve(const std::string& name, const SlipHistory& history)
{
    Curve curve{name};
    for (std::size_t k = 0; k < history.slip.size(); ++k)
        curve.add(static_cast<double>(k) * history.interval, history.slip[k] / mm);
    return curve;
}

std::string main_method(const SweepView& view)
{
    const auto find = [&](auto&& wanted) { return std::ranges::find_if(view.methods, wanted); };
    for (const auto& at : {find([](const std::string& method) { return method == "fe"; }), find(is_of_elements),
                           find([](const std::string& method) { return method == "rigid-v"; })})
        if (at != view.methods.end()) return *at;
    return view.methods.front();
}

Chart slip_over_friction(const SweepView& view, std::size_t variant, const std::optional<double>& allowable)
{
    Chart chart = empty_chart(view, with_name("Slip over friction", view.variant_names[variant]), allowable);
    const std::string banded = many_records(view) ? main_method(view) : "";
    for (const std::string& method : view.methods) {
        Curve curve = slip_curve(view, variant, method, method, method == banded ? Band::least_to_largest : Band::none);
        if (!has_value(curve)) continue;
        if (is_of_elements(method)) curve.weight = Weight::strong;
        chart.curves.push_back(std::move(curve));
    }
    if (!banded.empty()) chart.note += " Band of " + banded + ": from the least to the largest.";
    if (const auto critical = critical_of(view, variant)) mark_critical(chart, view, *critical);
    fit_scale(chart);
    return chart;
}

std::optional<Chart> slip_histories(const SweepView& view, std::size_t variant, const std::string& method,
                                    const std::vector<SlipHistory>& histories)
{
    std::vector<std::size_t> rows; // one for each friction that has a history
    for (const double friction : view.frictions) {
        const auto group = view.group(variant, method, friction);
        if (group.empty()) continue;
        const std::size_t first = group.front();
        if (view.rows[first].slip && histories[first].interval > 0.0) rows.push_back(first);
    }
    if (rows.empty()) return std::nullopt;
    const SweepRow& any = view.rows[rows.front()];
    Chart chart = time_chart(with_name("Slip over time by " + method, view.variant_names[variant]),
                             {"slip", "mm", Scale::asinh, 1.0});
    chart.note = fmt::format("Record {}{}.", any.record, any.polarity < 0 ? ", polarity -1" : "");
    const std::size_t every = (rows.size() + named_variants - 1) / named_variants;
    for (std::size_t i = 0; i < rows.size(); i += every)
        chart.curves.push_back(
            history_curve(fmt::format("μ = {:.4g}", view.rows[rows[i]].friction), histories[rows[i]]));
    return chart;
}

Chart slip_by_variant(const SweepView& view, const std::string& method, const std::optional<double>& allowable)
{
    Chart chart = empty_chart(view, "Slip over friction by " + method, allowable);
    for (std::size_t v = 0; v < view.variants.size() && chart.curves.size() < named_variants; ++v) {
        Curve curve = slip_curve(view, v, method, view.variant_names[v], Band::none);
        if (has_value(curve)) chart.curves.push_back(std::move(curve));
    }
    if (view.variants.size() > named_variants)
        chart.note +=
            fmt::format(" The first {} of {} variants that have values.", named_variants, view.variants.size());
    fit_scale(chart);
    return chart;
}

Chart slip_over_yield_ratio(const SweepView& view)
{
    Chart chart{"Slip over a_y/PGA", {"yield acceleration over PGA, a_y/PGA"}, slip_axis("largest slip")};
    chart.note = "a_y: of the rigid block, the same for all methods. Each point is a row.";
    for (const std::string& method : view.methods) {
        std::vector<std::pair<double, double>> values;
        for (const SweepRow& r : view.rows)
            if (r.method == method && r.slip && r.pga > 0.0)
                values.emplace_back(r.yield_acceleration / r.pga, std::abs(*r.slip) / mm);
        if (!values.empty()) chart.curves.push_back(points(method, std::move(values), view.methods.size()));
    }
    return chart;
}

std::optional<Chart> fe_over_rigid(const SweepView& view)
{
    if (!view.finite_elements()) return std::nullopt;
    using Key = std::tuple<std::size_t, double, int, std::string_view>;
    std::map<Key, double> rigid;
    const auto key = [](const SweepRow& r) { return Key{r.variant, r.friction, r.polarity, r.record}; };
    for (const std::string method : {"rigid", "rigid-v"}) // the latter, where there is one, has the same motion as FE
        for (const SweepRow& r : view.rows)
            if (r.method == method && r.slip) rigid[key(r)] = std::abs(*r.slip) / mm;
    Chart chart{"Slip by finite elements over the rigid block's", slip_axis("slip of the rigid block"),
                slip_axis("slip by finite elements")};
    double largest = 0.0;
    for (const std::string& method : view.methods) {
        std::vector<std::pair<double, double>> values;
        for (const SweepRow& r : view.rows) {
            if (r.method != method || !r.finite_elements() || !r.slip) continue;
            const auto at = rigid.find(key(r));
            if (at != rigid.end()) values.emplace_back(at->second, std::abs(*r.slip) / mm);
        }
        for (const auto& [x, y] : values) largest = std::max({largest, x, y});
        if (!values.empty()) chart.curves.push_back(points(method, std::move(values), view.methods.size()));
    }
    if (chart.curves.empty()) return std::nullopt;
    Curve equal{.name = "equal", .mark = Mark::dashed, .colour = 7};
    for (int i = 0; i <= 40; ++i) { // straight on equal asinh scales
        const double v = 0.1 * std::sinh(std::asinh(std::max(largest, 1.0) / 0.1) * i / 40.0);
        equal.add(v, v);
    }
    chart.curves.push_back(std::move(equal));
    chart.note = "Each point is a motion with a friction. Above the dashed line the flexible dam slides farther.";
    return chart;
}

Chart yield_over_friction(const SweepView& view)
{
    Chart chart{"Yield acceleration over friction", {"friction μ"}, {"yield acceleration a_y", "m/s²"}};
    chart.horizontal.push_back({0.0, "slides statically below"});
    for (std::size_t v = 0; v < view.variants.size() && chart.curves.size() < named_variants; ++v) {
        Curve curve{.name = view.variant_names[v].empty() ? "a_y" : view.variant_names[v],
                    .mark = Mark::line_and_points};
        std::map<double, double> yield;
        for (const SweepRow& r : view.rows)
            if (r.variant == v) yield[r.friction] = r.yield_acceleration;
        for (const auto& [friction, a_y] : yield) curve.add(friction, a_y);
        // Variants of the motion only have the same yield acceleration.
        if (std::ranges::find(chart.curves, curve.y, &Curve::y) == chart.curves.end())
            chart.curves.push_back(std::move(curve));
    }
    return chart;
}

namespace {

/// The motion that slips most at one friction.
struct Worst {
    double friction = 0.0;
    double slip = 0.0; ///< with its error; infinite: no slip or no answer [m]
    std::string record;
    int polarity = 1;
};

double counted_slip(const SweepRow& row)
{
    if (row.slip) return std::abs(*row.slip) + row.error.value_or(0.0);
    return std::numeric_limits<double>::infinity();
}

/// A row that says nothing of the slip: a method that does not apply, such as a regression outside its data.
bool says_nothing(const SweepRow& row)
{
    return !row.slip && !row.state;
}

/// By ascending friction; empty where the method says nothing.
std::vector<Worst> worst_by_friction(const SweepView& view, std::size_t variant, const std::string& method)
{
    std::vector<Worst> list;
    for (const double friction : view.frictions) {
        const auto group = view.group(variant, method, friction);
        if (group.empty()) continue;
        Worst worst{friction, -1.0, "", 1};
        for (const std::size_t i : group) {
            const SweepRow& row = view.rows[i];
            if (says_nothing(row) || counted_slip(row) <= worst.slip) continue;
            worst = {friction, counted_slip(row), std::string(row.record), row.polarity};
        }
        if (worst.slip >= 0.0) list.push_back(worst);
    }
    return list;
}

NeededFriction needed_of(const std::vector<Worst>& list, double allowable)
{
    NeededFriction needed;
    for (std::size_t i = list.size(); i-- > 0;) {
        if (list[i].slip <= allowable) {
            needed.holds = list[i].friction;
            continue;
        }
        needed.more = list[i].friction;
        needed.record = list[i].record;
        needed.polarity = list[i].polarity;
        if (i + 1 < list.size() && std::isfinite(list[i].slip)) {
            const Worst &a = list[i], &b = list[i + 1];
            needed.between = a.friction + (b.friction - a.friction) * (a.slip - allowable) / (a.slip - b.slip);
        }
        break;
    }
    return needed;
}

} // namespace

std::vector<NeededFriction> needed_frictions(const SweepView& view, const std::optional<double>& allowable)
{
    std::vector<NeededFriction> list;
    if (!allowable || view.frictions.size() < 2) return list;
    for (std::size_t v = 0; v < view.variants.size(); ++v)
        for (const std::string& method : view.methods) {
            const std::vector<Worst> worst = worst_by_friction(view, v, method);
            if (worst.size() < 2) continue;
            NeededFriction needed = needed_of(worst, *allowable);
            needed.variant = view.variant_names[v];
            needed.method = method;
            list.push_back(std::move(needed));
        }
    return list;
}

Table needed_friction_table(const SweepView& view, const std::optional<double>& allowable)
{
    using N = NeededFriction;
    const std::vector<N> list = needed_frictions(view, allowable);
    std::vector<ColumnOf<N>> columns{
        {in_brief({"method", "method"}), &N::method},
        {in_brief({"friction", "friction", "–", 4}), [](const N& n) { return n.friction(); }},
        {in_brief({"friction_low", "slips more at", "–", 4}), &N::more},
        {in_brief({"friction_high", "holds from", "–", 4}), &N::holds},
        {in_brief({"friction_error", "±", "–", 2}),
         [](const N& n) {
             return n.friction() ? Cell(std::max(*n.friction() - *n.more, *n.holds - *n.friction())) : Cell();
         }},
        {in_brief({"record", "governed by"}), &N::record},
        {in_brief({"polarity", "polarity"}), &N::polarity}};
    if (view.variants.size() > 1) columns.insert(columns.begin(), {in_brief({"variant", "variant"}), &N::variant});
    return table_of(
        fmt::format("Friction for a slip of {:.4g} mm at most{}", allowable.value_or(0.0) / units::mm,
                    list.empty() ? "" : ", " + polarity_words(view.polarities)),
        columns, list,
        {"all motions together: at \"holds from\" and every friction of the grid above it the largest slip, with its "
         "error where it has one, is no more. friction: between the two, the slip taken as linear in it; ±: to the "
         "farther of the two. Nothing in \"slips more at\": the lowest friction of the grid holds already; nothing in "
         "\"holds from\": the highest does not."});
}

namespace {

/// One motion, strength, variant and method under all rules.
struct RuleLine {
    const SweepRow& row;                    ///< under the first of them
    const SweepVariant& variant;            ///< of it
    /// By rule: slip [mm], or the word of a status without one.
    std::map<std::string, std::pair<std::optional<double>, std::string>> slips = {};

    /// Do both differ in the rule alone?
    bool beside(const RuleLine& other) const
    {
        SweepVariant same = variant;
        same.opening = other.variant.opening;
        return same == other.variant && row.friction == other.row.friction && row.polarity == other.row.polarity &&
               row.record == other.row.record && row.method == other.row.method;
    }
    Cell apart() const
    {
        double least = HUGE_VAL, most = -HUGE_VAL;
        for (const auto& [rule, found] : slips) {
            if (!found.first) return {};
            least = std::min(least, *found.first);
            most = std::max(most, *found.first);
        }
        return slips.size() > 1 ? Cell(most - least) : Cell();
    }
};

std::vector<RuleLine> rule_lines(const SweepView& view)
{
    std::vector<RuleLine> lines;
    for (const SweepRow& row : view.rows) {
        const RuleLine line{row, view.variants[row.variant]};
        const auto same = std::ranges::find_if(lines, [&](const RuleLine& l) { return l.beside(line); });
        RuleLine& target = same == lines.end() ? lines.emplace_back(line) : *same;
        target.slips[line.variant.opening] = {
            row.slip ? std::optional(std::abs(*row.slip) / mm) : std::nullopt, std::string(row.status)};
    }
    return lines;
}

/// Columns of what differs from line to line; friction and method always.
std::vector<ColumnOf<RuleLine>> place_columns(const SweepView& view)
{
    using L = RuleLine;
    std::vector<ColumnOf<L>> columns{
        {in_brief({"friction", "μ", "–", 4}), [](const L& l) { return l.row.friction; }}};
    const auto add = [&](Column column, auto SweepVariant::*member) {
        if (differ(view.variants, member))
            columns.push_back({in_brief(std::move(column)), [=](const L& l) { return l.variant.*member; }});
    };
    add({"level_m", "level", "m", 4}, &SweepVariant::level);
    add({"uplift", "uplift"}, &SweepVariant::uplift);
    add({"reservoir", "reservoir"}, &SweepVariant::reservoir);
    add({"size", "size", "–", 4}, &SweepVariant::size);
    add({"scale", "scale", "–", 4}, &SweepVariant::scale);
    if (view.polarities.size() > 1)
        columns.push_back({in_brief({"polarity", "polarity"}), [](const L& l) { return l.row.polarity; }});
    if (view.records.size() > 1)
        columns.push_back({in_brief({"record", "record"}), [](const L& l) { return l.row.record; }});
    columns.push_back({in_brief({"method", "method"}), [](const L& l) { return l.row.method; }});
    return columns;
}

} // namespace

std::optional<Table> opening_water_table(const SweepView& view)
{
    std::vector<std::string> rules;
    for (const SweepVariant& v : view.variants)
        if (!v.opening.empty() && std::ranges::find(rules, v.opening) == rules.end()) rules.push_back(v.opening);
    if (rules.size() < 2) return std::nullopt;
    std::vector<ColumnOf<RuleLine>> columns = place_columns(view);
    for (const std::string& rule : rules)
        columns.push_back({in_brief({rule + "_mm", rule, "mm", 4}), [rule](const RuleLine& l) {
                               const auto found = l.slips.find(rule);
                               if (found == l.slips.end()) return Cell();
                               const auto& [slip, status] = found->second;
                               return slip ? Cell(*slip) : Cell(status);
                           }});
    columns.push_back({ranking({"apart_mm", "apart", "mm", 3}), &RuleLine::apart});
    return table_of("What the rules for water in the opening base are worth", columns, rule_lines(view),
                    {"largest slip on the way under each rule of uplift.opening; apart: the largest less the smallest. "
                     "Rigid block: reynolds is taken as unchanged, for a block has no width of the joint; mouth is its "
                     "rule for water that needs time."});
}

} // namespace damslip::pages
