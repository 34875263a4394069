#include "scene/curtain.hpp"
#include "scene/effect_row.hpp"
#include "scene/rock_mass.hpp"

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
         .remove = without_rock,
         .leave_out =
             [](Scene& s, const EffectPlan& plan) { // the rigid block: seepage needs the rock box
                 if (plan.method != Method::finite_elements) return;
                 let_floor_absorb(s);
                 s.foundation.reset();
             },
         .named = Effect::rock_flexibility},
        {.name = "curtain stiffness",
         .decide = decide_curtain_stiffness,
         .remove = [](Scene s, const SeepagePoints&) -> RemovalAnswer {
             s.curtain->young_modulus.reset();
             return Removal{s, "the curtain's E and nu are the rock's"};
         },
         .part_of = [](const EffectPlan&) { return Effect::rock_flexibility; },
         .named = Effect::curtain_stiffness},
        {.name = "curtain sealing",
         .decide = decide_curtain_sealing,
         .remove = [](Scene s, const SeepagePoints&) -> RemovalAnswer {
             s.curtain->intact = false;
             return Removal{s, s.uplift->model == UpliftModel::seepage
                                   ? "curtain.intact = false: as permeable as the rock"
                                   : "curtain.intact = false: linear uplift"};
         },
         .part_of = [](const EffectPlan&) { return Effect::uplift; },
         .named = Effect::curtain_sealing},
        {.name = "rock inertia",
         .decide = decide_rock_inertia,
         .remove = [](Scene s, const SeepagePoints&) -> RemovalAnswer {
             return Removal{with_massless_rock(std::move(s)), "foundation.mass = \"massless\""};
         },
         .leave_out = [](Scene& s, const EffectPlan&) { s = with_massless_rock(std::move(s)); },
         .part_of = [](const EffectPlan&) { return Effect::rock_flexibility; },
         .named = Effect::rock_inertia},
        {.name = "radiation into the rock",
         .decide = decide_rock_radiation,
         .remove = [](Scene s, const SeepagePoints&) -> RemovalAnswer {
             if (rock_radiates(s))
                 return Stays{"rock with mass whose waves stay is a box that resonates: remove the rock's inertia"};
             s.foundation->boundary = RockBoundary::fixed;
             return Removal{s, "foundation.boundary = \"fixed\": the record moves the box, waves come back"};
         },
         .part_of = [](const EffectPlan&) { return Effect::rock_inertia; },
         .named = Effect::rock_radiation},
    };
}

} // namespace damslip
