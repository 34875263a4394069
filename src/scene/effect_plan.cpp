#include "scene/effect_plan.hpp"

#include <algorithm>

namespace damslip {

const EffectRow& effect_row(Effect effect)
{
    return effect_rows()[std::size_t(effect)];
}

RemovalAnswer EffectRow::remove(Scene scene, const SeepagePoints& points) const
{
    if (answer) return answer(std::move(scene), points);
    take_out(scene);
    return Removal{std::move(scene), instead};
}

std::optional<Effect> EffectRow::whole(const EffectPlan& plan) const
{
    const auto found = std::ranges::find_if(part_of, [&](Effect effect) { return plan.on(effect); });
    if (found != part_of.end()) return *found;
    return part_of.empty() ? std::nullopt : std::optional(part_of.back());
}

bool EffectPlan::on(Effect effect) const
{
    return std::any_of(effects.begin(), effects.end(),
                       [effect](const PlannedEffect& e) { return e.effect == effect && e.on; });
}

EffectPlan make_effect_plan(const Scene& scene, Method method)
{
    EffectPlan plan{method, {}, {}};
    const std::span<const EffectRow> rows = effect_rows();
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (rows[i].concerns && !rows[i].concerns(scene)) continue;
        const Decision d = scene.wedge ? decide_of_wedge(Effect(i), scene) : rows[i].decide(scene, method);
        plan.effects.push_back({Effect(i), rows[i].name, d.on, d.reason, d.on ? d.cost : ""});
    }
    return plan;
}

Scene called_for(const EffectPlan& plan, Scene scene)
{
    for (const PlannedEffect& e : plan.effects) {
        const EffectRow& row = effect_row(e.effect);
        if (!e.on && row.taken_out_when_off) row.take_out(scene);
        if (!e.on && row.leave_out) row.leave_out(scene, plan);
    }
    return scene;
}

} // namespace damslip
