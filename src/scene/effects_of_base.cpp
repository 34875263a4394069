#include "scene/effect_plan.hpp"
#include "scene/joint_bond.hpp"
#include "scene/section.hpp"
#include "scene/water.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace damslip {

namespace {

/// Effects of finite elements alone.
Decision of_finite_elements(Method method, bool on, std::string yes, std::string no, std::string cost)
{
    if (method == Method::rigid_block) return {false, "rigid block", ""};
    return decided(on, std::move(yes), std::move(no), std::move(cost));
}

Decision decide_damping(const Scene& s, Method method)
{
    if (method == Method::rigid_block && s.lifts && s.lifts->amplification == Amplification::modes)
        return {true, "lifts.amplification = \"modes\"", "none"};
    return of_finite_elements(method, s.damping.method != DampingMethod::none, "damping.method",
                              "damping.method = \"none\"", "a matrix with the pattern of the stiffness");
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
    const std::string yes = s.tied_lifts.empty() ? fmt::format("{} [[lift_joint]]", s.lift_joints.size())
                                                 : fmt::format("[lifts]: {} tied until they come near their strength, {} "
                                                               "joints",
                                                               s.tied_lifts.size(), s.lift_joints.size());
    return of_finite_elements(method, !s.lift_joints.empty() || !s.tied_lifts.empty(), yes, "no [[lift_joint]]",
                              "each node of a joint twice, one contact pair each");
}

Decision decide_lift_joint_water(const Scene& s, Method method)
{
    const auto has_water = [](const LiftJoint& j) { return j.water != JointWater::none; };
    const bool any = std::any_of(s.lift_joints.begin(), s.lift_joints.end(), has_water) ||
                     std::any_of(s.tied_lifts.begin(), s.tied_lifts.end(), has_water);
    return of_finite_elements(method, any, "lift_joint.water", "no lift_joint.water",
                              "nodal forces on both sides of the joint");
}

/// With the anchors through them.
void delete_lift_joints(Scene& s)
{
    s.lift_joints.clear();
    s.tied_lifts.clear();
    std::erase_if(s.anchors, [](const Anchor& anchor) { return !anchor.joint.empty(); });
}

RemovalAnswer without_separation(Scene s, const SeepagePoints&)
{
    if (s.contact.normal == NormalContact::exponential)
        return Stays{"exponential contact cannot pull; see contact that gives way"};
    s.contact.separation = JointOpening::none;
    return Removal{s, "contact.separation = \"none\": the joint pulls without shear"};
}

} // namespace

std::vector<EffectRow> contact_effects()
{
    return {
        {.name = "structural damping",
         .decide = decide_damping,
         .take_out =
             [](Scene& s) {
                 s.damping.method = DampingMethod::none;
                 s.damping.mass_coefficient.reset();
                 s.damping.stiffness_coefficient.reset();
             },
         .instead = "damping.method = \"none\"",
         .leave_out = [](Scene& s, const EffectPlan&) { s.damping.method = DampingMethod::none; },
         .named = Effect::structural_damping},
        {.name = "separation",
         .decide =
             [](const Scene& s, Method method) {
                 return of_finite_elements(method, s.contact.separation == JointOpening::allowed,
                                           "contact.separation = \"allowed\"", "contact.separation = \"none\"",
                                           "a second condition of each pair");
             },
         .answer = without_separation,
         .named = Effect::separation},
        {.name = "finite sliding",
         .decide =
             [](const Scene& s, Method method) {
                 return of_finite_elements(method, s.contact.sliding == JointPath::finite,
                                           "contact.sliding = \"finite\"", "contact.sliding = \"small\"",
                                           "the pairs of each place the dam slides to");
             },
         .take_out =
             [](Scene& s) {
                 s.contact.sliding = JointPath::small;
                 s.contact.max_slip = Contact{}.max_slip;
             },
         .instead = "contact.sliding = \"small\": nodes stay opposite each other",
         .named = Effect::finite_sliding},
        {.name = "contact that gives way",
         .decide = decide_yielding_contact,
         .take_out = [](Scene& s) { s = with_exact_contact(s).value_or(s); },
         .instead = "rigid sticking, hard contact",
         .named = Effect::yielding_contact},
        {.name = "lift joints",
         .decide = decide_lift_joints,
         .take_out = delete_lift_joints,
         .instead = "no [[lift_joint]]: a dam of one piece",
         .taken_out_when_off = true,
         .named = Effect::lift_joints},
        {.name = "water in lift joints",
         .decide = decide_lift_joint_water,
         .take_out =
             [](Scene& s) {
                 for (std::vector<LiftJoint>* joints : {&s.lift_joints, &s.tied_lifts})
                     for (LiftJoint& joint : *joints) joint.water = JointWater::none;
             },
         .instead = "lift_joint.water = \"none\"",
         .part_of = {Effect::lift_joints},
         .named = Effect::lift_joint_water},
    };
}

namespace {

Decision decide_strength_loss(const Scene& s, Method)
{
    if (!s.contact.friction_table.empty())
        return {true, "contact.friction_table_m", "strength stages are events of the integration"};
    if (s.contact.residual_friction)
        return {true, "contact.residual_friction", "strength stages are events of the integration"};
    return {false, "no residual_friction, no friction_table_m", ""};
}

RemovalAnswer without_strength_loss(Scene s, const SeepagePoints&)
{
    Contact& c = s.contact;
    c.friction = FrictionOverSlip(c).peak();
    c.friction_table.clear();
    c.residual_friction.reset();
    c.residual_slip = 0.0;
    return Removal{s, fmt::format("friction {:.4g} whatever the slip", c.friction)};
}

} // namespace

