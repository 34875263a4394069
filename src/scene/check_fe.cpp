#include "scene/checks.hpp"

#include "core/number.hpp"
#include "scene/section.hpp"

#include <fmt/format.h>

namespace damslip::checks {

namespace {

const char* written(TimeScheme scheme)
{
    switch (scheme) {
    case TimeScheme::automatic:
        return "auto";
    case TimeScheme::hht:
        return "hht";
    case TimeScheme::newmark:
        return "newmark";
    case TimeScheme::central_difference:
        return "central-difference";
    case TimeScheme::modal:
        break;
    }
    return "modal";
}

/// Keys that belong to another scheme than the chosen one.
void check_scheme(const Scene& s, Findings& f)
{
    const TimeScheme scheme = s.time.scheme;
    const bool hht = scheme == TimeScheme::hht || scheme == TimeScheme::automatic;
    if (!hht && f.given("time.alpha"))
        f.wrong("time.alpha",
                fmt::format("time.alpha belongs to time.scheme = \"hht\", but the scheme is \"{}\".", written(scheme)),
                scheme == TimeScheme::newmark ? "gamma and beta for newmark" : "no alpha, gamma or beta",
                "delete alpha or choose hht");
    if (scheme != TimeScheme::newmark && (f.given("time.gamma") || f.given("time.beta")))
        f.wrong(f.given("time.gamma") ? "time.gamma" : "time.beta",
                hht ? std::string(
                          "time.gamma and time.beta belong to time.scheme = \"newmark\"; hht takes them from alpha.")
                    : fmt::format("time.gamma and time.beta belong to time.scheme = \"newmark\", but the scheme is "
                                  "\"{}\".",
                                  written(scheme)),
                hht ? "alpha for hht" : "no alpha, gamma or beta", "delete them or choose newmark");
    if (s.time.stepping == Stepping::adaptive && !hht && scheme != TimeScheme::newmark)
        f.wrong("time.stepping",
                fmt::format("time.stepping = \"adaptive\" with time.scheme = \"{}\".", written(scheme)),
                "adaptive steps of the implicit schemes hht and newmark", "delete stepping or choose hht");
}

} // namespace

void check_fe(const Scene& s, Findings& f)
{
    const Damping& d = s.damping;
    if (d.first_mode < 1 || d.second_mode <= d.first_mode || d.second_mode > 100)
        f.wrong("damping.second_mode",
                fmt::format("damping.first_mode = {} and damping.second_mode = {} are not allowed.", d.first_mode,
                            d.second_mode),
                "1 <= first_mode < second_mode <= 100", "write  first_mode = 1  and  second_mode = 5");
    if (d.mass_coefficient.has_value() != d.stiffness_coefficient.has_value())
        f.wrong("damping", "damping.mass_coefficient_1_s and damping.stiffness_coefficient_s are not both given.",
                "both or neither", "add the other, 0 if it is meant to be absent");
    const auto at_least = [&](const char* key, const std::optional<double>& size, double length, double most,
                              const char* of) {
        if (!size || *size * most >= length) return;
        f.wrong(key,
                fmt::format("{} makes {:.3g} elements along the {:.4g} m of {}.",
                            value((std::string(key) + "_m").c_str(), *size), length / *size, length, of),
                fmt::format("at most {:.0f} elements there: {} m or more", most, shortest(length / most)),
                "give a larger size, or leave it out");
    };
    at_least("mesh.size", s.mesh.size, crest_level(s.section) - heel(s.section).y, 1000.0, "the dam's height");
    at_least("mesh.contact_size", s.mesh.contact_size, base_length(s.section), 2000.0, "the base");
    at_least("mesh.rock_contact_size", s.mesh.rock_contact_size, base_length(s.section), 2000.0, "the base");
    if (s.foundation) at_least("mesh.rock_size", s.mesh.rock_size, s.foundation->depth, 200.0, "the rock box's depth");
    if (s.mesh.rock_size && !s.foundation)
        f.wrong("mesh.rock_size", "mesh.rock_size_m is given without [foundation]: there is no rock.",
                "both or neither", "add [foundation] or delete rock_size_m");
    if (s.reservoir)
        at_least("reservoir.mesh_size", s.reservoir->mesh_size, s.reservoir->level, 400.0, "the water's depth");
    if (s.mesh.size && s.mesh.contact_size && *s.mesh.contact_size > *s.mesh.size)
        f.wrong("mesh.contact_size",
                fmt::format("{} is above {}.", value("mesh.contact_size_m", *s.mesh.contact_size),
                            value("mesh.size_m", *s.mesh.size)),
                "at most mesh.size_m", "exchange the two values");
    if (s.mesh.rock_contact_size && !s.foundation)
        f.wrong("mesh.rock_contact_size", "mesh.rock_contact_size_m is given without [foundation]: there is no rock.",
                "both or neither", "add [foundation] or delete rock_contact_size_m");
    if (s.mesh.rock_contact_size && *s.mesh.rock_contact_size > 0.5 * base_length(s.section))
        f.wrong("mesh.rock_contact_size",
                fmt::format("{} leaves less than two elements below the base of {} m.",
                            value("mesh.rock_contact_size_m", *s.mesh.rock_contact_size),
                            shortest(base_length(s.section))),
                "at most half the base; near contact_size_m is usual", "lessen it or leave it out");
    if (s.time.substeps && (*s.time.substeps < 0 || *s.time.substeps > 10))
        f.wrong("time.substeps", fmt::format("time.substeps = {} is not allowed.", *s.time.substeps),
                "0 ... 10: k of the steps dt / 2^k", "write  substeps = 2  for steps of dt / 4");
    if (s.time.stepping == Stepping::adaptive && f.given("time.substeps"))
        f.wrong("time.substeps", "time.substeps is given with time.stepping = \"adaptive\".",
                "substeps with stepping = \"uniform\"; the adaptive step is chosen by slip_tolerance",
                "delete substeps, or write  stepping = \"uniform\"");
    if (f.given("time.substeps") && f.given("time.slip_tolerance"))
        f.wrong("time.slip_tolerance", "time.slip_tolerance and time.substeps are both given.",
                "one of them: fixed sub-steps, or sub-steps chosen to a tolerance", "delete one");
    check_scheme(s, f);
}

} // namespace damslip::checks
