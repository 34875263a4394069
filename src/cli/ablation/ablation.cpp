#include "cli/ablation/ablation.hpp"

#include "cli/ablation/removal.hpp"

#include <algorithm>

namespace damslip::cli {

namespace {

/// The effect without which this one is not there either.
std::optional<Effect> whole_of(Effect effect, const EffectPlan& plan)
{
    switch (effect) {
    case Effect::seepage:
    case Effect::base_crack:
    case Effect::drains:
    case Effect::curtain_sealing:
        return Effect::uplift;
    case Effect::water_compressibility:
        return plan.on(Effect::acoustic_water) ? Effect::acoustic_water : Effect::hydrodynamic_mass;
    case Effect::bottom_absorption:
    case Effect::moving_bottom:
    case Effect::wave_radiation:
    case Effect::surface_waves:
        return Effect::acoustic_water;
    case Effect::lift_off:
        return Effect::vertical_motion;
    case Effect::floor_pressure:
    case Effect::curtain_stiffness:
        return Effect::rock_flexibility;
    case Effect::lift_joint_water:
        return Effect::lift_joints;
    default:
        return std::nullopt;
    }
}

/// All removals one after the other, as far as the effects are still there.
Scene without_all(const AblationPlan& ablations, const std::vector<Point>& seepage_points)
{
    Scene scene = ablations.full;
    for (const Ablation& a : ablations.removals) {
        if (!make_effect_plan(scene, ablations.method).on(a.effect)) continue;
        auto answer = remove_effect(scene, a.effect, seepage_points);
        if (auto* removal = std::get_if<Removal>(&answer)) scene = std::move(removal->scene);
    }
    return scene;
}

} // namespace

AblationPlan make_ablations(const Scene& scene, Method method, const std::vector<Point>& seepage_points)
{
    AblationPlan ablations;
    ablations.method = method;
    ablations.full = scene;
    const EffectPlan plan = make_effect_plan(scene, method);
    for (const PlannedEffect& e : plan.effects) {
        if (!e.on) continue;
        auto answer = remove_effect(scene, e.effect, seepage_points);
        if (auto* removal = std::get_if<Removal>(&answer))
            ablations.removals.push_back(
                {e.effect, e.name, removal->instead, whole_of(e.effect, plan), std::move(removal->scene)});
        else
            ablations.kept.push_back({e.name, std::get<Stays>(answer).why});
    }
    for (Ablation& a : ablations.removals)
        if (a.part_of && std::none_of(ablations.removals.begin(), ablations.removals.end(),
                                      [&a](const Ablation& other) { return other.effect == *a.part_of; }))
            a.part_of.reset();
    if (ablations.removals.size() > 1) ablations.simplest = without_all(ablations, seepage_points);
    return ablations;
}

} // namespace damslip::cli
