#include "pages/scene/scene_pages.hpp"

#include "core/units.hpp"
#include "scene/uplift_models.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace damslip::pages {

using sliding::Check;
using sliding::CrackStatus;
using sliding::Equilibrium;
using sliding::Force;
using sliding::Load;
using sliding::ResultantZone;
using sliding::UpliftComparison;
using sliding::Verdict;
using sliding::word;

namespace {

constexpr double kilo = 1e3; // 1 kN = 1000 N

/// Of a base that takes no tension: what has become of its joint.
Cell joint(const Equilibrium& e)
{
    if (e.crack_rule == CrackRule::none) return {};
    if (e.base.status == CrackStatus::closed && e.base.crack.length > 0.0) return "cracked, closed again";
    return word(e.base.status);
}

const std::vector<ColumnOf<Equilibrium>>& equilibrium_columns()
{
    using E = Equilibrium;
    using units::kPa;
    using units::standard_gravity;
    static const std::vector<ColumnOf<E>> all{
        {{"combination", "combination"}, &E::name},
        {{"kind", "kind"}, [](const E& e) { return word(e.kind); }},
        {{"crack_rule", "crack rule"}, [](const E& e) { return word(e.crack_rule); }},
        {{"follows", "follows"}, [](const E& e) { return e.follows.empty() ? Cell() : Cell(e.follows); }},
        {{"reservoir_level_m", "reservoir", "m", 4}, &E::reservoir_level},
        {{"tailwater_level_m", "tailwater", "m", 4}, &E::tailwater_level},
        {{"k_h", "k_h", "–", 3}, &E::k_h},
        {{"k_h_of_pga", "k_h / PGA", "–", 3}, &E::of_pga},
        {{"k_v", "k_v", "–", 3}, &E::k_v},
        {{"normal_force_effective_kN_per_m", "N'", "kN/m", 5},
         [](const E& e) { return e.base.effective_normal / kilo; }},
        {{"shear_force_kN_per_m", "T", "kN/m", 5}, &E::shear, kilo},
        {{"uplift_kN_per_m", "U", "kN/m", 5}, [](const E& e) { return e.base.uplift.force / kilo; }},
        {{"sliding_factor", "FS sliding", "–", 4}, &E::sliding_factor},
        {{"sliding_factor_friction_only", "FS sliding, friction only", "–", 4}, &E::friction_factor},
        {{"sliding_factor_residual", "FS sliding, residual", "–", 4}, &E::sliding_factor_residual},
        {{"overturning_factor", "FS overturning", "–", 4}, &E::overturning_factor},
        {{"flotation_factor", "FS flotation", "–", 4}, &E::flotation_factor},
        {{"resultant_from_toe_m", "resultant from toe", "m", 4}, &E::resultant_from_toe},
        {{"eccentricity_m", "eccentricity", "m", 4}, &E::eccentricity},
        {{"resultant_zone", "zone"},
         [](const E& e) { return e.zone == ResultantZone::base ? "within base" : word(e.zone); }},
        {{"heel_stress_kPa", "heel stress", "kPa", 4}, &E::heel_stress, kPa},
        {{"toe_stress_kPa", "toe stress", "kPa", 4}, &E::toe_stress, kPa},
        {{"joint", "joint"}, joint},
        {{"crack_m", "crack", "m", 4}, [](const E& e) { return e.base.crack.length; }},
        {{"compressed_length_m", "compressed length", "m", 4}, [](const E& e) { return e.base.compressed_length; }},
        {{"cohesive_length_m", "bonded length", "m", 4}, &E::cohesive_length},
        {{"critical_friction", "critical μ", "–", 4}, &E::critical_friction},
        {{"yield_acceleration_m_s2", "a_y", "m/s²", 5}, &E::yield_acceleration},
        {{"yield_coefficient_g", "a_y", "g", 4}, &E::yield_acceleration, standard_gravity},
        {{"yield_acceleration_upstream_m_s2", "a_y upstream", "m/s²", 5}, &E::yield_acceleration_upstream},
        {{"tipping_acceleration_m_s2", "tipping", "m/s²", 4}, &E::tipping_acceleration}};
    return all;
}

} // namespace

