#include "analysis/ablation/ablation.hpp"

#include "scene/effect_row.hpp"

#include <algorithm>

namespace damslip {

namespace {

/// All removals one after the other, as far as the effects are still there.
Scene without_all(const AblationPlan& ablations, const std::vector<Point>& seepage_points)
{
    Scene scene = ablations.full;
    for (const Ablation& a : ablations.removals) {
        if (!make_effect_plan(scene, ablations.method).on(a.effect)) continue;
        auto answer = effect_row(a.effect).remove(scene, seepage_points);
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
        const EffectRow& row = effect_row(e.effect);
        auto answer = row.remove(scene, seepage_points);
        if (auto* removal = std::get_if<Removal>(&answer))
            ablations.removals.push_back({e.effect, e.name, removal->instead,
                                          row.part_of ? std::optional(row.part_of(plan)) : std::nullopt,
                                          std::move(removal->scene)});
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

} // namespace damslip
