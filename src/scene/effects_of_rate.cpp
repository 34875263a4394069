#include "scene/effect_row.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace damslip {

namespace {

bool any_rate(const Scene& s)
{
    return s.contact.rate.active() || std::any_of(s.lift_joints.begin(), s.lift_joints.end(),
                                                  [](const LiftJoint& j) { return j.strength.rate.active(); });
}

Decision decide_rate(const Scene& s, Method method)
{
    const bool on = method == Method::rigid_block ? s.contact.rate.active() : any_rate(s);
    if (!on) return {false, "no kinetic_friction_ratio", ""};
    return {true, s.contact.rate.active() ? "contact.kinetic_friction_ratio" : "lift_joint.kinetic_friction_ratio",
            method == Method::rigid_block ? "a Taylor series for each few v_c of change of rate"
                                          : "a contact problem for each correction of friction, some six a step"};
}

void leave_out_rate(Scene& s)
{
    s.contact.rate = {};
    for (LiftJoint& joint : s.lift_joints) joint.strength.rate = {};
}

Decision decide_restitution(const Scene& s, Method method)
{
    if (s.contact.restitution == 0.0) return {false, "contact.restitution = 0", ""};
    if (method == Method::rigid_block && s.sliding.lift_off != LiftOff::ballistic)
        return {false, "sliding.lift_off = \"no-friction\": no flight to rebound from", ""};
    return {true, fmt::format("contact.restitution = {:g}", s.contact.restitution),
            method == Method::rigid_block ? "a flight more for each impact"
                                          : "one more contact problem for each impact"};
}

} // namespace

std::vector<EffectRow> rate_effects()
{
    return {
        {.name = "friction over the rate",
         .decide = decide_rate,
         .remove = [](Scene s, const SeepagePoints&) -> RemovalAnswer {
             leave_out_rate(s);
             return Removal{s, "friction of rest at any rate"};
         },
         .leave_out = [](Scene& s, const EffectPlan&) { leave_out_rate(s); }},
        {.name = "restitution",
         .decide = decide_restitution,
         .remove = [](Scene s, const SeepagePoints&) -> RemovalAnswer {
             s.contact.restitution = 0.0;
             return Removal{s, "contact.restitution = 0: impacts do not rebound"};
         },
         .leave_out = [](Scene& s, const EffectPlan&) { s.contact.restitution = 0.0; }},
        {.name = "sequence",
         .decide = [](const Scene& s, Method) -> Decision {
             if (s.motion.sequence.empty()) return {false, "no motion.sequence", ""};
             return {true, fmt::format("motion.sequence of {} records", s.motion.sequence.size()),
                     "the run to rest between the records"};
         },
         .remove = [](Scene s, const SeepagePoints&) -> RemovalAnswer {
             s.motion.sequence.clear();
             s.motion.sequence_pause = 0.0;
             return Removal{s, "no motion.sequence: each record shakes the dam as it was"};
         }},
    };
}

} // namespace damslip
