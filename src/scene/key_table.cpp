#include "scene/key_table.hpp"

#include "core/text.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <numbers>
#include <set>

namespace damslip {

namespace {

/// A number as digits times a power of ten.
struct Decimal {
    std::uint64_t digits = 0;
    int exponent = 0;
};

/// Of the shortest text that reads back as the number. @pre value >= 0, finite
Decimal decimal_of(double value)
{
    Decimal d;
    const std::string text = shortest(value);
    const std::size_t e = std::min(text.find('e'), text.size());
    bool after_point = false;
    for (std::size_t i = 0; i < e; ++i) {
        if (text[i] == '.') {
            after_point = true;
            continue;
        }
        d.digits = 10 * d.digits + std::uint64_t(text[i] - '0');
        d.exponent -= after_point;
    }
    if (e < text.size()) d.exponent += std::stoi(text.substr(e + 1));
    for (; d.digits > 0 && d.digits % 10 == 0; d.digits /= 10) ++d.exponent;
    return d;
}

} // namespace

double to_si(double written, const UnitSuffix& unit)
{
    if (unit.tangent)
        return static_cast<double>(std::tan(static_cast<long double>(written) * std::numbers::pi_v<long double> / 180));
    if (unit.factor == 1.0 || !std::isfinite(written)) return written * unit.factor;
    const Decimal a = decimal_of(std::abs(written)), b = decimal_of(unit.factor);
    constexpr std::uint64_t few = 1'000'000; // digits of a unit that is defined by a decimal: 980665, 3048
    if (b.digits >= few) return written * unit.factor;
    // The product's digits, in two parts that a 64-bit number holds each.
    const std::uint64_t low = a.digits % few * b.digits, high = a.digits / few * b.digits + low / few;
    const auto product = parse_number(fmt::format("{}{:06}e{}", high, low % few, a.exponent + b.exponent));
    return std::copysign(product.value_or(HUGE_VAL), written);
}

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

std::string Key::canonical() const
{
    return units.empty() ? name : spelled(units.front());
}

std::vector<std::string> Key::spellings() const
{
    if (units.empty()) return {name};
    std::vector<std::string> names;
    for (const UnitSuffix& unit : units) names.push_back(spelled(unit));
    return names;
}

std::string list_of(const KeyGroup& group)
{
    return group.inside ? group.name.substr(0, group.name.find('.')) : group.name;
}

bool belongs_to_wedge(const std::string& group)
{
    static const std::set<std::string> tables{
        "",       "project",       "site",    "wedge",       "wedge.plane",        "wedge.force",
        "motion", "motion.record", "sliding", "regressions", "regressions.weight", "criteria"};
    return tables.contains(group);
}

} // namespace damslip

namespace damslip::keys {

Key number(std::string name, Units units, Range range, std::string default_text, std::string meaning,
           std::string example, Value value)
{
    Key key = word(std::move(name), std::move(default_text), std::move(meaning), std::move(example), std::move(value));
    key.units = std::move(units);
    key.range = range;
    return key;
}

Key word(std::string name, std::string default_text, std::string meaning, std::string example, Value value)
{
    const bool required = default_text == "required";
    return {std::move(name), {}, {}, {}, required, std::move(default_text), std::move(meaning), std::move(example),
            std::move(value)};
}

Key pairs(std::string name, Units first, Units second, Range range, std::string default_text, std::string meaning,
          std::string example, Value value)
{
    Key key = number(std::move(name), std::move(first), range, std::move(default_text), std::move(meaning),
                     std::move(example), std::move(value));
    key.second_units = std::move(second);
    return key;
}

} // namespace damslip::keys
