#include "pages/sweep/needed_friction_table.hpp"

#include "analysis/prepare/records.hpp"
#include "core/units.hpp"

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

struct Needed {
    std::string variant, method;
    std::optional<double> more;    ///< highest friction of the grid that slips more; none: all hold
    std::optional<double> holds;   ///< the next one; none: even the highest slips more
    std::optional<double> between; ///< where the slip, linear in friction between the two, is the allowable one
    std::string record;
    std::optional<int> polarity;
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

Needed needed_of(const std::vector<Worst>& list, double allowable)
{
    Needed needed;
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

Table needed_friction_table(const SweepView& view, const std::optional<double>& allowable)
{
    std::vector<Needed> rows;
    if (allowable && view.frictions.size() > 1)
        for (std::size_t v = 0; v < view.variants.size(); ++v)
            for (const std::string& method : view.methods) {
                const std::vector<Worst> list = worst_by_friction(view, v, method);
                if (list.size() < 2) continue;
                Needed needed = needed_of(list, *allowable);
                needed.variant = view.variant_names[v];
                needed.method = method;
                rows.push_back(std::move(needed));
            }
    const auto best = [](const Needed& n) { return n.between ? n.between : n.holds; };
    std::vector<ColumnOf<Needed>> columns{
        {{"method", "method"}, &Needed::method},
        {{"friction", "friction", "–", 4},
         [=](const Needed& n) { return n.more && n.holds ? optional_cell(best(n)) : Cell(); }},
        {{"friction_low", "slips more at", "–", 4}, [](const Needed& n) { return optional_cell(n.more); }},
        {{"friction_high", "holds from", "–", 4}, [](const Needed& n) { return optional_cell(n.holds); }},
        {{"friction_error", "±", "–", 2},
         [=](const Needed& n) {
             return n.more && n.holds ? Cell(std::max(*best(n) - *n.more, *n.holds - *best(n))) : Cell();
         }},
        {{"record", "governed by"}, &Needed::record},
        {{"polarity", "polarity"}, [](const Needed& n) { return n.polarity ? count_cell(*n.polarity) : Cell(); }}};
    if (view.variants.size() > 1) columns.insert(columns.begin(), {{"variant", "variant"}, &Needed::variant});
    Table table = table_of(fmt::format("Friction for a slip of {:.4g} mm at most{}", allowable.value_or(0.0) / units::mm,
                                       rows.empty() ? "" : ", " + polarity_words(view.polarities)),
                           columns, rows);
    table.notes.push_back(
        "all motions together: at \"holds from\" and every friction of the grid above it the largest slip, with its "
        "error "
        "where it has one, is no more. friction: between the two, the slip taken as linear in it; ±: to "
        "the farther of the two. Nothing in \"slips more at\": the lowest friction of the grid holds already; "
        "nothing in \"holds from\": the highest does not.");
    return table;
}

} // namespace damslip::pages