Table load_table(const Equilibrium& e)
{
    struct Row {
        std::string name;
        Force force;
    };
    std::vector<Row> rows;
    for (const Load& load : e.loads) rows.push_back({load.name, load.force.total()});
    rows.push_back({"sum without uplift", e.load});
    const double u = e.base.uplift.force;
    const Force uplift{u * e.frame.n.x, u * e.frame.n.y, e.base.uplift.moment_about_heel};
    rows.push_back({"uplift", uplift});
    rows.push_back({"sum", e.load + uplift});
    return table_of<Row>(
        "Loads: " + e.name,
        {{{"load", "load"}, &Row::name},
         {{"force_x_kN_per_m", "horizontal, downstream", "kN/m", 6}, [](const Row& r) { return r.force.x / kilo; }},
         {{"force_y_kN_per_m", "vertical, up", "kN/m", 6}, [](const Row& r) { return r.force.y / kilo; }},
         {{"moment_about_heel_kNm_per_m", "moment about the heel", "kNm/m", 6},
          [](const Row& r) { return r.force.moment / kilo; }}},
        rows, {"Moments are counter-clockwise: a downstream thrust above the heel is negative."});
}

Table equilibrium_table(const std::vector<Equilibrium>& all)
{
    std::vector<ColumnOf<Equilibrium>> columns = equilibrium_columns();
    if (std::ranges::any_of(all, [](const Equilibrium& e) { return e.anchor_force + e.dowel_force > 0.0; }))
        columns.insert(columns.end(),
                       {{{"anchor_force_kN_per_m", "N of anchors", "kN/m", 5}, &Equilibrium::anchor_force, kilo},
                        {{"dowel_force_kN_per_m", "dowels", "kN/m", 5}, &Equilibrium::dowel_force, kilo}});
    Table table = table_of("Limit equilibrium", columns, all);
    if (std::ranges::any_of(all, [](const Equilibrium& e) { return e.critical_friction == 0.0 && e.cohesion > 0.0; }))
        table.notes.push_back("critical μ 0: cohesion alone suffices.");
    for (const Equilibrium& e : all)
        for (const Note& note : e.notes)
            table.notes.push_back(e.name + " (crack rule " + word(e.crack_rule) + "): " + text_of(note) + ".");
    return table;
}

std::string unmet_words(double value, double required)
{
    const auto text = [](double x, int digits) {
        std::string s = fmt::format("{:.{}g}", x, digits);
        return s.find_first_of(".en") == std::string::npos ? s + ".0" : s;
    };
    int digits = 3;
    while (digits < 9 && text(value, digits) == text(required, digits)) ++digits;
    return fmt::format("{} {} {}", text(value, digits), value < required ? "<" : ">", text(required, digits));
}

std::string failed_checks(const std::vector<Equilibrium>& all)
{
    std::string words;
    for (const Equilibrium& e : all)
        for (const Check& check : e.checks) {
            if (check.verdict != Verdict::fail) continue;
            const std::string what = check.quantity == "sliding, peak strength" ? ""
                                     : check.quantity == "sliding, residual strength"
                                         ? " residual"
                                         : " " + check.quantity.substr(0, check.quantity.find(','));
            words += fmt::format("{}{}{} {}", words.empty() ? "" : "; ", e.name, what,
                                 unmet_words(check.value, check.required.value_or(0.0)));
        }
    return words;
}

namespace {

/// Of what there is to what is required: 1 and more holds.
Cell ratio(const Check& check)
{
    if (!check.required || !std::isfinite(check.value)) return {};
    const bool distance = check.quantity.starts_with("resultant"); // at most
    if (distance) return check.value > 0.0 ? Cell(*check.required / check.value) : Cell();
    return *check.required > 0.0 ? Cell(check.value / *check.required) : Cell();
}

} // namespace

