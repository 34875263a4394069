#include "scene/effect_row.hpp"
#include "scene/exact_contact.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace damslip {

namespace {

/// Effects of finite elements alone.
Decision of_finite_elements(Method method, bool on, std::string yes, std::string no, std::string cost)
{
    if (method == Method::rigid_block) return {false, "rigid block", ""};
    return on ? Decision{true, std::move(yes), std::move(cost)} : Decision{false, std::move(no), ""};
}

Decision decide_damping(const Scene& s, Method method)
{
    return of_finite_elements(method, s.damping.method != DampingMethod::none, "damping.method",
                              "damping.method = \"none\"", "a matrix with the pattern of the stiffness");
}

Decision decide_separation(const Scene& s, Method method)
{
    return of_finite_elements(method, s.contact.separation == JointOpening::allowed, "contact.separation = \"allowed\"",
                              "contact.separation = \"none\"", "a second condition of each pair");
}

Decision decide_finite_sliding(const Scene& s, Method method)
{
    return of_finite_elements(method, s.contact.sliding == JointPath::finite, "contact.sliding = \"finite\"",
                              "contact.sliding = \"small\"", "the pairs of each place the dam slides to");
}

Decision decide_yielding_contact(const Scene& s, Method method)
{
    const Contact& c = s.contact;
    if (method == Method::rigid_block) return {false, "rigid block", ""};
    if (c.normal == NormalContact::exponential)
        return {true, "contact.normal = \"exponential\"", "springs across and along the pairs"};
    if (c.enforcement == ContactEnforcement::penalty)
        return {true, "contact.enforcement = \"penalty\"", "springs along the pairs"};
    if (c.enforcement == ContactEnforcement::slip_tolerance)
        return {true, "contact.enforcement = \"slip-tolerance\"", "springs along the pairs that follow the pressure"};
    return {false, "contact.enforcement = \"exact\", contact.normal = \"hard\"", ""};
}

Decision decide_lift_joints(const Scene& s, Method method)
{
    return of_finite_elements(method, !s.lift_joints.empty(), fmt::format("{} [[lift_joint]]", s.lift_joints.size()),
                              "no [[lift_joint]]", "each node of a joint twice, one contact pair each");
}

Decision decide_lift_joint_water(const Scene& s, Method method)
{
    const bool any = std::any_of(s.lift_joints.begin(), s.lift_joints.end(),
                                 [](const LiftJoint& j) { return j.water != JointWater::none; });
    return of_finite_elements(method, any, "lift_joint.water", "no lift_joint.water",
                              "nodal forces on both sides of the joint");
}

/// With the anchors through them.
void delete_lift_joints(Scene& s)
{
    s.lift_joints.clear();
    std::erase_if(s.anchors, [](const Anchor& anchor) { return !anchor.joint.empty(); });
}

RemovalAnswer without_damping(Scene s, const SeepagePoints&)
{
    s.damping.method = DampingMethod::none;
    s.damping.mass_coefficient.reset();
    s.damping.stiffness_coefficient.reset();
    return Removal{s, "damping.method = \"none\""};
}

RemovalAnswer without_separation(Scene s, const SeepagePoints&)
{
    if (s.contact.normal == NormalContact::exponential)
        return Stays{"exponential contact cannot pull; see contact that gives way"};
    s.contact.separation = JointOpening::none;
    return Removal{s, "contact.separation = \"none\": the joint pulls without shear"};
}

RemovalAnswer without_finite_sliding(Scene s, const SeepagePoints&)
{
    s.contact.sliding = JointPath::small;
    s.contact.max_slip = Contact{}.max_slip;
    return Removal{s, "contact.sliding = \"small\": nodes stay opposite each other"};
}

} // namespace

std::vector<EffectRow> contact_effects()
{
    return {
        {.name = "structural damping",
         .decide = decide_damping,
         .remove = without_damping,
         .leave_out = [](Scene& s, const EffectPlan&) { s.damping.method = DampingMethod::none; },
         .named = Effect::structural_damping},
        {.name = "separation", .decide = decide_separation, .remove = without_separation, .named = Effect::separation},
        {.name = "finite sliding",
         .decide = decide_finite_sliding,
         .remove = without_finite_sliding,
         .named = Effect::finite_sliding},
        {.name = "contact that gives way",
         .decide = decide_yielding_contact,
         .remove = [](Scene s, const SeepagePoints&) -> RemovalAnswer {
             return Removal{with_exact_contact(s).value_or(s), "rigid sticking, hard contact"};
         },
         .named = Effect::yielding_contact},
        {.name = "lift joints",
         .decide = decide_lift_joints,
         .remove = [](Scene s, const SeepagePoints&) -> RemovalAnswer {
             delete_lift_joints(s);
             return Removal{s, "no [[lift_joint]]: a dam of one piece"};
         },
         .leave_out = [](Scene& s, const EffectPlan&) { delete_lift_joints(s); },
         .named = Effect::lift_joints},
        {.name = "water in lift joints",
         .decide = decide_lift_joint_water,
         .remove = [](Scene s, const SeepagePoints&) -> RemovalAnswer {
             for (LiftJoint& joint : s.lift_joints) joint.water = JointWater::none;
             return Removal{s, "lift_joint.water = \"none\""};
         },
         .part_of = [](const EffectPlan&) { return Effect::lift_joints; },
         .named = Effect::lift_joint_water},
    };
}

} // namespace damslip
