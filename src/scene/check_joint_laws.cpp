#include "scene/checks.hpp"

#include "scene/first_joint_law.hpp"
#include "scene/joint_bond.hpp"
#include "scene/mesh_sizes.hpp"
#include "scene/plausible.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <vector>

namespace damslip::checks {

namespace {

/// Laws of joints are exact in the contact problem of implicit steps, and only there.
void check_company(const Scene& s, Findings& f)
{
    const std::string law = first_joint_law(s);
    if (law.empty()) return;
    const Contact& c = s.contact;
    const auto refuse = [&](const char* key, const std::string& other, const std::string& instead) {
        f.wrong(key, fmt::format("{} with {}.", law, other), instead + " with laws of joints beyond Coulomb's",
                fmt::format("write  {}  or leave out {}", instead, law));
    };
    if (c.enforcement != ContactEnforcement::exact)
        refuse("contact.enforcement", "contact.enforcement other than \"exact\"", "enforcement = \"exact\"");
    if (c.normal != NormalContact::hard)
        refuse("contact.normal", "contact.normal = \"exponential\"", "normal = \"hard\"");
    if (c.separation != JointOpening::allowed)
        refuse("contact.separation", "contact.separation = \"none\"", "separation = \"allowed\"");
    if (s.time.scheme == TimeScheme::central_difference)
        refuse("time.scheme", "time.scheme = \"central-difference\"", "scheme = \"hht\"");
}

void note_weak_cohesion(const Contact& c, const std::string& table, Findings& f)
{
    if (!(c.cohesion > 0.0) || !(c.bond.tensile_strength > 0.0)) return;
    const double least = c.friction * c.bond.tensile_strength;
    if (c.cohesion >= least) return;
    Diagnostic note;
    note.problem = fmt::format("{}.cohesion_kPa = {} is less than friction x tensile_strength_kPa = {}.", table,
                               six_digits(1e-3 * c.cohesion), six_digits(1e-3 * least));
    note.expected =
        "cohesion of at least mu f_t: the bond's strength is an ellipse through both, beside Coulomb's line";
    note.fix = "check both strengths";
    f.note(table + ".cohesion", note);
}

/// The rigid block, which stands beside every answer, is a series in forces over its slip or in friction over its rate.
void check_together(const Scene& s, Findings& f)
{
    if (s.anchors.empty() || !s.contact.rate.active()) return;
    f.wrong(
        "contact.kinetic_friction_ratio", "contact.kinetic_friction_ratio with [[anchor]].",
        "one of the two: the rigid block beside every answer follows forces over its slip (anchors) or friction over "
        "its rate, not both",
        "delete kinetic_friction_ratio with its keys, or the [[anchor]]");
}

} // namespace

void check_bond(const Contact& c, const std::string& table, Findings& f)
{
    const auto key = [&table](const char* name) { return table + "." + name; };
    const BondLoss loss = bond_loss(c);
    const Bond& bond = c.bond;
    if (loss != BondLoss::fracture) {
        for (const auto& [name, unit] :
             {std::pair("tensile_strength", "kPa"), std::pair("fracture_energy_tension", "N_m"),
              std::pair("fracture_energy_shear", "N_m")})
            if (f.given(key(name)))
                f.wrong(key(name),
                        fmt::format("{}_{} is given, but the bond is lost {}.", key(name), unit,
                                    loss == BondLoss::together ? "together" : "by pairs"),
                        "bond = \"fracture\" with fracture_energy_shear_N_m",
                        fmt::format("write  bond = \"fracture\"  with its energies, or delete {}_{}", name, unit));
        return;
    }
    if (!c.cohesion_lost_at_slip)
        f.wrong(key("cohesion_lost_at_slip"),
                fmt::format("{} = false with a bond that breaks.", key("cohesion_lost_at_slip")),
                "true with bond = \"fracture\"", "delete cohesion_lost_at_slip, or the fracture energies");
    if (!(c.cohesion > 0.0) && !(bond.tensile_strength > 0.0))
        f.wrong(key("bond"),
                fmt::format("{} breaks by energy, but {} and {} are both 0.", table, key("cohesion_kPa"),
                            key("tensile_strength_kPa")),
                "a strength above 0", "add  cohesion_kPa  or  tensile_strength_kPa , or delete the bond's keys");
    if (c.cohesion > 0.0 && !bond.shear_energy)
        f.wrong(
            key("cohesion"),
            fmt::format("{} has cohesion and breaks by energy, but no {}.", table, key("fracture_energy_shear_N_m")),
            "G_II above 0 [N_m]", "add  fracture_energy_shear_N_m = 1500");
    if (bond.tensile_strength > 0.0 && !bond.tension_energy)
        f.wrong(key("tensile_strength"),
                fmt::format("{} has tensile strength, but no {}.", table, key("fracture_energy_tension_N_m")),
                "G_I above 0 [N_m]", "add  fracture_energy_tension_N_m = 150");
    note_weak_cohesion(c, table, f);
}

void check_joint_laws(const Scene& s, Findings& f)
{
    check_bond(s.contact, "contact", f);
    for (std::size_t i = 0; i < s.lift_joints.size(); ++i)
        check_bond(s.lift_joints[i].strength, fmt::format("lift_joint[{}]", i + 1), f);
    check_company(s, f);
    check_together(s, f);
    if (f.any() || !breaks_by_energy(s.contact) || s.mesh.file) return;
    const double length = mesh_sizes(s).contact;
    const auto modulus = joint_modulus(s, true);
    if (!modulus) return; // no finite elements
    const CarriedBond carried = carried_bond(s.contact, *modulus, length);
    if (!carried.lowered) return;
    Diagnostic note;
    note.problem = fmt::format(
        "elements of {} m on the base are longer than a quarter of the bond's process zone: FE runs "
        "with tensile strength {} kPa and cohesion {} kPa, fracture energies kept.",
        six_digits(length), six_digits(1e-3 * carried.tensile_strength), six_digits(1e-3 * carried.cohesion));
    note.expected = fmt::format("mesh.contact_size_m of at most {} (E' G/(4 f^2), Bazant & Oh 1983)",
                                six_digits(bond_element_length(s.contact, *modulus)));
    note.fix = "give a smaller mesh.contact_size_m; total work and end strength are right as it is, the peak is lower";
    f.note("contact", note);
}

} // namespace damslip::checks
