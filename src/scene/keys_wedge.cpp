#include "scene/key_parts.hpp"
#include "scene/keys.hpp"

namespace damslip::keys {

namespace {

const Units volume{{"m3", 1.0}};
const Units area{{"m2", 1.0}};
const Units point_force{{"kN", 1e3}, {"MN", 1e6}, {"N", 1.0}};
const Range azimuth_range = Range::between(0, 360);
const Range dip_range = Range::between(0, 90);

/// [[wedge.<name>]], a list of the wedge.
template <class T>
KeyGroup wedge_list(std::string name, std::string meaning, std::vector<T> RockWedge::*list, std::vector<Key> keys)
{
    return {std::move(name),
            Presence::list,
            std::move(meaning),
            std::move(keys),
            [list](Scene& s) -> void* {
                if (!s.wedge) s.wedge.emplace();
                return &((*s.wedge).*list).emplace_back();
            },
            [list](const Scene& s) {
                std::vector<const void*> items;
                if (s.wedge)
                    for (const T& item : (*s.wedge).*list) items.push_back(&item);
                return items;
            }};
}

KeyGroup wedge_group()
{
    using W = RockWedge;
    return optional_group(
        "wedge",
        "A rock wedge on two planes instead of a section; the scene then has no [section], [dam], [contact] nor what "
        "belongs to "
        "them. Its shape: `height_m` with face and upper ground, or `volume_m3` with the planes' areas.",
        &Scene::wedge,
        {number("density", density, Range::half_open(0, 1e5), "required", "of the rock", "2600", at(&W::density)),
         number("height", length, Range::half_open(0, 1e4), "required without volume_m3",
                "vertical distance between the ends of the line of intersection, in the face and in the upper ground",
                "40", at(&W::height)),
         number("face_dip", angle, Range::half_open(0, 90), "required with height_m", "dip of the slope's face", "65",
                at(&W::face_dip)),
         number("face_dip_direction", angle, azimuth_range, "required with height_m",
                "azimuth the face dips to, clockwise from north", "185", at(&W::face_dip_direction)),
         number("upper_dip", angle, Range{0, 90, false, true}, "0 (level)", "dip of the ground above the face", "12",
                at(&W::upper_dip)),
         number("upper_dip_direction", angle, azimuth_range, "the face's", "azimuth it dips to", "195",
                at(&W::upper_dip_direction)),
         number("volume", volume, Range::half_open(0, 1e12), "from the shape",
                "of the wedge, in place of height and surfaces", "6700", at(&W::volume)),
         word("water", "dry",
              "dry, or full: both planes are full of water that seeps out of the face, mean pressure γ_w H/6 on each",
              "\"full\"",
              choice(&W::water, std::vector<std::pair<std::string, WedgeWater>>{{"dry", WedgeWater::dry},
                                                                                {"full", WedgeWater::full}})),
         word("cohesion_lost_at_slip", "true", "cohesion is gone from the first slip on", "false",
              at(&W::cohesion_lost_at_slip)),
         number("motion_azimuth", angle, azimuth_range, "where the wedge slides to by itself",
                "positive samples of the horizontal component drive the wedge towards this azimuth (the ground "
                "accelerates the other way)",
                "158", at(&W::motion_azimuth))});
}

} // namespace

std::vector<KeyGroup> wedge_groups()
{
    using P = RockPlane;
    using F = WedgeForce;
    return {
        wedge_group(),
        wedge_list<P>(
            "wedge.plane", "One of the two planes the wedge rests on.", &RockWedge::planes,
            {word("name", "plane 1, plane 2", "name in the tables", "\"A\"", at(&P::name)),
             number("dip", angle, dip_range, "required", "from the horizontal", "45", at(&P::dip)),
             number("dip_direction", angle, azimuth_range, "required", "azimuth it dips to, clockwise from north",
                    "105", at(&P::dip_direction)),
             number("friction", friction, Range::between(0, 10), "required", "Coulomb mu", "0.58", at(&P::friction)),
             number("cohesion", stress, Range::between(0, 1e6), "0", "on the whole plane", "24", at(&P::cohesion)),
             number("area", area, Range::between(0, 1e9), "from the shape; required with volume_m3",
                    "of the wedge on the plane", "885", at(&P::area)),
             number("water_pressure", stress, Range::between(0, 1e6), "by wedge.water",
                    "mean over the plane, lifts the wedge", "65", at(&P::water_pressure))}),
        wedge_list<F>(
            "wedge.force", "A steady force on the wedge: an anchor, a surcharge, water in a tension crack.",
            &RockWedge::forces,
            {word("name", "force", "name in the tables", "\"anchors\"", at(&F::name)),
             number("force", point_force, Range::half_open(0, 1e9), "required", "its size", "5000", at(&F::force)),
             number("trend", angle, azimuth_range, "required", "azimuth it pushes to", "355", at(&F::trend)),
             number("plunge", angle, Range::between(-90, 90), "required", "below the horizontal, positive down", "5",
                    at(&F::plunge))})};
}

} // namespace damslip::keys
