#include "scene/anchor_bar.hpp"
#include "scene/checks.hpp"
#include "scene/friction_over_slip.hpp"
#include "scene/section.hpp"

#include "core/number.hpp"
#include "core/units.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace damslip::checks {

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
