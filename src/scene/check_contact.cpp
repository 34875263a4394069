#include "scene/checks.hpp"

#include "core/number.hpp"
#include "scene/section.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <set>

namespace damslip::checks {

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
             {std::pair("pressure_at_zero_clearance", "kPa"), std::pair("clearance_at_zero_pressure", "m")})
            if (f.given(fmt::format("contact.{}", key)))
                f.wrong(fmt::format("contact.{}", key),
                        fmt::format("contact.{}_{} is given, but contact.normal is not \"exponential\".", key, unit),
                        fmt::format("normal = \"exponential\" with {}_{}", key, unit),
                        fmt::format("write  normal = \"exponential\"  or delete {}_{}", key, unit));
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
        f.wrong("contact.tangential_stiffness",
                "contact.tangential_stiffness_N_m3 is given, but contact.enforcement is not \"penalty\".",
                "enforcement = \"penalty\" with tangential_stiffness_N_m3",
                "write  enforcement = \"penalty\"  or delete tangential_stiffness_N_m3");
    if (c.enforcement != ContactEnforcement::slip_tolerance && f.given("contact.slip_tolerance"))
        f.wrong("contact.slip_tolerance",
                "contact.slip_tolerance is given, but contact.enforcement is not \"slip-tolerance\".",
                "enforcement = \"slip-tolerance\" with slip_tolerance",
                "write  enforcement = \"slip-tolerance\"  or delete slip_tolerance");
    if (c.sliding != JointPath::finite && f.given("contact.max_slip"))
        f.wrong("contact.max_slip", "contact.max_slip_m is given, but contact.sliding is not \"finite\".",
                "sliding = \"finite\" with max_slip_m", "write  sliding = \"finite\"  or delete max_slip_m");
    check_normal_contact(c, f);
}

} // namespace damslip::checks
