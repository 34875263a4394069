#include "scene/checks.hpp"

#include "core/number.hpp"
#include "core/units.hpp"
#include "scene/wedge_shape.hpp"

#include <fmt/format.h>

namespace damslip::checks {

namespace {

std::string degrees(double angle)
{
    return fmt::format("{:.5g}", angle / units::degree);
}

std::string orientation(double dip, double direction)
{
    return degrees(dip) + "/" + degrees(direction);
}

void check_surfaces(const RockWedge& w, Findings& f)
{
    const bool surfaces = w.face_dip || w.face_dip_direction || w.upper_dip || w.upper_dip_direction;
    const char* both = "height_m with face_dip_deg and face_dip_direction_deg, or volume_m3 with the planes' area_m2";
    if (w.volume && (w.height || surfaces))
        f.wrong("wedge.volume", value("wedge.volume_m3", *w.volume) + " is given together with height or surfaces.",
                both, "delete one of the two descriptions");
    if (!w.volume && !w.height)
        f.wrong("wedge", "wedge.height_m is missing.", both, "add  height_m = 40  or  volume_m3 = 6700  to [wedge]");
    if (w.height && !w.volume && (!w.face_dip || !w.face_dip_direction))
        f.wrong("wedge", fmt::format("wedge.{} is missing.", w.face_dip ? "face_dip_direction_deg" : "face_dip_deg"),
                both, w.face_dip ? "add  face_dip_direction_deg = 185" : "add  face_dip_deg = 65");
    if (w.upper_dip && *w.upper_dip > 0.0 && !w.upper_dip_direction && !w.face_dip_direction)
        f.wrong("wedge.upper_dip", "wedge.upper_dip_deg is given without upper_dip_direction_deg.", "both",
                "add  upper_dip_direction_deg = 195");
    if (w.water == WedgeWater::full && !w.height)
        f.wrong("wedge.water", "wedge.water = \"full\" is given without wedge.height_m.",
                "height_m, which the pressure γ_w H/6 follows from", "give water_pressure_kPa of each [[wedge.plane]]");
}

void check_planes(const RockWedge& w, Findings& f)
{
    if (w.planes.size() != 2)
        return f.wrong("wedge", fmt::format("the wedge has {} [[wedge.plane]].", w.planes.size()), "two",
                       w.planes.size() < 2 ? "add [[wedge.plane]] with dip_deg, dip_direction_deg and friction_deg"
                                           : "delete what is not one of the two planes");
    for (std::size_t i = 0; i < 2; ++i) {
        const RockPlane& p = w.planes[i];
        const std::string label = fmt::format("wedge.plane[{}]", i + 1);
        if (w.height && p.area)
            f.wrong(label + ".area",
                    value((label + ".area_m2").c_str(), *p.area) + " is given together with wedge.height_m.",
                    "areas follow from the shape", "delete area_m2");
        if (w.volume && !p.area)
            f.wrong(label, label + ".area_m2 is missing.", "the area of each plane beside wedge.volume_m3",
                    "add  area_m2 = 885");
        if (w.water == WedgeWater::full && p.water_pressure)
            f.wrong(label + ".water_pressure",
                    value((label + ".water_pressure_kPa").c_str(), *p.water_pressure / units::kPa) +
                        " is given together with wedge.water = \"full\".",
                    "one of the two", "delete wedge.water, or water_pressure_kPa");
    }
    if (w.planes[0].name == w.planes[1].name)
        f.wrong("wedge.plane[2].name", fmt::format("two planes are named \"{}\".", w.planes[0].name),
                "names that differ", "rename one");
    const RockPlane &a = w.planes[0], &b = w.planes[1];
    const Vector3 line = cross(plane_normal(a.dip, a.dip_direction), plane_normal(b.dip, b.dip_direction));
    if (!(norm(line) > 1e-6))
        f.wrong("wedge.plane[2]",
                fmt::format("the planes {} and {} (dip/dip direction) are parallel.",
                            orientation(a.dip, a.dip_direction), orientation(b.dip, b.dip_direction)),
                "two planes that meet in a line", "for one plane alone describe a rock slope in [section]");
}

void check_shape(const RockWedge& w, Findings& f)
{
    if (wedge_shape(w)) return;
    const RockPlane &a = w.planes[0], &b = w.planes[1];
    const Vector3 cut = cross(plane_normal(a.dip, a.dip_direction), plane_normal(b.dip, b.dip_direction));
    const Vector3 line = unit(cut[2] > 0.0 ? Vector3{-cut[0], -cut[1], -cut[2]} : cut);
    f.wrong("wedge.height",
            fmt::format("the planes {} and {}, the face {} and the upper ground {} bound no wedge: the line of "
                        "intersection plunges {} degrees towards {}.",
                        orientation(a.dip, a.dip_direction), orientation(b.dip, b.dip_direction),
                        orientation(*w.face_dip, *w.face_dip_direction),
                        orientation(w.upper_dip.value_or(0.0), w.upper_dip_direction.value_or(*w.face_dip_direction)),
                        degrees(plunge(line)), degrees(trend(line))),
            "a line of intersection that comes out in the face: it plunges less than the face and more than the upper "
            "ground dip in that direction, and the planes rise to both sides of it",
            "check dips and dip directions (azimuths clockwise from north)");
}

} // namespace

void check_wedge(const Scene& s, Findings& f)
{
    check_surfaces(*s.wedge, f);
    check_planes(*s.wedge, f);
    if (!f.any() && s.wedge->height) check_shape(*s.wedge, f);
}

} // namespace damslip::checks
