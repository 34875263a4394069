#include "verification/exact/wedge_short_solution.hpp"

#include "core/geometry.hpp"

#include <algorithm>
#include <cmath>

namespace damslip::exact {

namespace {

Vector3 pole(DipAndDirection p)
{
    return plane_normal(p.dip, p.direction);
}

/// The line two planes have in common, pointing down.
Vector3 common_line(DipAndDirection p, DipAndDirection q)
{
    const Vector3 line = unit(cross(pole(p), pole(q)));
    return line[2] > 0.0 ? Vector3{-line[0], -line[1], -line[2]} : line;
}

/// Between two axes, 0 ... pi/2.
double between_axes(const Vector3& a, const Vector3& b)
{
    return std::acos(std::min(1.0, std::abs(dot(a, b))));
}

} // namespace

WedgeAngles wedge_angles(DipAndDirection a, DipAndDirection b, DipAndDirection face, DipAndDirection upper)
{
    const Vector3 l1 = common_line(a, face), l2 = common_line(b, face), l3 = common_line(a, upper),
                  l4 = common_line(b, upper), l5 = common_line(a, b);
    // A wedge: lines 1 and 2 rise to either side, so angles between lines of one plane may pass 90 degrees; their sines serve.
    return {a.dip,
            b.dip,
            std::asin(-l5[2]),
            std::acos(dot(pole(a), pole(b))),
            between_axes(l2, l4),
            between_axes(l4, l5),
            between_axes(l2, pole(a)),
            between_axes(l1, l3),
            between_axes(l3, l5),
            between_axes(l1, pole(b))};
}

ShortSolution short_solution(const WedgeAngles& t)
{
    const double below = std::sin(t.psi_5) * std::pow(std::sin(t.na_nb), 2), c = std::cos(t.na_nb);
    return {std::sin(t.t24) / (std::sin(t.t45) * std::cos(t.t2na)),
            std::sin(t.t13) / (std::sin(t.t35) * std::cos(t.t1nb)), (std::cos(t.psi_a) - std::cos(t.psi_b) * c) / below,
            (std::cos(t.psi_b) - std::cos(t.psi_a) * c) / below};
}

double ShortSolution::factor(double height, double rock, double water, double c_a, double phi_a, double c_b,
                             double phi_b) const
{
    return 3.0 / (rock * height) * (c_a * x + c_b * y) + (a - water * x / (2.0 * rock)) * std::tan(phi_a) +
           (b - water * y / (2.0 * rock)) * std::tan(phi_b);
}

} // namespace damslip::exact
