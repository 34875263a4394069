#include "scene/effect_row.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace damslip {

namespace {

Decision decide_anchors(const Scene& s, Method method)
{
    const auto through_base =
        std::count_if(s.anchors.begin(), s.anchors.end(), [](const Anchor& a) { return a.joint.empty(); });
    if (s.anchors.empty()) return {false, "no [[anchor]]", ""};
    if (method == Method::finite_elements)
        return {true, fmt::format("{} [[anchor]]", s.anchors.size()), "a spring of rank one on two pairs each"};
    if (through_base == 0) return {false, "no [[anchor]] through the base", ""};
    return {true, fmt::format("{} [[anchor]] through the base", through_base),
            "a force that follows the slip, its states events of the integration"};
}

} // namespace

std::vector<EffectRow> anchor_effects()
{
    return {{.name = "anchors",
             .decide = decide_anchors,
             .remove = [](Scene s, const SeepagePoints&) -> RemovalAnswer {
                 s.anchors.clear();
                 return Removal{s, "no [[anchor]]"};
             },
             .leave_out = [](Scene& s, const EffectPlan&) { s.anchors.clear(); }}};
}

} // namespace damslip
