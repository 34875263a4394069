#include "scene/effect_row.hpp"
#include "scene/opening_water.hpp"

#include <fmt/format.h>

namespace damslip {

namespace {

Decision decide_opening_water(const Scene& s, Method method)
{
    if (!s.uplift || s.uplift->model == UpliftModel::none) return {false, "no uplift", ""};
    const JointWaterLaw& law = s.uplift->water;
    if (law.opening == OpeningWater::unchanged) return {false, "uplift.opening = \"unchanged\"", ""};
    const std::string reason = fmt::format("uplift.opening = \"{}\"", word(law.opening));
    if (method == Method::finite_elements)
        return {true, reason,
                law.opening == OpeningWater::reynolds
                    ? "flow along the joint in every contact problem: 1.4 times the time of a step, and shorter steps"
                    : "one pressure profile per step"};
    if (law.opening == OpeningWater::reynolds)
        return {false,
                reason +
                    ": a rigid block has no width of the joint, its uplift stays; take \"mouth\", or finite elements",
                ""};
    return {true, reason,
            law.opening == OpeningWater::mouth ? "water brought forward in 4 to 64 parts of each sample"
                                               : "crack and uplift iterated once per direction of sliding"};
}

Decision decide_water_after(const Scene& s, Method method)
{
    const bool full = s.uplift && s.uplift->water.after == WaterAfter::full;
    if (method == Method::rigid_block && (!full || s.motion.sequence.empty()))
        return {false, "rigid block: nothing is looked at after the earthquake but between two of a sequence", ""};
    return {full, full ? "uplift.after = \"full\"" : "uplift.after = \"unchanged\"", "none"};
}

} // namespace

std::vector<EffectRow> opening_water_effects()
{
    const auto of_uplift = [](const EffectPlan&) { return Effect::uplift; };
    return {
        {.name = "water that follows the opening",
         .decide = decide_opening_water,
         .remove = [](Scene s, const SeepagePoints&) -> RemovalAnswer {
             const WaterAfter after = s.uplift->water.after;
             s.uplift->water = {};
             s.uplift->water.after = after;
             return Removal{s, "uplift.opening = \"unchanged\": the pressure before the earthquake"};
         },
         .leave_out =
             [](Scene& s, const EffectPlan&) {
                 if (!s.uplift) return;
                 const WaterAfter after = s.uplift->water.after;
                 s.uplift->water = {};
                 s.uplift->water.after = after;
             },
         .part_of = of_uplift},
        {.name = "water in the crack afterwards",
         .decide = decide_water_after,
         .remove = [](Scene s, const SeepagePoints&) -> RemovalAnswer {
             s.uplift->water.after = WaterAfter::unchanged;
             return Removal{s, "uplift.after = \"unchanged\""};
         },
         .leave_out =
             [](Scene& s, const EffectPlan&) {
                 if (s.uplift) s.uplift->water.after = WaterAfter::unchanged;
             },
         .part_of = of_uplift},
    };
}

} // namespace damslip
