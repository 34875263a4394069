#include "records/read/unit.hpp"

#include "core/number.hpp"
#include "core/units.hpp"
#include "records/read/record_text.hpp"

#include <array>
#include <string>

namespace damslip::records {

namespace {

constexpr std::array<AccelerationUnit, 11> table{{{"g", units::standard_gravity},
                                                  {"m/s2", 1.0},
                                                  {"cm/s2", 0.01},
                                                  {"gal", units::gal},
                                                  {"mg", 0.001 * units::standard_gravity},
                                                  {"mm/s2", 0.001},
                                                  // Of agency files only:
                                                  {"g/10", 0.1 * units::standard_gravity},
                                                  {"in/s2", 0.0254},
                                                  {"micro-g", 1e-6 * units::standard_gravity},
                                                  {"%g", 0.01 * units::standard_gravity},
                                                  {"ft/s2", 0.3048}}};

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
    for (const std::string_view per : {" s-2", "*s-2", ".s-2", "ms-2"})
        replace_all(s, per, per == "ms-2" ? "m/s2" : "/s2");
    replace_all(s, "/s/s", "/s2");
    replace_all(s, "_s2", "/s2");
    replace_all(s, "/ss", "/s2");
    replace_all(s, " ", "");
    for (const AccelerationUnit& unit : table)
        if (s == unit.name) return unit;
    if (s == "g's") return table[0];
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

std::optional<std::string> unit_in_words(std::string_view line)
{
    static constexpr std::array<std::string_view, 11> keys{"sec and ", "seconds and ", "accel is ",  "acceleration is ",
                                                           "units:",   "units=",       "units are ", "units of ",
                                                           " in ",     "peak ",        "("};
    const std::string s = lower(line.substr(0, 160));
    std::optional<std::string> first;
    for (const std::string_view key : keys) {
        const std::size_t at = s.find(key);
        if (at == std::string::npos) continue;
        std::string_view rest = trimmed(std::string_view(s).substr(at + key.size()));
        std::size_t used = 0;
        if (parse_number(rest, &used)) rest = trimmed(rest.substr(used)); // "units of 1.00 mm/s/s"
        std::string word(rest.substr(0, rest.find_first_of(" ,;()\t")));
        while (!word.empty() && word.back() == '.') word.pop_back();
        if (acceleration_unit(word)) return word;
        if (!first && !word.empty() && key != "(" && key != "peak ") first = word;
    }
    return first;
}

} // namespace damslip::records