Table verdict_table(const std::vector<Equilibrium>& all)
{
    struct Row {
        const Equilibrium& of;
        const Check& check;
    };
    std::vector<Row> rows;
    for (const Equilibrium& e : all)
        for (const Check& check : e.checks) rows.push_back({e, check});
    return table_of<Row>("Verdicts",
                         {{{"combination", "combination"}, [](const Row& r) { return r.of.name; }},
                          {{"crack_rule", "crack rule"}, [](const Row& r) { return word(r.of.crack_rule); }},
                          {{"check", "check"}, [](const Row& r) { return r.check.quantity; }},
                          {{"value", "value", "–", 4}, [](const Row& r) { return r.check.value; }},
                          {{"required", "required", "–", 4}, [](const Row& r) { return r.check.required; }},
                          {{"ratio", "ratio", "–", 4}, [](const Row& r) { return ratio(r.check); }},
                          {{"verdict", "verdict"}, [](const Row& r) { return word(r.check.verdict); }},
                          {{"source", "source"}, [](const Row& r) { return r.check.source; }}},
                         rows);
}

Table check_matrix(const std::vector<Equilibrium>& all)
{
    using E = const Equilibrium*;
    std::vector<E> judged;
    std::vector<std::string> quantities, sources; ///< in the order in which they come
    const auto add_new = [](std::vector<std::string>& list, const std::string& word) {
        if (std::ranges::find(list, word) == list.end()) list.push_back(word);
    };
    for (const Equilibrium& e : all)
        for (const Check& check : e.checks) {
            if (check.verdict == Verdict::no_criterion) continue;
            if (judged.empty() || judged.back() != &e) judged.push_back(&e);
            add_new(quantities, check.quantity);
            if (!check.source.empty()) add_new(sources, check.source);
        }
    std::vector<ColumnOf<E>> columns{{{"combination", "combination"}, [](E e) { return e->name; }},
                                     {{"crack_rule", "crack rule"}, [](E e) { return word(e->crack_rule); }}};
    for (const std::string& quantity : quantities)
        columns.push_back({{"check", quantity}, [=](E e) -> Cell {
                               const auto check = std::ranges::find_if(
                                   e->checks, [&](const Check& c) { return c.quantity == quantity; });
                               if (check == e->checks.end() || check->verdict == Verdict::no_criterion) return {};
                               const std::string value =
                                   std::isinf(check->value) ? "∞" : fmt::format("{:.4g}", check->value);
                               return fmt::format("{} {} / {:.4g}", word(check->verdict), value, *check->required);
                           }});
    Table table = table_of<E>("Load combinations: value / required", columns, judged);
    if (quantities.empty()) return table;
    table.notes.push_back(
        "Factors are to be at least what is required, the resultant's distance at most; –: no criterion.");
    std::string by;
    for (const std::string& source : sources) by += (by.empty() ? "Required by: " : "; ") + source;
    if (!by.empty()) table.notes.push_back(by + ".");
    return table;
}

Table uplift_comparison_table(const std::vector<UpliftComparison>& all)
{
    using U = UpliftComparison;
    const auto from_heel = [](const U& u) {
        return u.uplift.force > 0.0 ? Cell(u.uplift.moment_about_heel / u.uplift.force) : Cell();
    };
    return table_of<U>("Uplift models, no crack",
                       {{{"uplift_model", "model"}, [](const U& u) { return word(u.model); }},
                        {{"uplift_kN_per_m", "U", "kN/m", 6}, [](const U& u) { return u.uplift.force / kilo; }},
                        {{"uplift_from_heel_m", "acts from the heel", "m", 4}, from_heel},
                        {{"critical_friction", "critical μ", "–", 4}, &U::critical_friction}},
                       all);
}

} // namespace damslip::pages
