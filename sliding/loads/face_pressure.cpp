#include "sliding/loads/face_pressure.hpp"

#include <utility>

namespace damslip::sliding {

namespace {

/// The part of the straight piece a-b at or below the level; degenerate (both ends equal) if there is none.
std::pair<Point, Point> below(Point a, Point b, double level)
{
    if (a.y >= level && b.y >= level) return {a, a};
    if (a.y <= level && b.y <= level) return {a, b};
    const double s = (level - a.y) / (b.y - a.y);
    const Point cut{a.x + s * (b.x - a.x), level};
    return a.y < level ? std::pair{a, cut} : std::pair{cut, b};
}

/// Integral of f g over s in 0...1 for f, g linear with the given end values.
double product(double f0, double f1, double g0, double g1)
{
    return (2.0 * (f0 * g0 + f1 * g1) + f0 * g1 + f1 * g0) / 6.0;
}

} // namespace

FaceLoad hydrostatic_load(const Polyline& face, DamSide side, double level, double unit_weight)
{
    const double into_dam =
        side == DamSide::right ? 1.0 : -1.0; // normal into the dam: (dy, -dx) for a dam on the right
    FaceLoad load;
    for (std::size_t i = 0; i + 1 < face.size(); ++i) {
        const auto [a, b] = below(face[i], face[i + 1], level);
        const double pa = unit_weight * (level - a.y), pb = unit_weight * (level - b.y);
        const double nx = into_dam * (b.y - a.y), ny = -into_dam * (b.x - a.x); // length of the piece included
        load.horizontal += {0.5 * (pa + pb) * nx, 0.0, -product(pa, pb, a.y, b.y) * nx};
        load.vertical += {0.0, 0.5 * (pa + pb) * ny, product(pa, pb, a.x, b.x) * ny};
    }
    return load;
}

Force silt_thrust(const Polyline& upstream_face, double level, double submerged_unit_weight,
                  double pressure_coefficient)
{
    return hydrostatic_load(upstream_face, DamSide::right, level, pressure_coefficient * submerged_unit_weight)
        .horizontal;
}

} // namespace damslip::sliding
