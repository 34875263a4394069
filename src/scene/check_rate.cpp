#include "scene/checks.hpp"

#include "core/number.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace damslip::checks {

void check_rate(const Contact& c, const std::string& table, Findings& f)
{
    const auto key = [&table](const char* name) { return table + "." + name; };
    if (c.rate.active() && !c.rate.characteristic_rate)
        f.wrong(key("kinetic_friction_ratio"),
                fmt::format("{} = {} without {}.", key("kinetic_friction_ratio"), shortest(c.rate.kinetic_ratio),
                            key("characteristic_rate_m_s")),
                "both: the rate v_c says how fast friction goes from mu to mu_k",
                "add  characteristic_rate_m_s = 0.01  , or delete kinetic_friction_ratio");
    if (c.rate.active()) return;
    for (const auto& [name, unit] : {std::pair("characteristic_rate", "_m_s"), std::pair("relaxation_time", "_s"),
                                     std::pair("relaxation_slip", "_m")})
        if (f.given(key(name)))
            f.wrong(
                key(name),
                fmt::format("{}{} is given, but {} is {}.", key(name), unit, key("kinetic_friction_ratio"),
                            f.given(key("kinetic_friction_ratio")) ? "1: friction does not depend on the rate" : "not"),
                "the keys of friction over the rate together, with a ratio that is not 1",
                fmt::format("add  kinetic_friction_ratio = 0.8  , or delete {}{}", name, unit));
}

void check_rate_methods(const Scene& s, Findings& f)
{
    const bool rate = s.contact.rate.active(), rebounds = s.contact.restitution > 0.0;
    if (s.sliding.scheme == SlidingScheme::slammer && (rate || rebounds))
        f.wrong("sliding.scheme",
                fmt::format("sliding.scheme = \"slammer\" with {} = {}.",
                            rate ? "contact.kinetic_friction_ratio" : "contact.restitution",
                            shortest(rate ? s.contact.rate.kinetic_ratio : s.contact.restitution)),
                "scheme = \"exact\": SLAMMER knows neither friction over the rate nor rebounds",
                "write  scheme = \"exact\"  in [sliding]");
    if (s.flexible_block && rate)
        f.wrong("contact.kinetic_friction_ratio",
                fmt::format("contact.kinetic_friction_ratio = {} with [flexible_block].",
                            shortest(s.contact.rate.kinetic_ratio)),
                "friction over the rate for the rigid block and finite elements",
                "delete [flexible_block], or the keys of friction over the rate");
    if (s.flexible_block && rebounds)
        f.wrong("contact.restitution",
                fmt::format("contact.restitution = {} with [flexible_block].", shortest(s.contact.restitution)),
                "rebounds for the rigid block and finite elements", "delete [flexible_block] or restitution");
}

} // namespace damslip::checks
