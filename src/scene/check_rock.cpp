#include "scene/checks.hpp"
#include "scene/rock_mass.hpp"
#include "scene/section.hpp"

#include <cmath>
#include <fmt/format.h>

namespace damslip::checks {

namespace {

void check_radiating_rock(const Scene& s, Findings& f)
{
    if (s.time.scheme == TimeScheme::modal || s.time.scheme == TimeScheme::central_difference)
        f.wrong("foundation.boundary",
                fmt::format("foundation.boundary = \"absorbing\" with time.scheme = \"{}\".",
                            s.time.scheme == TimeScheme::modal ? "modal" : "central-difference"),
                "hht, newmark or auto: rock that lets waves out has no real modes and no stable explicit step",
                "write  scheme = \"hht\"  in [time], or  mass = \"massless\"  in [foundation]");
}

/// A floor that is the rock takes the place of everything else that is said of it.
void check_floor(const Scene& s, Findings& f)
{
    if (!s.reservoir || s.reservoir->floor != ReservoirFloor::rock) return;
    constexpr const char *key = "reservoir.floor", *instead = "floor = \"absorbing\"";
    const auto wrong = [&](const std::string& with, const char* expected, const std::string& fix) {
        f.wrong(key, fmt::format("reservoir.floor = \"rock\" {}.", with), expected,
                fmt::format("{}, or write  {}  in [reservoir]", fix, instead));
    };
    if (s.reservoir->model != ReservoirModel::acoustic)
        wrong("without reservoir.model = \"acoustic\"", "acoustic water: an added mass has no pressure on the floor",
              "write  model = \"acoustic\"");
    if (!rock_radiates(s))
        wrong(!s.foundation       ? "without [foundation]"
              : !rock_has_mass(s) ? "with foundation.mass = \"massless\""
                                  : "with a foundation.boundary that is not \"absorbing\"",
              "radiating rock: a floor that keeps its waves would send them back into the water",
              s.foundation ? "write  mass = \"with-mass\"  and  boundary = \"absorbing\"  in [foundation]"
                           : "add  [foundation]");
    for (const char* given : {"reservoir.bottom_reflection", "reservoir.bottom_density", "reservoir.bottom_modulus"})
        if (f.given(given)) {
            wrong(fmt::format("with {}", given),
                  "one description of the floor: waves would leave twice, into the rock and by the coefficient",
                  fmt::format("delete {}", std::string(given).substr(std::string("reservoir.").size())));
            break;
        }
    if (s.reservoir->bottom_motion == BottomMotion::still)
        wrong("with reservoir.bottom_motion = \"still\"", "a floor that moves with the rock",
              "write  bottom_motion = \"ground\"");
    const double base = std::abs(toe(s.section).x - heel(s.section).x);
    if (constexpr double most = 10.0; s.reservoir->length > most * base)
        wrong(fmt::format("with a reservoir of {:.4g} m", s.reservoir->length),
              "at most ten lengths of the base: the rock below all of it is a box of waves",
              fmt::format("write  length_m = {:.4g}  and  far_end = \"absorbing\"", s.reservoir->level));
    if (s.reservoir->far_end == FarEnd::open)
        wrong("with reservoir.far_end = \"open\"", "far_end = \"absorbing\", \"damper\" or \"closed\"",
              "write  far_end = \"absorbing\"");
    if (s.contact.sliding == JointPath::finite)
        wrong("with contact.sliding = \"finite\"", "contact.sliding = \"small\": the dam stays where the floor ends",
              "write  sliding = \"small\"  in [contact]");
}

} // namespace

void check_rock(const Scene& s, Findings& f)
{
    check_floor(s, f);
    if (!s.foundation) return;
    if (!rock_has_mass(s)) {
        if (s.foundation->boundary ==
            RockBoundary::viscous) // absorbing is the default, which massless rock leaves aside
            f.wrong("foundation.boundary",
                    "foundation.boundary = \"viscous\" with foundation.mass = \"massless\": no waves travel there.",
                    "mass = \"with-mass\" for viscous edges, no boundary for massless rock",
                    "write  mass = \"with-mass\"  in [foundation], or delete boundary");
        return;
    }
    if (rock_radiates(s)) {
        check_radiating_rock(s, f);
        return;
    }
    if (!(s.foundation->material.density > 0.0))
        f.wrong("foundation.mass", "foundation.mass = \"with-mass\" with foundation.density_kg_m3 = 0.",
                "the density of the rock: 2500 ... 2900 kg/m3 is usual",
                "write  density_kg_m3 = 2650  in [foundation], or  mass = \"massless\"  for rock without inertia");
    if (s.contact.sliding == JointPath::finite)
        f.wrong("foundation.mass", "foundation.mass = \"with-mass\" with contact.sliding = \"finite\".",
                "contact.sliding = \"small\": the rock's nodes stay opposite the dam's",
                "write  sliding = \"small\"  in [contact], or  mass = \"massless\"  in [foundation]");
    if (s.mesh.rock_contact_size)
        f.wrong("foundation.mass", "foundation.mass = \"with-mass\" with mesh.rock_contact_size_m.",
                "facing nodes on both sides of the base",
                "delete mesh.rock_contact_size_m, or write  mass = \"massless\"  in [foundation]");
    if (s.mesh.file)
        f.wrong("foundation.mass",
                fmt::format("foundation.mass = \"with-mass\" with mesh.file = \"{}\".", s.mesh.file->string()),
                "the program's own mesh of the rock box, whose sides are upright and whose nodes face the dam's",
                "delete mesh.file, or write  mass = \"massless\"  in [foundation]");
    if (rock_edges_are_viscous(s) &&
        (s.time.scheme == TimeScheme::modal || s.time.scheme == TimeScheme::central_difference))
        f.wrong("foundation.boundary",
                fmt::format("foundation.boundary = \"viscous\" with time.scheme = \"{}\".",
                            s.time.scheme == TimeScheme::modal ? "modal" : "central-difference"),
                "hht, newmark or auto: dashpots have no real modes and are no Rayleigh damping",
                "write  scheme = \"hht\"  in [time], or  boundary = \"fixed\"  in [foundation]");
    if (rock_edges_are_viscous(s) && base_inclination(s.section) != 0.0)
        f.wrong("foundation.boundary",
                fmt::format("foundation.boundary = \"viscous\" with a toe {:.4g} m {} the heel.",
                            std::abs(toe(s.section).y - heel(s.section).y),
                            base_inclination(s.section) > 0.0 ? "below" : "above"),
                "a level base: the free field is that of a half space with a level surface",
                "write  boundary = \"fixed\"  in [foundation], or level the base");
}

} // namespace damslip::checks
