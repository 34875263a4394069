#include "fe2d/element/shape.hpp"

#include <numbers>

namespace damslip::fe2d {

ExtraNodes extra_nodes(const Element& element)
{
    ExtraNodes extra;
    for (int i = 0; i < 4; ++i) extra.mid[i] = element.mid[i] >= 0;
    extra.centre = element.centre >= 0;
    return extra;
}

QuadraturePoint q4_point(const Corners& corners, double xi, double eta)
{
    static constexpr double sx[4] = {-1, 1, 1, -1}, sy[4] = {-1, -1, 1, 1};
    QuadraturePoint point{.xi = xi,
                          .eta = eta,
                          .weight = 0.0,
                          .shape = Eigen::Vector4d::Zero(),
                          .gradient = Eigen::Matrix<double, 2, 4>::Zero()};
    Eigen::Matrix<double, 2, 4> natural;
    Eigen::Matrix<double, 4, 2> x;
    for (int i = 0; i < 4; ++i) {
        point.shape[i] = 0.25 * (1.0 + sx[i] * xi) * (1.0 + sy[i] * eta);
        natural(0, i) = 0.25 * sx[i] * (1.0 + sy[i] * eta);
        natural(1, i) = 0.25 * sy[i] * (1.0 + sx[i] * xi);
        x.row(i) << corners[i].x, corners[i].y;
    }
    const Eigen::Matrix2d jacobian = natural * x;
    point.weight = jacobian(0, 0) * jacobian(1, 1) - jacobian(0, 1) * jacobian(1, 0);
    Eigen::Matrix2d inverse;
    inverse << jacobian(1, 1), -jacobian(0, 1), -jacobian(1, 0), jacobian(0, 0);
    point.gradient = inverse * natural / point.weight;
    return point;
}

std::array<QuadraturePoint, 4> q4_points(const Corners& corners)
{
    const double g = 1.0 / std::numbers::sqrt3;
    return {q4_point(corners, -g, -g), q4_point(corners, g, -g), q4_point(corners, g, g), q4_point(corners, -g, g)};
}

std::array<QuadraturePoint, 3> t3_points(const Corners& c)
{
    const double twice_area = (c[1].x - c[0].x) * (c[2].y - c[0].y) - (c[2].x - c[0].x) * (c[1].y - c[0].y);
    QuadraturePoint point{.xi = 0.0,
                          .eta = 0.0,
                          .weight = twice_area / 6.0,
                          .shape = Eigen::Vector4d::Zero(),
                          .gradient = Eigen::Matrix<double, 2, 4>::Zero()};
    point.gradient << c[1].y - c[2].y, c[2].y - c[0].y, c[0].y - c[1].y, 0.0, //
        c[2].x - c[1].x, c[0].x - c[2].x, c[1].x - c[0].x, 0.0;
    point.gradient /= twice_area;
    std::array<QuadraturePoint, 3> points{point, point, point};
    points[0].shape << 0.5, 0.5, 0.0, 0.0;
    points[1].shape << 0.0, 0.5, 0.5, 0.0;
    points[2].shape << 0.5, 0.0, 0.5, 0.0;
    return points;
}

} // namespace damslip::fe2d
