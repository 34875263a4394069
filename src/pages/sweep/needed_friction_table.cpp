#include "pages/sweep/needed_friction_table.hpp"

#include "analysis/prepare/records.hpp"
#include "core/units.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace damslip::pages {

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
        {{"method", "method"}, &N::method},
        {{"friction", "friction", "–", 4}, [](const N& n) { return optional_cell(n.friction()); }},
        {{"friction_low", "slips more at", "–", 4}, [](const N& n) { return optional_cell(n.more); }},
        {{"friction_high", "holds from", "–", 4}, [](const N& n) { return optional_cell(n.holds); }},
        {{"friction_error", "±", "–", 2},
         [](const N& n) {
             return n.friction() ? Cell(std::max(*n.friction() - *n.more, *n.holds - *n.friction())) : Cell();
         }},
        {{"record", "governed by"}, &N::record},
        {{"polarity", "polarity"}, [](const N& n) { return n.polarity ? count_cell(*n.polarity) : Cell(); }}};
    if (view.variants.size() > 1) columns.insert(columns.begin(), {{"variant", "variant"}, &N::variant});
    return table_of(
        fmt::format("Friction for a slip of {:.4g} mm at most{}", allowable.value_or(0.0) / units::mm,
                    list.empty() ? "" : ", " + polarity_words(view.polarities)),
        columns, list,
        {"all motions together: at \"holds from\" and every friction of the grid above it the largest slip, with its "
         "error where it has one, is no more. friction: between the two, the slip taken as linear in it; ±: to the "
         "farther of the two. Nothing in \"slips more at\": the lowest friction of the grid holds already; nothing in "
         "\"holds from\": the highest does not."});
}

} // namespace damslip::pages
