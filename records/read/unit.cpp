#include "records/read/unit.hpp"

#include "core/units.hpp"
#include "records/read/record_text.hpp"

#include <array>
#include <string>

namespace damslip::records {

namespace {

constexpr std::array<AccelerationUnit, 9> table{{{"g", units::standard_gravity},
                                                 {"m/s2", 1.0},
                                                 {"cm/s2", 0.01},
                                                 {"gal", units::gal},
                                                 {"mg", 0.001 * units::standard_gravity},
                                                 {"mm/s2", 0.001},
                                                 // Of agency files only:
                                                 {"g/10", 0.1 * units::standard_gravity},
                                                 {"in/s2", 0.0254},
                                                 {"micro-g", 1e-6 * units::standard_gravity}}};

void replace_all(std::string& s, std::string_view from, std::string_view to)
{
    for (std::size_t at = 0; (at = s.find(from, at)) != std::string::npos; at += to.size())
        s.replace(at, from.size(), to);
}

} // namespace

std::optional<AccelerationUnit> acceleration_unit(std::string_view text)
{
    if (text.size() > 24) return std::nullopt;
    std::string s = lower(trimmed(text));
    // One spelling: "m/sec/sec", "m/s^2", "m/s**2", "m_s2", "m s-2", "m/s²" -> "m/s2".
    replace_all(s, "seconds", "s");
    replace_all(s, "sec", "s");
    replace_all(s, "\xc2\xb2", "2");
    replace_all(s, "**", "");
    replace_all(s, "^", "");
    replace_all(s, " s-2", "/s2");
    replace_all(s, "*s-2", "/s2");
    replace_all(s, "/s/s", "/s2");
    replace_all(s, "_s2", "/s2");
    replace_all(s, "/ss", "/s2");
    replace_all(s, " ", "");
    for (const AccelerationUnit& unit : table)
        if (s == unit.name) return unit;
    if (s == "gals") return table[3];
    if (s == "milli-g" || s == "millig") return table[4];
    return std::nullopt;
}

std::optional<std::string> take_unit(std::string& heading, const std::function<bool(std::string_view)>& known)
{
    const std::string_view whole = heading;
    const auto taken = [&](std::size_t name, std::size_t from, std::size_t length) {
        std::optional<std::string> unit(std::string(trimmed(whole.substr(from, length))));
        heading = std::string(trimmed(whole.substr(0, name)));
        return unit;
    };
    const std::size_t open = whole.find_last_of("[(");
    if (open != std::string_view::npos && (whole.back() == ']' || whole.back() == ')') &&
        known(whole.substr(open + 1, whole.size() - open - 2)))
        return taken(open, open + 1, whole.size() - open - 2);
    for (std::size_t at = whole.find_first_of("_ "); at != std::string_view::npos;
         at = whole.find_first_of("_ ", at + 1))
        if (known(whole.substr(at + 1))) return taken(at, at + 1, std::string_view::npos);
    return std::nullopt;
}

} // namespace damslip::records
