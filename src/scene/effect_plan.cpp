#include "scene/effect_plan.hpp"

#include "scene/effect_decision.hpp"

#include <algorithm>
#include <utility>

namespace damslip {

namespace {

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
        {Effect::water_compressibility, "water compressibility"},
        {Effect::bottom_absorption, "bottom absorption"},
        {Effect::moving_bottom, "moving reservoir bottom"},
        {Effect::wave_radiation, "wave radiation upstream"},
        {Effect::surface_waves, "surface waves"},
        {Effect::floor_pressure, "floor pressure"},
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
        {Effect::separation, "separation"},
        {Effect::finite_sliding, "finite sliding"},
        {Effect::yielding_contact, "contact that gives way"},
        {Effect::lift_joints, "lift joints"},
        {Effect::lift_joint_water, "water in lift joints"}};
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
    const bool rigid = plan.method == Method::rigid_block; // the others keep what limit equilibrium beside them needs
    if (rigid && scene.uplift && !plan.on(Effect::base_crack)) scene.uplift->crack = CrackRule::none;
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
    if (rigid) scene.sliding.two_way = plan.on(Effect::upstream_sliding);
    if (!plan.on(Effect::run_out)) scene.sliding.run_out_max = 0.0;
    if (!rigid && !plan.on(Effect::rock_flexibility)) scene.foundation.reset();
    if (!plan.on(Effect::lift_joints)) scene.lift_joints.clear();
    if (!plan.on(Effect::structural_damping)) scene.damping.method = DampingMethod::none;
    return scene;
}

} // namespace damslip
