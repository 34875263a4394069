#include "scene/effect_row.hpp"

#include "scene/vertical_motion.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace damslip {

namespace {

Decision water_on_planes(const RockWedge& w)
{
    if (w.water == WedgeWater::full) return {true, "wedge.water = \"full\"", "one force on each plane"};
    const bool given = std::any_of(w.planes.begin(), w.planes.end(),
                                   [](const RockPlane& p) { return p.water_pressure.value_or(0.0) > 0.0; });
    return given ? Decision{true, "wedge.plane.water_pressure_kPa", "one force on each plane"}
                 : Decision{false, "wedge.water = \"dry\"", ""};
}

bool cohesive(const RockWedge& w)
{
    return std::any_of(w.planes.begin(), w.planes.end(), [](const RockPlane& p) { return p.cohesion > 0.0; });
}

Decision wedge_strength_loss(const RockWedge& w)
{
    if (!cohesive(w)) return {false, "no wedge.plane.cohesion_kPa to lose", ""};
    return w.cohesion_lost_at_slip
               ? Decision{true, "wedge.cohesion_lost_at_slip = true", "strength stages are events of the integration"}
               : Decision{false, "wedge.cohesion_lost_at_slip = false", ""};
}

Decision wedge_vertical_motion(const Scene& s)
{
    if (!any_vertical_record(s)) return {false, "no record has a vertical component", ""};
    return {s.motion.vertical, s.motion.vertical ? "records have vertical components" : "motion.vertical = false",
            "the yield acceleration varies in time"};
}

} // namespace

Decision decide_of_wedge(Effect effect, const Scene& s)
{
    const RockWedge& w = *s.wedge;
    switch (effect) {
    case Effect::user_forces:
        return {!w.forces.empty(),
                w.forces.empty() ? "no [[wedge.force]]" : fmt::format("{} [[wedge.force]]", w.forces.size()),
                "one force each"};
    case Effect::uplift:
        return water_on_planes(w);
    case Effect::cohesion:
        return {cohesive(w), cohesive(w) ? "wedge.plane.cohesion_kPa > 0" : "no wedge.plane.cohesion_kPa",
                "one force along the way of sliding"};
    case Effect::strength_loss:
        return wedge_strength_loss(w);
    case Effect::inclined_base:
        return {true, "[wedge]: two planes, the way of sliding is found", "one look at four cases"};
    case Effect::vertical_motion:
        return wedge_vertical_motion(s);
    case Effect::lift_off:
        return {false, "the way of sliding at the yield is kept; a note says where another would start", ""};
    case Effect::upstream_sliding:
        return {false, "a wedge slides one way; sliding up the slope is not followed", ""};
    case Effect::run_out:
        return {s.sliding.run_out_max > 0,
                s.sliding.run_out_max > 0 ? "sliding.run_out_max_s > 0" : "sliding.run_out_max_s = 0",
                "until it rests, only if still sliding at the record's end"};
    default:
        return {false, "a rock wedge has none", ""};
    }
}

} // namespace damslip
