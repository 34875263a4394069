#include "scene/effect_row.hpp"
#include "scene/joint_bond.hpp"

#include <algorithm>

namespace damslip {

namespace {

bool any_bond(const Scene& s)
{
    return breaks_by_energy(s.contact) || std::any_of(s.lift_joints.begin(), s.lift_joints.end(),
                                                      [](const LiftJoint& j) { return breaks_by_energy(j.strength); });
}

Decision decide_bond(const Scene& s, Method method)
{
    if (method == Method::rigid_block) return {false, "rigid block: cohesion is lost together", ""};
    if (any_bond(s)) return {true, "bond = \"fracture\"", "a contact problem of its own wherever the damage grows"};
    return {false, "no fracture energies", ""};
}

void lose_together(Scene& s)
{
    s.contact.bond = {};
    for (LiftJoint& joint : s.lift_joints) joint.strength.bond = {};
}

RemovalAnswer without_bond(Scene s, const SeepagePoints&)
{
    lose_together(s);
    return Removal{std::move(s), "bond = \"together\", no tensile strength"};
}

} // namespace

std::vector<EffectRow> joint_effects()
{
    return {
        {.name = "bond fracture",
         .decide = decide_bond,
         .remove = without_bond,
         .leave_out =
             [](Scene& s, const EffectPlan&) {
                 if (any_bond(s)) lose_together(s);
             }},
    };
}

} // namespace damslip
