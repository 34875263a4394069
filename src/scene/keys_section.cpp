#include "scene/key_parts.hpp"
#include "scene/keys.hpp"

namespace damslip::keys {

KeyGroup section_group(SectionInput& input)
{
    using S = SectionInput;
    KeyGroup g{
        "section",
        Presence::always,
        "Cross-section: either `polygon_m`, or `height_m`, `base_m`, `crest_m` and what refines them, or the block of "
        "a "
        "rock slope above a plane and before a tension crack: `slope_height_m`, `face_dip_deg`, `plane_dip_deg`, "
        "`crack_distance_m`.",
        {pairs("polygon", length, length, Range::any(), "from the dimensions below",
               "vertices counter-clockwise from the heel at (0, 0); the second is the toe; the edge between them is "
               "the base",
               "[[0, 0], [45, 0], [12, 51.5], [12, 62.5], [0, 62.5]]", at(&S::polygon)),
         number("height", length, Range::above(0), "required without polygon", "crest above the heel", "62.5",
                at(&S::height)),
         number("base", length, Range::above(0), "required without polygon", "horizontal length of the base", "45",
                at(&S::base)),
         number("crest", length, Range::at_least(0), "0 (triangle)", "width of the crest", "12", at(&S::crest)),
         number("neck", length, Range::at_least(0), "0",
                "the downstream face is vertical over this height below the crest, then runs straight to the toe", "11",
                at(&S::neck)),
         number("upstream_slope", none, Range::at_least(0), "0 (vertical)",
                "batter of the upstream face, horizontal per vertical", "0.1", at(&S::upstream_slope)),
         number("upstream_slope_height", length, Range::above(0), "the whole height",
                "the upstream face slopes from the heel to this height and is vertical above", "30",
                at(&S::upstream_slope_height)),
         number("base_inclination", angle, Range::inside(-45, 45), "0",
                "dip of the base, positive downstream: the toe lies below the heel", "5", at(&S::base_inclination)),
         number("slope_height", length, Range::above(0), "no rock slope",
                "rock slope: crest above the line where the plane comes out in the face", "12", at(&S::slope_height)),
         number("face_dip", angle, Range::inside(0, 90), "required with slope_height", "rock slope: dip of the face",
                "60", at(&S::face_dip)),
         number("plane_dip", angle, Range::inside(0, 45), "required with slope_height",
                "rock slope: dip of the plane the block slides on", "35", at(&S::plane_dip)),
         number("crack_distance", length, Range::any(), "required with slope_height",
                "rock slope: the vertical tension crack behind the crest, horizontally; negative: in the face. Water "
                "in the crack is [reservoir], its level_m the depth above the foot of the crack",
                "4", at(&S::crack_distance)),
         number("upper_dip", angle, Range::inside(-45, 45), "0",
                "rock slope: dip of the ground behind the crest, positive: it falls towards the crest", "5",
                at(&S::upper_dip))},
        [&input](Scene&) -> void* { return &input; },
        [&input](const Scene& s) {
            input = SectionInput{};
            input.polygon = s.section.polygon;
            return std::vector<const void*>{&input};
        }};
    return g;
}

} // namespace damslip::keys
