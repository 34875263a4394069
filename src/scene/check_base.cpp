#include "core/text.hpp"
#include "core/units.hpp"
#include "scene/anchor_bar.hpp"
#include "scene/check.hpp"
#include "scene/joint_bond.hpp"
#include "scene/mesh_sizes.hpp"
#include "scene/plausible.hpp"
#include "scene/section.hpp"
#include "scene/uplift_models.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <set>
#include <utility>
#include <vector>

namespace damslip {

void check_consistency(const Scene& scene, Findings& findings, FileCheck files)
{
    if (scene.wedge) {
        checks::check_wedge(scene, findings);
        checks::check_motion(scene, findings, files);
        checks::check_sequence(scene, findings);
        return;
    }
    checks::check_base(scene, findings);
    checks::check_rock(scene, findings);
    checks::check_strength(scene.contact, "contact", findings);
    checks::check_lift_joints(scene, findings);
    checks::check_joint(scene, findings);
    checks::check_planes(scene, findings);
    checks::check_anchors(scene, findings);
    checks::check_water(scene, findings);
    checks::check_motion(scene, findings, files);
    checks::check_sequence(scene, findings);
    checks::check_rate_methods(scene, findings);
    checks::check_flexible_block(scene, findings);
    checks::check_combinations(scene, findings);
    checks::check_fe(scene, findings);
    checks::check_joint_laws(scene, findings);
    checks::check_opening_water(scene, findings);
    checks::check_mesh_file(scene, findings, files);
    checks::note_unread(scene, findings);
}

} // namespace damslip

