#include "scene/effect_row.hpp"
#include "scene/vertical_motion.hpp"

#include <algorithm>

namespace damslip {

namespace {

Decision decide_vertical_motion(const Scene& s, Method)
{
    if (!any_vertical_record(s)) return {false, "no record has a vertical component", ""};
    return {s.motion.vertical, s.motion.vertical ? "records have vertical components" : "motion.vertical = false",
            "one more sample per step; the yield acceleration varies in time"};
}

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
    return {s.sliding.two_way, s.sliding.two_way ? "sliding.two_way = true" : "sliding.two_way = false",
            "a second yield acceleration"};
}

RemovalAnswer without_lift_off(Scene s, const SeepagePoints&)
{
    if (s.sliding.lift_off == LiftOff::no_friction)
        return Stays{"no-friction is the simplest answer to a base without normal force; see vertical motion"};
    s.sliding.lift_off = LiftOff::no_friction;
    return Removal{s, "sliding.lift_off = \"no-friction\": no flight"};
}

} // namespace

bool any_vertical_record(const Scene& s)
{
    return std::any_of(s.motion.records.begin(), s.motion.records.end(),
                       [](const RecordFiles& r) { return r.vertical.has_value(); });
}

std::vector<EffectRow> motion_effects()
{
    return {
        {.name = "vertical motion",
         .decide = decide_vertical_motion,
         .remove = [](Scene s, const SeepagePoints&) -> RemovalAnswer {
             s.motion.vertical = false;
             return Removal{s, "motion.vertical = false"};
         },
         .leave_out =
             [](Scene& s, const EffectPlan&) {
                 s.motion.vertical = false;
                 for (RecordFiles& record : s.motion.records) record.vertical.reset();
             },
         .named = Effect::vertical_motion},
        {.name = "lift-off",
         .decide = decide_lift_off,
         .remove = without_lift_off,
         .part_of = [](const EffectPlan&) { return Effect::vertical_motion; },
         .named = Effect::lift_off},
        {.name = "upstream sliding",
         .decide = decide_upstream_sliding,
         .remove = [](Scene s, const SeepagePoints&) -> RemovalAnswer {
             s.sliding.two_way = false;
             return Removal{s, "sliding.two_way = false"};
         },
         .leave_out =
             [](Scene& s, const EffectPlan& plan) {
                 if (plan.method == Method::rigid_block) s.sliding.two_way = false;
             },
         .named = Effect::upstream_sliding},
        {.name = "run-out",
         .decide = [](const Scene& s, Method) -> Decision {
             return {s.sliding.run_out_max > 0,
                     s.sliding.run_out_max > 0 ? "sliding.run_out_max_s > 0" : "sliding.run_out_max_s = 0",
                     "until it rests, only if still sliding at the record's end"};
         },
         .remove = [](Scene s, const SeepagePoints&) -> RemovalAnswer {
             s.sliding.run_out_max = 0.0;
             return Removal{s, "sliding.run_out_max_s = 0: the record's end is the end"};
         },
         .leave_out = [](Scene& s, const EffectPlan&) { s.sliding.run_out_max = 0.0; },
         .named = Effect::run_out},
    };
}

} // namespace damslip
