#pragma once

#include "core/geometry.hpp"

namespace damslip::sliding {

/// A force per metre of dam length and its moment about the origin (the heel).
/// Signs: x downstream, y up, moment counter-clockwise: M = X Fy - Y Fx, so a downstream thrust above the heel has M <
/// 0.
struct Force {
    double x = 0.0;      ///< [N/m]
    double y = 0.0;      ///< [N/m]
    double moment = 0.0; ///< about the origin [N m/m]

    Force& operator+=(const Force& other)
    {
        x += other.x;
        y += other.y;
        moment += other.moment;
        return *this;
    }
    friend Force operator+(Force a, const Force& b) { return a += b; }
    friend Force operator*(double factor, const Force& f) { return {factor * f.x, factor * f.y, factor * f.moment}; }
    friend bool operator==(const Force&, const Force&) = default;
};

/// The force (x, y) [N/m] acting at a point [m].
inline Force force_at(Point at, double x, double y)
{
    return {x, y, at.x * y - at.y * x};
}

/// Moment of the force about another point [N m/m].
inline double moment_about(const Force& f, Point p)
{
    return f.moment - (p.x * f.y - p.y * f.x);
}

} // namespace damslip::sliding
