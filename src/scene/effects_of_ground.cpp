#include "scene/effect_plan.hpp"
#include "scene/rock_mass.hpp"
#include "scene/water.hpp"

#include <algorithm>
#include <utility>

namespace damslip {

namespace {

Decision decide_rock_flexibility(const Scene& s, Method method)
{
    if (method == Method::rigid_block) return {false, "rigid block", ""};
    if (!s.foundation) return {false, "no [foundation]: rigid base", ""};
    return {true, "[foundation] is given", "two unknowns per rock node"};
}

Decision decide_curtain_stiffness(const Scene& s, Method method)
{
    if (method == Method::rigid_block) return {false, "rigid block", ""};
    if (curtain_changes_stiffness(s)) return {true, "curtain.young_modulus_GPa", "mesh lines around the curtain"};
    if (!s.curtain) return {false, "no [curtain]", ""};
    if (!s.foundation) return {false, "no [foundation]: rigid base", ""};
    return {false,
            s.curtain->young_modulus ? "the curtain's E and nu are the rock's: no mesh lines"
                                     : "no curtain.young_modulus_GPa: the rock's",
            ""};
}

Decision decide_curtain_sealing(const Scene& s, Method)
{
    if (!s.curtain) return {false, "no [curtain]", ""};
    if (s.uplift && s.uplift->model == UpliftModel::curtain)
        return s.curtain->intact ? Decision{true, "uplift.model = \"curtain\"", "one more corner of the profile"}
                                 : Decision{false, "curtain.intact = false", ""};
    if (!s.uplift || s.uplift->model != UpliftModel::seepage) return {false, "the uplift does not ask for it", ""};
    if (curtain_changes_flow(s)) return {true, "curtain.permeability_m_s", "flow mesh refined around the curtain"};
    return {false,
            s.curtain->intact ? "the curtain's permeability is the rock's: no mesh lines" : "curtain.intact = false",
            ""};
}

Decision decide_rock_inertia(const Scene& s, Method method)
{
    if (method == Method::rigid_block) return {false, "rigid block", ""};
    if (!s.foundation) return {false, "no [foundation]: rigid base", ""};
    if (!rock_has_mass(s)) return {false, "foundation.mass = \"massless\"", ""};
    if (rock_radiates(s)) return {true, "foundation.mass = \"with-mass\"", "two products with the base's nodes a step"};
    return {true, "foundation.mass = \"with-mass\"", "the rock's unknowns stay in every step"};
}

Decision decide_rock_radiation(const Scene& s, Method method)
{
    if (method == Method::rigid_block) return {false, "rigid block", ""};
    if (!s.foundation) return {false, "no [foundation]: rigid base", ""};
    if (!rock_has_mass(s)) return {false, "massless rock carries no waves", ""};
    if (rock_radiates(s))
        return {true, "foundation.boundary = \"absorbing\"", "a box of waves, reduced to the base once"};
    if (!rock_edges_are_viscous(s))
        return {false, "foundation.boundary = \"fixed\": waves come back from the edges", ""};
    return {true, "foundation.boundary = \"viscous\"", "two dashpots on each node of the box's edges"};
}

RemovalAnswer without_rock(Scene s, const SeepagePoints& seepage_points)
{
    std::string instead = "no [foundation]: rigid base";
    if (s.uplift && s.uplift->model == UpliftModel::seepage) {
        if (seepage_points.empty()) return Stays{"the seepage needs the rock, and its profile has no head to refer to"};
        s.uplift->model = UpliftModel::points;
        s.uplift->points = seepage_points;
        instead += ", the same uplift as points";
    }
    let_floor_absorb(s);
    s.foundation.reset();
    s.mesh.rock_contact_size.reset();
    s.mesh.rock_size.reset();
    s.stages.pore_pressure = PorePressure::none;
    return Removal{s, instead};
}

} // namespace

std::vector<EffectRow> rock_effects()
{
    return {
        {.name = "rock flexibility",
         .decide = decide_rock_flexibility,
         .answer = without_rock,
         .leave_out =
             [](Scene& s, const EffectPlan& plan) { // the rigid block: seepage needs the rock box
                 if (plan.method != Method::finite_elements) return;
                 let_floor_absorb(s);
                 s.foundation.reset();
             },
         .named = Effect::rock_flexibility},
        {.name = "curtain stiffness",
         .decide = decide_curtain_stiffness,
         .take_out = [](Scene& s) { s.curtain->young_modulus.reset(); },
         .instead = "the curtain's E and nu are the rock's",
         .part_of = {Effect::rock_flexibility},
         .named = Effect::curtain_stiffness},
        {.name = "curtain sealing",
         .decide = decide_curtain_sealing,
         .answer = [](Scene s, const SeepagePoints&) -> RemovalAnswer {
             s.curtain->intact = false;
             return Removal{s, s.uplift->model == UpliftModel::seepage
                                   ? "curtain.intact = false: as permeable as the rock"
                                   : "curtain.intact = false: linear uplift"};
         },
         .part_of = {Effect::uplift},
         .named = Effect::curtain_sealing},
        {.name = "rock inertia",
         .decide = decide_rock_inertia,
         .take_out = [](Scene& s) { s = with_massless_rock(std::move(s)); },
         .instead = "foundation.mass = \"massless\"",
         .taken_out_when_off = true,
         .part_of = {Effect::rock_flexibility},
         .named = Effect::rock_inertia},
        {.name = "radiation into the rock",
         .decide = decide_rock_radiation,
         .answer = [](Scene s, const SeepagePoints&) -> RemovalAnswer {
             if (rock_radiates(s))
                 return Stays{"rock with mass whose waves stay is a box that resonates: remove the rock's inertia"};
             s.foundation->boundary = RockBoundary::fixed;
             return Removal{s, "foundation.boundary = \"fixed\": the record moves the box, waves come back"};
         },
         .part_of = {Effect::rock_inertia},
         .named = Effect::rock_radiation},
    };
}

namespace {

Decision decide_lift_off(const Scene& s, Method method)
{
    if (method == Method::finite_elements) return {false, "finite elements: see separation", ""};
    if (!any_vertical_record(s) || !s.motion.vertical) return {false, "no vertical motion", ""};
    return {true,
            s.sliding.lift_off == LiftOff::ballistic ? "sliding.lift_off = \"ballistic\""
                                                     : "sliding.lift_off = \"no-friction\"",
            "an event where the normal force vanishes"};
}

Decision decide_upstream_sliding(const Scene& s, Method method)
{
    if (method == Method::finite_elements) return {false, "finite elements: the joint slides either way", ""};
    return decided(s.sliding.two_way, "sliding.two_way = true", "sliding.two_way = false",
                   "a second yield acceleration");
}

RemovalAnswer without_lift_off(Scene s, const SeepagePoints&)
{
    if (s.sliding.lift_off == LiftOff::no_friction)
        return Stays{"no-friction is the simplest answer to a base without normal force; see vertical motion"};
    s.sliding.lift_off = LiftOff::no_friction;
    return Removal{s, "sliding.lift_off = \"no-friction\": no flight"};
}

} // namespace

Decision decide_vertical_motion(const Scene& s, const char* cost)
{
    if (!any_vertical_record(s)) return {false, "no record has a vertical component", ""};
    return decided(s.motion.vertical, "records have vertical components", "motion.vertical = false", cost);
}

Decision decide_run_out(const Scene& s, Method)
{
    return decided(s.sliding.run_out_max > 0, "sliding.run_out_max_s > 0", "sliding.run_out_max_s = 0",
                   "until it rests, only if still sliding at the record's end");
}

bool any_vertical_record(const Scene& s)
{
    return std::any_of(s.motion.records.begin(), s.motion.records.end(),
                       [](const RecordFiles& r) { return r.vertical.has_value(); });
}

std::vector<EffectRow> motion_effects()
{
    return {
        {.name = "vertical motion",
         .decide =
             [](const Scene& s, Method) {
                 return decide_vertical_motion(s, "one more sample per step; the yield acceleration varies in time");
             },
         .take_out = [](Scene& s) { s.motion.vertical = false; },
         .instead = "motion.vertical = false",
         .leave_out =
             [](Scene& s, const EffectPlan&) {
                 s.motion.vertical = false;
                 for (RecordFiles& record : s.motion.records) record.vertical.reset();
             },
         .named = Effect::vertical_motion},
        {.name = "lift-off",
         .decide = decide_lift_off,
         .answer = without_lift_off,
         .part_of = {Effect::vertical_motion},
         .named = Effect::lift_off},
        {.name = "upstream sliding",
         .decide = decide_upstream_sliding,
         .take_out = [](Scene& s) { s.sliding.two_way = false; },
         .instead = "sliding.two_way = false",
         .leave_out =
             [](Scene& s, const EffectPlan& plan) {
                 if (plan.method == Method::rigid_block) s.sliding.two_way = false;
             },
         .named = Effect::upstream_sliding},
        {.name = "run-out",
         .decide = decide_run_out,
         .take_out = [](Scene& s) { s.sliding.run_out_max = 0.0; },
         .instead = "sliding.run_out_max_s = 0: the record's end is the end",
         .taken_out_when_off = true,
         .named = Effect::run_out},
    };
}

} // namespace damslip