namespace damslip::checks {

std::string value(const char* key, double x)
{
    return fmt::format("{} = {}", key, shortest(x));
}

void wrong_without(Findings& f, const std::string& table, const std::string& key, const char* unit, const char* choice,
                   const char* word)
{
    f.wrong(table + "." + key,
            fmt::format("{0}.{1}{2} is given, but {0}.{3} is not \"{4}\".", table, key, unit, choice, word),
            fmt::format("{} = \"{}\" with {}{}", choice, word, key, unit),
            fmt::format("write  {} = \"{}\"  or delete {}{}", choice, word, key, unit));
}

void check_base(const Scene& s, Findings& f)
{
    const double base = base_length(s.section);
    if (s.curtain && s.curtain->distance + s.curtain->thickness > base)
        f.wrong("curtain.distance",
                fmt::format("the curtain ends outside the base: {} + {}, base length = {} m.",
                            value("curtain.distance_m", s.curtain->distance),
                            value("curtain.thickness_m", s.curtain->thickness), shortest(base)),
                "distance_m + thickness_m at most the base length", "lessen curtain.distance_m");
    if (s.curtain && s.foundation && s.curtain->depth >= s.foundation->depth)
        f.wrong("curtain.depth",
                fmt::format("{} reaches through the rock box, {}.", value("curtain.depth_m", s.curtain->depth),
                            value("foundation.depth_m", s.foundation->depth)),
                "curtain.depth_m below foundation.depth_m", "deepen the box or shorten the curtain");
    if (s.foundation && s.foundation->width < 1.2 * base)
        f.wrong("foundation.width",
                fmt::format("{} is too narrow for a base of {} m.", value("foundation.width_m", s.foundation->width),
                            shortest(base)),
                "at least 1.2 x base; 5 to 7 x base is usual", "widen the box");
    if (s.foundation)
        for (const auto& [key, extent] :
             {std::pair("width", s.foundation->width), std::pair("depth", s.foundation->depth)})
            if (extent > 100 * base)
                f.wrong(fmt::format("foundation.{}", key),
                        fmt::format("foundation.{}_m = {} is more than a hundred times the base of {} m.", key,
                                    shortest(extent), shortest(base)),
                        fmt::format("at most 100 x base, {} m; 2 to 7 x base is usual", shortest(100 * base)),
                        "check the unit, or lessen the box");
    if (s.drains && s.drains->distance >= base)
        f.wrong("drains.distance",
                fmt::format("{} is not within the base of {} m.", value("drains.distance_m", s.drains->distance),
                            shortest(base)),
                "0 ... below the base length", "measure along the base from the heel");
    if (s.drains && s.drains->depth && s.foundation && *s.drains->depth >= s.foundation->depth)
        f.wrong("drains.depth",
                fmt::format("{} reaches through the rock box, {}.", value("drains.depth_m", *s.drains->depth),
                            value("foundation.depth_m", s.foundation->depth)),
                "drains.depth_m below foundation.depth_m", "deepen the box or shorten the drains");
    if (!s.uplift) return;
    if (const UpliftRow& row = uplift_row(s.uplift->model); !has_what_it_needs(s, row))
        f.wrong("uplift.model", fmt::format("uplift.model = \"{}\" needs {}.", row.word, row.needs), row.needs,
                fmt::format("add {} or choose another uplift.model", row.needs));
    if (s.uplift->model != UpliftModel::points && !s.uplift->points.empty())
        wrong_without(f, "uplift", "points", "_m", "model", "points");
    const auto& p = s.uplift->points;
    for (std::size_t i = 0; i < p.size(); ++i)
        if (p[i].x < 0 || p[i].x > base * (1 + 1e-12) || (i && p[i].x < p[i - 1].x)) {
            f.wrong("uplift.points",
                    fmt::format("uplift.points_m has the distance {} at place {}.", shortest(p[i].x), i + 1),
                    fmt::format("distances along the base from 0 to {} m, not decreasing", shortest(base)),
                    "put the points in order from heel to toe");
            break;
        }
    if (!p.empty() && (p.front().x != 0 || std::abs(p.back().x - base) > 1e-9 * base))
        f.wrong("uplift.points",
                fmt::format("uplift.points_m covers {} to {} m.", shortest(p.front().x), shortest(p.back().x)),
                fmt::format("from 0 (heel) to {} (toe)", shortest(base)), "add the missing end");
}

namespace {

/// The other end of the way a joint must keep, and what is there.
struct Neighbour {
    double level;
    std::string name;
};

void check_normal_contact(const Contact& c, Findings& f)
{
    if (c.normal != NormalContact::exponential) {
        for (const auto& [key, unit] :
             {std::pair("pressure_at_zero_clearance", "_kPa"), std::pair("clearance_at_zero_pressure", "_m")})
            if (f.given(fmt::format("contact.{}", key)))
                wrong_without(f, "contact", key, unit, "normal", "exponential");
        return;
    }
    if (c.separation == JointOpening::none)
        f.wrong("contact.normal", "contact.normal = \"exponential\" with contact.separation = \"none\".",
                "separation = \"allowed\": the exponential pressure ends at its clearance, it cannot pull",
                "write  separation = \"allowed\"  or  normal = \"hard\"");
    if (c.enforcement == ContactEnforcement::slip_tolerance)
        f.wrong("contact.normal", "contact.normal = \"exponential\" with contact.enforcement = \"slip-tolerance\".",
                "enforcement = \"exact\" or \"penalty\" with the exponential pressure",
                "write  enforcement = \"penalty\"  with tangential_stiffness_N_m3, or  enforcement = \"exact\"");
}

/// Friction over the rate of slip. @param table  "contact" or "lift_joint[1]"
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

} // namespace

void check_strength(const Contact& c, const std::string& table, Findings& f)
{
    const auto key = [&table](const char* name) { return table + "." + name; };
    if (c.residual_friction && *c.residual_friction > c.friction)
        f.wrong(key("residual_friction"),
                fmt::format("{} = {} is above the peak value, {} = {}.", key("residual_friction"),
                            shortest(*c.residual_friction), key("friction"), shortest(c.friction)),
                "at most " + key("friction"), "exchange the two values");
    if (!c.residual_friction && f.given(key("residual_slip")))
        f.wrong(key("residual_slip"),
                fmt::format("{} is given without {}.", key("residual_slip_m"), key("residual_friction")),
                "both or neither",
                table == "contact" ? "add  residual_friction = 0.65  to [contact]" : "add  residual_friction = 0.65");
    check_rate(c, table, f);
    if (!c.friction_table.empty() && c.residual_friction)
        f.wrong(key("friction_table"),
                fmt::format("{} and {} are both given.", key("friction_table_m"), key("residual_friction")),
                "one of them", "delete one");
    for (std::size_t i = 0; i < c.friction_table.size(); ++i)
        if (c.friction_table[i].x < 0 || (i == 0 && c.friction_table[i].x != 0) ||
            (i && c.friction_table[i].x <= c.friction_table[i - 1].x)) {
            f.wrong(key("friction_table"),
                    fmt::format("{} has the slip {} at place {}.", key("friction_table_m"),
                                shortest(c.friction_table[i].x), i + 1),
                    "slips from 0, increasing", "put the pairs in order, the first at slip 0");
            break;
        }
}

void check_lift_joints(const Scene& s, Findings& f)
{
    const double low = std::max(heel(s.section).y, toe(s.section).y), high = crest_level(s.section);
    const double own = s.mesh.size.value_or((high - std::min(heel(s.section).y, toe(s.section).y)) / 40.0);
    const double size = s.mesh.file ? 0.0 : own; // an imported mesh has lines where it has them
    std::vector<Neighbour> below{{low, "the base"}, {high, "the crest"}};
    std::set<std::string> names;
    for (std::size_t i = 0; i < s.lift_joints.size(); ++i) {
        const LiftJoint& joint = s.lift_joints[i];
        const std::string label = fmt::format("lift_joint[{}]", i + 1);
        check_strength(joint.strength, label, f);
        if (!names.insert(joint.name).second)
            f.wrong(label + ".name", fmt::format("two lift joints are named \"{}\".", joint.name), "names that differ",
                    "rename one");
        const std::string given = label + "." + value("elevation_m", joint.elevation);
        const std::string inside =
            fmt::format("above the base at {} m and below the crest at {} m", shortest(low), shortest(high));
        if (!(joint.elevation > low && joint.elevation < high)) {
            f.wrong(label + ".elevation", given + " is not inside the dam.", inside, "move the joint, or delete it");
            continue;
        }
        const double width = width_at_level(s.section, joint.elevation);
        if (width < size)
            f.wrong(label + ".elevation",
                    fmt::format("{}: the section is {:.4g} m wide there, less than one element of {:.4g} m.", given,
                                width, size),
                    "a joint at least one element wide", "lower the joint, or give a smaller mesh.size_m");
        for (const Neighbour& other : below)
            if (std::abs(other.level - joint.elevation) < 0.5 * size)
                f.wrong(label + ".elevation",
                        fmt::format("{} is {:.4g} m from {}: no room for an element of {:.4g} m.", given,
                                    std::abs(other.level - joint.elevation), other.name, size),
                        fmt::format("at least half an element, {:.4g} m, between base, joints and crest", 0.5 * size),
                        "move the joint, or give a smaller mesh.size_m");
        below.push_back({joint.elevation, label});
    }
    if (s.lift_joints.empty()) return;
    if (s.contact.sliding == JointPath::finite)
        f.wrong("contact.sliding", "contact.sliding = \"finite\" with a [[lift_joint]].",
                "sliding = \"small\" where the dam has lift joints",
                "write  sliding = \"small\"  or delete the [[lift_joint]]");
}

void check_joint(const Scene& s, Findings& f)
{
    const Contact& c = s.contact;
    const bool penalty = c.enforcement == ContactEnforcement::penalty;
    if (penalty && !c.tangential_stiffness)
        f.wrong("contact.enforcement", "contact.enforcement = \"penalty\" without contact.tangential_stiffness_N_m3.",
                "both", "add  tangential_stiffness_N_m3 = 1e11  to [contact]");
    if (!penalty && c.tangential_stiffness)
        wrong_without(f, "contact", "tangential_stiffness", "_N_m3", "enforcement", "penalty");
    if (c.enforcement != ContactEnforcement::slip_tolerance && f.given("contact.slip_tolerance"))
        wrong_without(f, "contact", "slip_tolerance", "", "enforcement", "slip-tolerance");
    if (c.sliding != JointPath::finite && f.given("contact.max_slip"))
        wrong_without(f, "contact", "max_slip", "_m", "sliding", "finite");
    check_normal_contact(c, f);
}

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
    f.note(table + ".cohesion",
           fmt::format("{}.cohesion_kPa = {} is less than friction x tensile_strength_kPa = {}.", table,
                       six_digits(1e-3 * c.cohesion), six_digits(1e-3 * least)),
           "cohesion of at least mu f_t: the bond's strength is an ellipse through both, beside Coulomb's line",
           "check both strengths");
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

/// Bond of one plane. @param table  as of check_strength()
void check_bond(const Contact& c, const std::string& table, Findings& f)
{
    const auto key = [&table](const char* name) { return table + "." + name; };
    const BondLoss loss = bond_loss(c);
    const Bond& bond = c.bond;
    if (loss != BondLoss::fracture) {
        for (const auto& [name, unit] :
             {std::pair("tensile_strength", "_kPa"), std::pair("fracture_energy_tension", "_N_m"),
              std::pair("fracture_energy_shear", "_N_m"), std::pair("softening", ""), std::pair("dynamic_increase", "")})
            if (f.given(key(name)))
                f.wrong(key(name),
                        fmt::format("{}{} is given, but the bond is lost {}.", key(name), unit,
                                    loss == BondLoss::together ? "together" : "by pairs"),
                        "bond = \"fracture\" with fracture_energy_shear_N_m",
                        fmt::format("write  bond = \"fracture\"  with its energies, or delete {}{}", name, unit));
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
    const bool exponential = bond.softening == BondSoftening::exponential, increased = bond.dynamic_increase != 1.0;
    if ((exponential || increased) && bond.unloading == BondUnloading::plastic) {
        const char* with = exponential ? "softening" : "dynamic_increase";
        f.wrong(key(with), fmt::format("{} is given with {} = \"plastic\".", key(with), key("unloading")),
                "unloading = \"origin\" with exponential softening or dynamic_increase",
                fmt::format("delete {}, or unloading", with));
    }
    note_weak_cohesion(c, table, f);
}

} // namespace

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
    f.note("contact",
           fmt::format("elements of {} m on the base are longer than a quarter of the bond's process zone: FE runs "
                       "with tensile strength {} kPa and cohesion {} kPa, fracture energies kept.",
                       six_digits(length), six_digits(1e-3 * carried.tensile_strength),
                       six_digits(1e-3 * carried.cohesion)),
           fmt::format("mesh.contact_size_m of at most {} (E' G/(4 f^2), Bazant & Oh 1983)",
                       six_digits(bond_element_length(s.contact, *modulus))),
           "give a smaller mesh.contact_size_m; total work and end strength are right as it is, the peak is lower");
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

namespace {

constexpr double kN = 1e3; // [N]

/// What an anchor crosses, and how long that is [m].
struct CrossedJoint {
    std::string name;
    double length;
};

void check_steel(const Anchor& a, const std::string& label, Findings& f)
{
    const AnchorBar bar = anchor_bar(a, 0.0);
    if (!(bar.yield_force > a.prestress))
        f.wrong(label + ".prestress",
                fmt::format("{} = {} is not below the yield force, yield_strength_MPa x area_m2_m = {:.6g} kN/m.",
                            label + ".prestress_kN_m", shortest(a.prestress / kN), bar.yield_force / kN),
                fmt::format("a lock-off force below {:.6g} kN/m (usual: 0.6 of it)", bar.yield_force / kN),
                fmt::format("write  prestress_kN_m = {:.6g} , or give more area_m2_m", 0.6 * bar.yield_force / kN));
    if (a.rupture_strain && !(*a.rupture_strain > bar.yield_strain()))
        f.wrong(label + ".rupture_strain",
                fmt::format("{} = {} is not above the yield strain, yield_strength_MPa/young_modulus_GPa = {:.4g}.",
                            label + ".rupture_strain", shortest(*a.rupture_strain), bar.yield_strain()),
                fmt::format("a strain above {:.4g} (strand: 0.035, bars: 0.05)", bar.yield_strain()),
                "write  rupture_strain = 0.035 , or delete it");
}

} // namespace

void check_anchors(const Scene& s, Findings& f)
{
    std::set<std::string> names;
    for (std::size_t i = 0; i < s.anchors.size(); ++i) {
        const Anchor& a = s.anchors[i];
        const std::string label = fmt::format("anchor[{}]", i + 1);
        if (!names.insert(a.name).second)
            f.wrong(label + ".name", fmt::format("two anchors are named \"{}\".", a.name), "names that differ",
                    "rename one");
        CrossedJoint joint{"the base", base_length(s.section)};
        if (!a.joint.empty()) {
            const auto found = std::find_if(s.lift_joints.begin(), s.lift_joints.end(),
                                            [&](const LiftJoint& j) { return j.name == a.joint; });
            if (found == s.lift_joints.end()) {
                std::string all;
                for (const LiftJoint& j : s.lift_joints) all += (all.empty() ? "\"" : ", \"") + j.name + "\"";
                f.wrong(label + ".joint",
                        fmt::format("{}.joint = \"{}\" is not the name of a [[lift_joint]].", label, a.joint),
                        all.empty() ? "no joint: the scene has no [[lift_joint]]" : all,
                        "correct the name, or delete  joint  for an anchor through the base");
                continue;
            }
            joint = {fmt::format("the lift joint \"{}\"", a.joint), width_at_level(s.section, found->elevation)};
        }
        if (!(a.distance <= joint.length))
            f.wrong(label + ".distance",
                    fmt::format("{} is outside {}, {:.6g} m long.", label + "." + value("distance_m", a.distance),
                                joint.name, joint.length),
                    fmt::format("0 to {:.6g} m from its upstream end", joint.length), "move the anchor into the joint");
        check_steel(a, label, f);
    }
    if (s.anchors.empty()) return;
    if (s.sliding.scheme == SlidingScheme::slammer)
        f.wrong("sliding.scheme", "sliding.scheme = \"slammer\" with [[anchor]].",
                "scheme = \"exact\": SLAMMER's scheme has no force that grows with slip",
                "write  scheme = \"exact\"  or delete the [[anchor]]");
    if (s.sliding.lift_off == LiftOff::ballistic)
        f.wrong("sliding.lift_off", "sliding.lift_off = \"ballistic\" with [[anchor]].",
                "lift_off = \"no-friction\": the block's flight knows no anchor",
                "write  lift_off = \"no-friction\"  or delete the [[anchor]]");
    if (s.flexible_block)
        f.wrong("flexible_block", "[flexible_block] with [[anchor]].",
                "one of them: the flexible block knows no force that grows with slip",
                "delete [flexible_block] (finite elements are flexible), or the [[anchor]]");
}

} // namespace damslip::checks
