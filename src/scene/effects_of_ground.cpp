#include "scene/effect_plan.hpp"
#include "scene/rock_mass.hpp"
#include "scene/water.hpp"

#include <fmt/format.h>

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

/// Effects of the planes beside the base. Finite elements follow a seam that they are asked to slide on (Scene::seam_body).
namespace {

bool has_lifts(const Scene& s)
{
    return s.lifts.has_value();
}

bool has_seams(const Scene& s)
{
    return !s.seams.empty();
}

bool has_planes(const Scene& s)
{
    return has_lifts(s) || has_seams(s);
}

template <class Is>
bool any_seam(const Scene& s, Is&& is)
{
    return std::any_of(s.seams.begin(), s.seams.end(), [&](const Seam& seam) {
        return (!s.seam_body || s.seam_body->name == seam.name) && is(seam);
    });
}

bool pushes_wedge(const Seam& seam)
{
    return seam.wedge.has_value();
}

bool rubs(const Seam& seam)
{
    return seam.interface.model == InterfaceModel::friction;
}

bool rises(const Seam& seam)
{
    return seam.dilation != 0.0 || (seam.wedge && seam.wedge->dilation != 0.0);
}

bool drained(const Seam& seam)
{
    return seam.uplift == UpliftModel::drains;
}

Decision of_planes(Method method, bool on, std::string yes, std::string no, std::string cost)
{
    if (method == Method::finite_elements) return {false, "finite elements: base and [[lift_joint]]", ""};
    return decided(on, std::move(yes), std::move(no), std::move(cost));
}

/// A row of seams: on where any seam is so.
template <bool (*is)(const Seam&)>
Decision of_seams(Method method, const Scene& s, const char* yes, const char* no, const char* cost)
{
    return of_planes(s.seam_body ? Method::rigid_block : method, any_seam(s, is), yes, no, cost);
}

bool is_traced(const Scene& s)
{
    return s.dam.crack == BodyCrack::traced;
}

} // namespace

std::vector<EffectRow> plane_effects()
{
    return {
        {.name = "lifts",
         .decide =
             [](const Scene& s, Method m) {
                 return of_planes(m, has_lifts(s), "[lifts]", "no [lifts]", "one rigid block for each lift");
             },
         .take_out = [](Scene& s) { s.lifts.reset(); },
         .instead = "no [lifts]: a dam of one piece",
         .taken_out_when_off = true,
         .concerns = has_planes},
        {.name = "water in lifts",
         .decide =
             [](const Scene& s, Method m) {
                 return of_planes(m, s.lifts->uplift != LiftUplift::none, "lifts.uplift", "lifts.uplift = \"none\"",
                                  "one force on each lift");
             },
         .take_out = [](Scene& s) { s.lifts->uplift = LiftUplift::none; },
         .instead = "lifts.uplift = \"none\"",
         .concerns = has_lifts},
        {.name = "amplification over the height",
         .decide =
             [](const Scene& s, Method m) {
                 return of_planes(m, s.lifts->amplification != Amplification::constant, "lifts.amplification",
                                  "lifts.amplification = \"constant\"",
                                  s.lifts->amplification == Amplification::modes
                                      ? "modes of the bonded dam once, four slides for each lift, record and polarity"
                                      : "one integral for each lift");
             },
         .take_out = [](Scene& s) { s.lifts->amplification = Amplification::constant; },
         .instead = "lifts.amplification = \"constant\": the dam moves as the ground",
         .concerns = has_lifts},
        {.name = "seams",
         .decide =
             [](const Scene& s, Method m) {
                 if (s.seam_body)
                     return Decision{true, fmt::format("slides on \"{}\" and on the base", s.seam_body->name),
                                     "the rock above it, two unknowns a pair along its path"};
                 return of_planes(m, has_seams(s), fmt::format("{} [[seam]]", s.seams.size()), "no [[seam]]",
                                  "one chain of rigid blocks for each");
             },
         .take_out = [](Scene& s) { s.seams.clear(); },
         .instead = "no [[seam]]: whole rock below the base",
         .taken_out_when_off = true,
         .concerns = has_planes},
        {.name = "passive wedge",
         .decide =
             [](const Scene& s, Method m) {
                 return of_seams<pushes_wedge>(m, s, "[seam.wedge]", "no [seam.wedge]",
                                               "one block more; a search by its angle");
             },
         .take_out =
             [](Scene& s) {
                 for (Seam& seam : s.seams) {
                     if (!seam.wedge) continue;
                     seam.wedge.reset();
                     seam.exit = SeamExit::free_face;
                 }
             },
         .instead = "seam.exit = \"free-face\": nothing holds the toe",
         .concerns = has_seams},
        {.name = "friction between blocks",
         .decide =
             [](const Scene& s, Method m) {
                 return of_seams<rubs>(m, s, "seam.interface.model = \"friction\"", "seam.interface.model = \"smooth\"",
                                       "none");
             },
         .take_out =
             [](Scene& s) {
                 for (Seam& seam : s.seams) {
                     seam.interface.model = InterfaceModel::smooth;
                     seam.interface.friction = seam.interface.cohesion = 0.0;
                 }
             },
         .instead = "seam.interface.model = \"smooth\"",
         .concerns = has_seams},
        {.name = "dilation of seams",
         .decide =
             [](const Scene& s, Method m) {
                 return of_seams<rises>(m, s, "seam.dilation_deg", "no dilation_deg", "none; its end is an event");
             },
         .take_out =
             [](Scene& s) {
                 for (Seam& seam : s.seams) {
                     seam.dilation = 0.0;
                     seam.dilation_slip.reset();
                     if (seam.wedge) seam.wedge->dilation = 0.0;
                 }
             },
         .instead = "seam.dilation_deg = 0",
         .concerns = has_seams},
        {.name = "drains at seams",
         .decide =
             [](const Scene& s, Method m) {
                 return of_seams<drained>(m, s, "seam.uplift = \"drains\"", "no seam.uplift = \"drains\"",
                                          "one corner of the pressure");
             },
         .take_out =
             [](Scene& s) {
                 for (Seam& seam : s.seams)
                     if (drained(seam)) seam.uplift = UpliftModel::linear;
             },
         .instead = "seam.uplift = \"linear\", as with E = 0",
         .concerns = has_seams},
        {.name = "change of shape with slip",
         .decide =
             [](const Scene& s, Method m) {
                 return of_planes(m, s.planes.geometry == PlaneGeometry::linear, "planes.geometry = \"linear\"",
                                  "planes.geometry = \"small\"", "a yield that grows with the slip");
             },
         .take_out = [](Scene& s) { s.planes.geometry = PlaneGeometry::small; },
         .instead = "planes.geometry = \"small\"",
         .concerns = has_seams},
        {.name = "traced cracks",
         .decide =
             [](const Scene&, Method m) {
                 return decided(m == Method::finite_elements, "dam.crack = \"traced\"", "rigid block",
                                "a run anew for each crack, and each time a path moves");
             },
         .take_out = [](Scene& s) { s.dam.crack = BodyCrack::none; },
         .instead = "dam.crack = \"none\": the concrete stays whole",
         .concerns = is_traced},
    };
}

} // namespace damslip