std::vector<EffectRow> strength_effects()
{
    return {
        {.name = "cohesion",
         .decide =
             [](const Scene& s, Method) {
                 return decided(s.contact.cohesion > 0, "contact.cohesion_kPa > 0", "contact.cohesion_kPa = 0",
                                "lost at first slip: one event");
             },
         .take_out =
             [](Scene& s) {
                 s.contact.cohesion = 0.0;
                 s.contact.bond = {};
             },
         .instead = "contact.cohesion_kPa = 0",
         .leave_out = [](Scene& s, const EffectPlan&) { s.contact.cohesion = 0.0; },
         .named = Effect::cohesion},
        {.name = "strength loss with slip",
         .decide = decide_strength_loss,
         .answer = without_strength_loss,
         .leave_out =
             [](Scene& s, const EffectPlan&) {
                 s.contact.residual_friction.reset();
                 s.contact.friction_table.clear();
             },
         .named = Effect::strength_loss},
        {.name = "inclined base",
         .decide =
             [](const Scene& s, Method) {
                 return decided(base_inclination(s.section) != 0, "the toe is not level with the heel", "level base",
                                "none");
             },
         .answer = [](Scene, const SeepagePoints&) -> RemovalAnswer {
             return Stays{"geometry: a level base is another dam"};
         },
         .named = Effect::inclined_base},
    };
}

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
         .take_out = leave_out_rate,
         .instead = "friction of rest at any rate",
         .taken_out_when_off = true},
        {.name = "restitution",
         .decide = decide_restitution,
         .take_out = [](Scene& s) { s.contact.restitution = 0.0; },
         .instead = "contact.restitution = 0: impacts do not rebound",
         .taken_out_when_off = true},
        {.name = "sequence",
         .decide =
             [](const Scene& s, Method) {
                 return decided(!s.motion.sequence.empty(),
                                fmt::format("motion.sequence of {} records", s.motion.sequence.size()),
                                "no motion.sequence", "the run to rest between the records");
             },
         .answer = [](Scene s, const SeepagePoints&) -> RemovalAnswer {
             s.motion.sequence.clear();
             s.motion.sequence_pause = 0.0;
             return Removal{s, "no motion.sequence: each record shakes the dam as it was"};
         }},
    };
}

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

} // namespace

std::vector<EffectRow> joint_effects()
{
    return {
        {.name = "bond fracture",
         .decide = decide_bond,
         .take_out = lose_together,
         .instead = "bond = \"together\", no tensile strength",
         .leave_out =
             [](Scene& s, const EffectPlan&) {
                 if (any_bond(s)) lose_together(s);
             }},
    };
}

namespace {

Decision decide_anchors(const Scene& s, Method method)
{
    const auto through_base =
        std::count_if(s.anchors.begin(), s.anchors.end(), [](const Anchor& a) { return a.joint.empty(); });
    if (s.anchors.empty()) return {false, "no [[anchor]]", ""};
    if (method == Method::finite_elements)
        return {true, fmt::format("{} [[anchor]]", s.anchors.size()), "a spring of rank one on two pairs each"};
    if (through_base == 0) return {false, "no [[anchor]] through the base", ""};
    return {true, fmt::format("{} [[anchor]] through the base", through_base),
            "a force that follows the slip, its states events of the integration"};
}

} // namespace

std::vector<EffectRow> anchor_effects()
{
    return {{.name = "anchors",
             .decide = decide_anchors,
             .take_out = [](Scene& s) { s.anchors.clear(); },
             .instead = "no [[anchor]]",
             .taken_out_when_off = true}};
}

namespace {

Decision water_on_planes(const RockWedge& w)
{
    if (w.water == WedgeWater::full) return {true, "wedge.water = \"full\"", "one force on each plane"};
    const bool given = std::any_of(w.planes.begin(), w.planes.end(),
                                   [](const RockPlane& p) { return p.water_pressure.value_or(0.0) > 0.0; });
    return decided(given, "wedge.plane.water_pressure_kPa", "wedge.water = \"dry\"", "one force on each plane");
}

bool cohesive(const RockWedge& w)
{
    return std::any_of(w.planes.begin(), w.planes.end(), [](const RockPlane& p) { return p.cohesion > 0.0; });
}

Decision wedge_strength_loss(const RockWedge& w)
{
    if (!cohesive(w)) return {false, "no wedge.plane.cohesion_kPa to lose", ""};
    return decided(w.cohesion_lost_at_slip, "wedge.cohesion_lost_at_slip = true", "wedge.cohesion_lost_at_slip = false",
                   "strength stages are events of the integration");
}

} // namespace

Decision decide_of_wedge(Effect effect, const Scene& s)
{
    const RockWedge& w = *s.wedge;
    switch (effect) {
    case Effect::user_forces:
        return decided(!w.forces.empty(), fmt::format("{} [[wedge.force]]", w.forces.size()), "no [[wedge.force]]",
                       "one force each");
    case Effect::uplift:
        return water_on_planes(w);
    case Effect::cohesion:
        return decided(cohesive(w), "wedge.plane.cohesion_kPa > 0", "no wedge.plane.cohesion_kPa",
                       "one force along the way of sliding");
    case Effect::strength_loss:
        return wedge_strength_loss(w);
    case Effect::inclined_base:
        return {true, "[wedge]: two planes, the way of sliding is found", "one look at four cases"};
    case Effect::vertical_motion:
        return decide_vertical_motion(s, "the yield acceleration varies in time");
    case Effect::lift_off:
        return {false, "the way of sliding at the yield is kept; a note says where another would start", ""};
    case Effect::upstream_sliding:
        return {false, "a wedge slides one way; sliding up the slope is not followed", ""};
    case Effect::run_out:
        return decide_run_out(s, Method::rigid_block);
    default:
        return {false, "a rock wedge has none", ""};
    }
}

} // namespace damslip
