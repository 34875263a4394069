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

} // namespace

void check_rock(const Scene& s, Findings& f)
{
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
