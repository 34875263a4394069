#include "scene/key_table.hpp"

#include <set>

#include "core/number.hpp"

#include <cmath>

namespace damslip {

bool Range::contains(double x) const
{
    if (!std::isfinite(x)) return false;
    return (low_open ? x > low : x >= low) && (high_open ? x < high : x <= high);
}

std::string Range::text() const
{
    const bool bounded_low = std::isfinite(low), bounded_high = std::isfinite(high);
    if (!bounded_low && !bounded_high) return "any number";
    if (!bounded_high) return (low_open ? "> " : ">= ") + shortest(low);
    if (!bounded_low) return (high_open ? "< " : "<= ") + shortest(high);
    return (low_open ? "above " : "") + shortest(low) + " ... " + (high_open ? "below " : "") + shortest(high);
}

bool Usual::contains(double x) const
{
    if (or_zero && x == 0.0) return true;
    return x >= low - 1e-9 * std::abs(low) && x <= high + 1e-9 * std::abs(high);
}

namespace {
std::string spelled(const std::string& name, const UnitSuffix& unit)
{
    return unit.suffix.empty() ? name : name + "_" + unit.suffix;
}
} // namespace

std::string Key::canonical() const
{
    return units.empty() ? name : spelled(name, units.front());
}

std::vector<std::string> Key::spellings() const
{
    if (units.empty()) return {name};
    std::vector<std::string> names;
    for (const UnitSuffix& unit : units) names.push_back(spelled(name, unit));
    return names;
}

bool belongs_to_wedge(const std::string& group)
{
    static const std::set<std::string> tables{
        "",       "project",       "site",    "wedge",       "wedge.plane",        "wedge.force",
        "motion", "motion.record", "sliding", "regressions", "regressions.weight", "criteria"};
    return tables.contains(group);
}

} // namespace damslip
