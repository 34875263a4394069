#include "scene/effect_plan.hpp"

#include "core/number.hpp"
#include "scene/curtain.hpp"
#include "scene/section.hpp"
#include "scene/words.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace damslip {

namespace {

/// Why an effect is on or off, and what it costs when on.
struct Decision {
    bool on;
    std::string reason;
    std::string cost;
};

std::string table_there(bool there, const std::string& table)
{
    return there ? "[" + table + "] is given" : "no [" + table + "]";
}

bool uplift_on(const Scene& s)
{
    return s.uplift && s.uplift->model != UpliftModel::none;
}
bool any_vertical(const Scene& s)
{
    return std::any_of(s.motion.records.begin(), s.motion.records.end(),
                       [](const RecordFiles& r) { return r.vertical.has_value(); });
}

Decision hydrodynamic_mass(const Scene& s, Method method)
{
    if (!s.reservoir) return {false, "no [reservoir]", ""};
    switch (s.reservoir->model) {
    case ReservoirModel::hydrostatic:
        return {false, "reservoir.model = \"hydrostatic\"", ""};
    case ReservoirModel::acoustic:
        if (method == Method::finite_elements) return {false, "reservoir.model = \"acoustic\" takes its place", ""};
        return {true, "reservoir.model = \"acoustic\": a rigid block has added mass instead",
                "one quadrature over the wet face"};
    case ReservoirModel::automatic:
        return {true, "reservoir.model = \"auto\": added mass", "one quadrature over the wet face"};
    case ReservoirModel::added_mass:
        break;
    }
    return {true, "reservoir.model = \"added-mass\"", "one quadrature over the wet face"};
}

Decision uplift(const Scene& s)
{
    if (!s.uplift)
        return {false,
                s.reservoir || s.tailwater ? "no [uplift] and no [curtain]: the base is taken as dry" : "no [uplift]",
                ""};
    if (!uplift_on(s)) return {false, "uplift.model = \"none\"", ""};
    return {true, std::string("uplift.model = \"") + word(s.uplift->model) + "\"", "one pressure profile"};
}

Decision curtain_stiffness(const Scene& s)
{
    if (curtain_changes_stiffness(s)) return {true, "curtain.young_modulus_GPa", "mesh lines around the curtain"};
    if (!s.curtain) return {false, "no [curtain]", ""};
    if (!s.foundation) return {false, "no [foundation]: rigid base", ""};
    return {false,
            s.curtain->young_modulus ? "the curtain's E and nu are the rock's: no mesh lines"
                                     : "no curtain.young_modulus_GPa: the rock's",
            ""};
}

Decision curtain_sealing(const Scene& s)
{
    if (!s.curtain) return {false, "no [curtain]", ""};
    if (!s.uplift || s.uplift->model != UpliftModel::seepage) return {false, "uplift is not by seepage", ""};
    if (curtain_changes_flow(s)) return {true, "curtain.permeability_m_s", "flow mesh refined around the curtain"};
    return {false,
            s.curtain->intact ? "the curtain's permeability is the rock's: no mesh lines" : "curtain.intact = false",
            ""};
}

Decision strength_loss(const Contact& c)
{
    if (!c.friction_table.empty())
        return {true, "contact.friction_table_m", "strength stages are events of the integration"};
    if (c.residual_friction)
        return {true, "contact.residual_friction", "strength stages are events of the integration"};
    return {false, "no residual_friction, no friction_table_m", ""};
}

Decision decide(Effect effect, const Scene& s, Method method)
{
    const bool rigid = method == Method::rigid_block;
    const bool fe = !rigid;
    const auto fe_only = [&](bool there, std::string yes, std::string no, std::string cost) -> Decision {
        if (rigid) return {false, "rigid block", ""};
        return there ? Decision{true, std::move(yes), std::move(cost)} : Decision{false, std::move(no), ""};
    };
    switch (effect) {
    case Effect::hydrostatic_thrust:
        return {s.reservoir.has_value(), table_there(s.reservoir.has_value(), "reservoir"), "exact face integrals"};
    case Effect::tailwater:
        return {s.tailwater.has_value(), table_there(s.tailwater.has_value(), "tailwater"), "exact face integrals"};
    case Effect::silt:
        return {s.silt.has_value(), table_there(s.silt.has_value(), "silt"), "one force"};
    case Effect::ice:
        return {s.ice.has_value(), s.ice ? "[ice] is given; acts in the combinations that name it" : "no [ice]",
                "one force"};
    case Effect::user_forces:
        return {!s.forces.empty(), s.forces.empty() ? "no [[force]]" : fmt::format("{} [[force]]", s.forces.size()),
                "one force each"};
    case Effect::uplift:
        return uplift(s);
    case Effect::seepage: {
        const bool on = s.uplift && s.uplift->model == UpliftModel::seepage;
        return {on, on ? "uplift.model = \"seepage\"" : "uplift is not by seepage",
                "one Darcy solution of the rock box"};
    }
    case Effect::base_crack: {
        const bool on = uplift_on(s) && s.uplift->crack != CrackRule::none;
        return {on, on ? "uplift.crack" : "uplift.crack = \"none\" (limit equilibrium shows both)",
                "crack and uplift iterated per state"};
    }
    case Effect::drains:
        return {s.drains.has_value(), table_there(s.drains.has_value(), "drains"), "part of the pressure profile"};
    case Effect::hydrodynamic_mass:
        return hydrodynamic_mass(s, method);
    case Effect::acoustic_water:
        return fe_only(s.reservoir && s.reservoir->model == ReservoirModel::acoustic, "reservoir.model = \"acoustic\"",
                       "reservoir is not acoustic", "one unknown per water node");
    case Effect::cohesion:
        return {s.contact.cohesion > 0,
                s.contact.cohesion > 0 ? "contact.cohesion_kPa > 0" : "contact.cohesion_kPa = 0",
                "lost at first slip: one event"};
    case Effect::strength_loss:
        return strength_loss(s.contact);
    case Effect::inclined_base:
        return {base_inclination(s.section) != 0,
                base_inclination(s.section) != 0 ? "the toe is not level with the heel" : "level base", "none"};
    case Effect::vertical_motion: {
        if (!any_vertical(s)) return {false, "no record has a vertical component", ""};
        return {s.motion.vertical, s.motion.vertical ? "records have vertical components" : "motion.vertical = false",
                "one more sample per step; the yield acceleration varies in time"};
    }
    case Effect::lift_off: {
        const bool on = any_vertical(s) && s.motion.vertical;
        return {on,
                on ? (s.sliding.lift_off == LiftOff::ballistic ? "sliding.lift_off = \"ballistic\""
                                                               : "sliding.lift_off = \"no-friction\"")
                   : "no vertical motion",
                "an event where the normal force vanishes"};
    }
    case Effect::upstream_sliding:
        return {s.sliding.two_way, s.sliding.two_way ? "sliding.two_way = true" : "sliding.two_way = false",
                "a second yield acceleration"};
    case Effect::run_out:
        return {s.sliding.run_out_max > 0,
                s.sliding.run_out_max > 0 ? "sliding.run_out_max_s > 0" : "sliding.run_out_max_s = 0",
                "until stuck for 0.5 s, only if still sliding at the record's end"};
    case Effect::rock_flexibility:
        return fe_only(s.foundation.has_value(), "[foundation] is given", "no [foundation]: rigid base",
                       "two unknowns per rock node");
    case Effect::curtain_stiffness:
        return rigid ? Decision{false, "rigid block", ""} : curtain_stiffness(s);
    case Effect::curtain_sealing:
        return curtain_sealing(s);
    case Effect::structural_damping:
        return {fe && s.damping.method != DampingMethod::none,
                rigid                                     ? "rigid block"
                : s.damping.method != DampingMethod::none ? "damping.method"
                                                          : "damping.method = \"none\"",
                "a matrix with the pattern of the stiffness"};
    case Effect::lift_joints:
        return fe_only(!s.lift_joints.empty(), fmt::format("{} [[lift_joint]]", s.lift_joints.size()),
                       "no [[lift_joint]]", "each node of a joint twice, one contact pair each");
    }
    return {false, "", ""};
}

const std::vector<std::pair<Effect, const char*>>& names()
{
    static const std::vector<std::pair<Effect, const char*>> list{
        {Effect::hydrostatic_thrust, "hydrostatic thrust"},
        {Effect::tailwater, "tailwater"},
        {Effect::silt, "silt"},
        {Effect::ice, "ice"},
        {Effect::user_forces, "user forces"},
        {Effect::uplift, "uplift"},
        {Effect::seepage, "seepage"},
        {Effect::base_crack, "base crack"},
        {Effect::drains, "drains"},
        {Effect::hydrodynamic_mass, "hydrodynamic added mass"},
        {Effect::acoustic_water, "acoustic water"},
        {Effect::cohesion, "cohesion"},
        {Effect::strength_loss, "strength loss with slip"},
        {Effect::inclined_base, "inclined base"},
        {Effect::vertical_motion, "vertical motion"},
        {Effect::lift_off, "lift-off"},
        {Effect::upstream_sliding, "upstream sliding"},
        {Effect::run_out, "run-out"},
        {Effect::rock_flexibility, "rock flexibility"},
        {Effect::curtain_stiffness, "curtain stiffness"},
        {Effect::curtain_sealing, "curtain sealing"},
        {Effect::structural_damping, "structural damping"},
        {Effect::lift_joints, "lift joints"}};
    return list;
}

} // namespace

