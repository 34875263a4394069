#include "scene/effect_row.hpp"
#include "scene/water.hpp"
#include "scene/words.hpp"

#include <fmt/format.h>

namespace damslip {

namespace {

Effect part_of_uplift(const EffectPlan&)
{
    return Effect::uplift;
}

bool uplift_acts(const Scene& s)
{
    return s.uplift && s.uplift->model != UpliftModel::none;
}

Decision decide_uplift(const Scene& s, Method)
{
    if (!s.uplift) return {false, "no [uplift]", ""};
    if (!uplift_acts(s))
        return {false,
                std::string("uplift.model = \"none\"") + (base_taken_as_dry(s) ? ": the base is taken as dry" : ""),
                ""};
    return {true, std::string("uplift.model = \"") + word(s.uplift->model) + "\"", "one pressure profile"};
}

Decision decide_base_crack(const Scene& s, Method method)
{
    if (method == Method::finite_elements)
        return {false,
                s.uplift && s.uplift->water.opening != OpeningWater::unchanged
                    ? "finite elements: the joint opens by itself, its water by uplift.opening"
                    : "finite elements: the joint opens by itself, the uplift stays",
                ""};
    const bool on = uplift_acts(s) && s.uplift->crack != CrackRule::none;
    return {on, on ? "uplift.crack" : "uplift.crack = \"none\" (limit equilibrium shows both)",
            "crack and uplift iterated per state"};
}

RemovalAnswer without_seepage(Scene s, const SeepagePoints&)
{
    if (s.curtain && s.curtain->intact) {
        s.uplift->model = UpliftModel::curtain;
        return Removal{s,
                       fmt::format("uplift.model = \"curtain\": the printed profile, ratio {:.4g} behind the curtain",
                                   s.uplift->curtain_ratio)};
    }
    if (s.drains) {
        s.uplift->model = UpliftModel::drains;
        return Removal{s, "uplift.model = \"drains\": straight lines through the drains' head"};
    }
    s.uplift->model = UpliftModel::linear;
    return Removal{s, "uplift.model = \"linear\": a straight line from heel to toe"};
}

RemovalAnswer without_drains(Scene s, const SeepagePoints&)
{
    s.drains.reset();
    if (!s.uplift || s.uplift->model != UpliftModel::drains) return Removal{s, "no drains"};
    s.uplift->model = UpliftModel::linear;
    return Removal{s, "no drains: uplift.model = \"linear\""};
}

} // namespace

std::vector<EffectRow> uplift_effects()
{
    return {
        {.name = "uplift",
         .decide = decide_uplift,
         .remove = [](Scene s, const SeepagePoints&) -> RemovalAnswer {
             s.uplift = Uplift{.model = UpliftModel::none, .points = {}, .water = {}};
             return Removal{s, "uplift.model = \"none\": dry base"};
         },
         .leave_out =
             [](Scene& s, const EffectPlan&) { // said by name, so that the scene that was run can be read again
                 if (s.uplift) s.uplift = Uplift{.model = UpliftModel::none, .points = {}, .water = {}};
             },
         .named = Effect::uplift},
        {.name = "seepage",
         .decide = [](const Scene& s, Method) -> Decision {
             const bool on = s.uplift && s.uplift->model == UpliftModel::seepage;
             return {on, on ? "uplift.model = \"seepage\"" : "uplift is not by seepage",
                     "one Darcy solution of the rock box"};
         },
         .remove = without_seepage,
         .part_of = part_of_uplift,
         .named = Effect::seepage},
        {.name = "base crack",
         .decide = decide_base_crack,
         .remove = [](Scene s, const SeepagePoints&) -> RemovalAnswer {
             s.uplift->crack = CrackRule::none;
             return Removal{s, "uplift.crack = \"none\""};
         },
         .leave_out =
             [](Scene& s, const EffectPlan& plan) { // finite elements: limit equilibrium beside them needs it
                 if (plan.method == Method::rigid_block && s.uplift) s.uplift->crack = CrackRule::none;
             },
         .part_of = part_of_uplift,
         .named = Effect::base_crack},
        {.name = "drains",
         .decide = [](const Scene& s, Method) -> Decision {
             return {s.drains.has_value(), s.drains ? "[drains] is given" : "no [drains]",
                     "part of the pressure profile"};
         },
         .remove = without_drains,
         .leave_out = [](Scene& s, const EffectPlan&) { s.drains.reset(); },
         .part_of = part_of_uplift,
         .named = Effect::drains},
    };
}

} // namespace damslip
