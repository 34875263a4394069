#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace damslip {

/// A point of the section; x downstream, y up, heel of the dam at the origin [m].
struct Point {
    double x = 0.0;
    double y = 0.0;
    friend bool operator==(const Point&, const Point&) = default;
};

using Polyline = std::vector<Point>;

/// Directions in space; x east, y north, z up. Angles in rad, azimuths clockwise from north.

using Vector3 = std::array<double, 3>;

inline double dot(const Vector3& a, const Vector3& b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline Vector3 cross(const Vector3& a, const Vector3& b)
{
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// a + factor b.
inline Vector3 sum(const Vector3& a, double factor, const Vector3& b)
{
    return {a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]};
}

inline double norm(const Vector3& a)
{
    return std::sqrt(dot(a, a));
}

/// Zero stays zero.
inline Vector3 unit(const Vector3& a)
{
    const double length = norm(a);
    return length > 0.0 ? Vector3{a[0] / length, a[1] / length, a[2] / length} : Vector3{};
}

/// Upward unit normal of a plane by its dip and dip direction.
inline Vector3 plane_normal(double dip, double dip_direction)
{
    return {std::sin(dip) * std::sin(dip_direction), std::sin(dip) * std::cos(dip_direction), std::cos(dip)};
}

/// Unit vector of a line by its trend and its plunge, positive down.
inline Vector3 line_direction(double trend, double plunge)
{
    return {std::cos(plunge) * std::sin(trend), std::cos(plunge) * std::cos(trend), -std::sin(plunge)};
}

/// Azimuth of the horizontal part, 0 ... 2 pi; 0 for a vertical vector.
inline double trend(const Vector3& a)
{
    const double angle = std::atan2(a[0], a[1]);
    return angle < 0.0 ? angle + 2.0 * std::numbers::pi : angle + 0.0; // + 0.0: never -0
}

/// Angle below the horizontal, positive down.
inline double plunge(const Vector3& a)
{
    return std::atan2(-a[2], std::hypot(a[0], a[1]));
}

} // namespace damslip