bool EffectPlan::on(Effect effect) const
{
    return std::any_of(effects.begin(), effects.end(),
                       [effect](const PlannedEffect& e) { return e.effect == effect && e.on; });
}

EffectPlan make_effect_plan(const Scene& scene, Method method)
{
    EffectPlan plan{method, {}};
    for (const auto& [effect, name] : names()) {
        const Decision d = decide(effect, scene, method);
        plan.effects.push_back({effect, name, d.on, d.reason, d.on ? d.cost : ""});
    }
    return plan;
}

Scene called_for(const EffectPlan& plan, Scene scene)
{
    if (!plan.on(Effect::hydrostatic_thrust)) scene.reservoir.reset();
    if (!plan.on(Effect::tailwater)) scene.tailwater.reset();
    if (!plan.on(Effect::silt)) scene.silt.reset();
    if (!plan.on(Effect::ice)) scene.ice.reset();
    if (!plan.on(Effect::user_forces)) scene.forces.clear();
    if (!plan.on(Effect::uplift)) scene.uplift.reset();
    if (!plan.on(Effect::drains)) scene.drains.reset();
    if (scene.uplift && !plan.on(Effect::base_crack)) scene.uplift->crack = CrackRule::none;
    if (scene.reservoir && !plan.on(Effect::hydrodynamic_mass) && !plan.on(Effect::acoustic_water))
        scene.reservoir->model = ReservoirModel::hydrostatic;
    if (!plan.on(Effect::cohesion)) scene.contact.cohesion = 0.0;
    if (!plan.on(Effect::strength_loss)) {
        scene.contact.residual_friction.reset();
        scene.contact.friction_table.clear();
    }
    if (!plan.on(Effect::vertical_motion)) {
        scene.motion.vertical = false;
        for (RecordFiles& record : scene.motion.records) record.vertical.reset();
    }
    scene.sliding.two_way = plan.on(Effect::upstream_sliding);
    if (!plan.on(Effect::run_out)) scene.sliding.run_out_max = 0.0;
    if (plan.method == Method::finite_elements && !plan.on(Effect::rock_flexibility)) scene.foundation.reset();
    if (!plan.on(Effect::lift_joints)) scene.lift_joints.clear();
    if (!plan.on(Effect::structural_damping)) scene.damping.method = DampingMethod::none;
    return scene;
}

} // namespace damslip
