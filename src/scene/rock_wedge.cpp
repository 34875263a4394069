#include "scene/rock_wedge.hpp"

#include <algorithm>
#include <cmath>

namespace damslip {

namespace {

constexpr double joint_water_density = 1000.0; // [kg/m^3]

/// Of the line common to two planes, up; zero for parallel planes.
Vector3 upward_line(const Vector3& a, const Vector3& b)
{
    const Vector3 line = unit(cross(a, b));
    return line[2] < 0.0 ? Vector3{-line[0], -line[1], -line[2]} : line;
}

/// Where the line through the origin meets the plane of normal n through p; nothing where it is parallel to it.
std::optional<Vector3> meets(const Vector3& line, const Vector3& n, const Vector3& p)
{
    const double rise = dot(n, line);
    if (std::abs(rise) < 1e-9) return std::nullopt;
    return sum({}, dot(n, p) / rise, line);
}

} // namespace

std::optional<WedgeShape> wedge_shape(const RockWedge& w)
{
    if (!w.height || !w.face_dip || !w.face_dip_direction || w.planes.size() != 2) return std::nullopt;
    const Vector3 first = plane_normal(w.planes[0].dip, w.planes[0].dip_direction),
                  second = plane_normal(w.planes[1].dip, w.planes[1].dip_direction),
                  face = plane_normal(*w.face_dip, *w.face_dip_direction),
                  upper =
                      plane_normal(w.upper_dip.value_or(0.0), w.upper_dip_direction.value_or(*w.face_dip_direction));
    const Vector3 line = upward_line(first, second);
    if (!(line[2] > 1e-9)) return std::nullopt;
    WedgeShape s;
    s.top = sum({}, *w.height / line[2], line);
    const auto a = meets(cross(first, face), upper, s.top), b = meets(cross(second, face), upper, s.top);
    if (!a || !b) return std::nullopt;
    s.first_crest = *a;
    s.second_crest = *b;
    // The tetrahedron is what the four planes bound on the rock's side when its middle lies on that side of each.
    const Vector3 middle = sum({}, 0.25, sum(s.top, 1.0, sum(s.first_crest, 1.0, s.second_crest)));
    const double least = 1e-9 * *w.height;
    if (dot(first, middle) < least || dot(second, middle) < least || dot(face, middle) > -least ||
        dot(upper, sum(middle, -1.0, s.top)) > -least)
        return std::nullopt;
    s.volume = std::abs(dot(s.top, cross(s.first_crest, s.second_crest))) / 6.0;
    s.first_area = 0.5 * norm(cross(s.top, s.first_crest));
    s.second_area = 0.5 * norm(cross(s.top, s.second_crest));
    if (!std::isfinite(s.volume) || !(s.volume > 0.0)) return std::nullopt;
    return s;
}

std::optional<double> line_length(const RockWedge& wedge)
{
    const auto shape = wedge_shape(wedge);
    return shape ? std::optional(norm(shape->top)) : std::nullopt;
}

std::optional<double> plane_length(const RockWedge& wedge, std::size_t plane)
{
    const auto shape = wedge_shape(wedge);
    if (!shape) return std::nullopt;
    const Vector3& crest = plane == 0 ? shape->first_crest : shape->second_crest;
    return std::max({norm(shape->top), norm(crest), norm(sum(shape->top, -1.0, crest))});
}

double wedge_volume(const RockWedge& w)
{
    if (w.volume) return *w.volume;
    const auto shape = wedge_shape(w);
    return shape ? shape->volume : 0.0;
}

double wedge_area(const RockWedge& w, std::size_t plane)
{
    if (w.planes[plane].area) return *w.planes[plane].area;
    const auto shape = wedge_shape(w);
    if (!shape) return 0.0;
    return plane == 0 ? shape->first_area : shape->second_area;
}

double wedge_water_pressure(const RockWedge& w, std::size_t plane, double gravity)
{
    if (w.planes[plane].water_pressure) return *w.planes[plane].water_pressure;
    return w.water == WedgeWater::full ? joint_water_density * gravity * w.height.value_or(0.0) / 6.0 : 0.0;
}

} // namespace damslip
