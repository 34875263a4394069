#include "fe2d/element/scalar.hpp"

#include "fe2d/element/quadratic.hpp"

namespace damslip::fe2d {

namespace {

ElementMatrix quadratic_gradient_matrix(const Corners& corners, int size, double conductivity, const ExtraNodes& extra)
{
    const int nodes = size + extra.count();
    ElementMatrix k = ElementMatrix::Zero(nodes, nodes);
    for (const QuadraticPoint& point : quadratic_points(corners, size, extra))
        k += conductivity * point.weight * point.gradient.transpose() * point.gradient;
    return k;
}

ElementMatrix quadratic_scalar_mass(const Corners& corners, int size, double capacity, const ExtraNodes& extra)
{
    const int nodes = size + extra.count();
    ElementMatrix m = ElementMatrix::Zero(nodes, nodes);
    for (const QuadraticPoint& point : quadratic_points(corners, size, extra))
        m += capacity * point.weight * point.shape * point.shape.transpose();
    return m;
}

} // namespace

ElementMatrix scalar_gradient_matrix(const Corners& corners, int size, double conductivity, const ExtraNodes& extra)
{
    if (extra.any()) return quadratic_gradient_matrix(corners, size, conductivity, extra);
    ElementMatrix k = ElementMatrix::Zero(size, size);
    const auto add = [&](const QuadraturePoint& point) {
        const auto gradient = point.gradient.leftCols(size);
        k += conductivity * point.weight * gradient.transpose() * gradient;
    };
    if (size == 3)
        for (const auto& point : t3_points(corners)) add(point);
    else
        for (const auto& point : q4_points(corners)) add(point);
    return k;
}

ElementMatrix scalar_mass_matrix(const Corners& corners, int size, double capacity, const ExtraNodes& extra)
{
    if (extra.any()) return quadratic_scalar_mass(corners, size, capacity, extra);
    ElementMatrix m = ElementMatrix::Zero(size, size);
    const auto add = [&](const QuadraturePoint& point) {
        m += capacity * point.weight * point.shape.head(size) * point.shape.head(size).transpose();
    };
    if (size == 3)
        for (const auto& point : t3_points(corners)) add(point);
    else
        for (const auto& point : q4_points(corners)) add(point);
    return m;
}

Eigen::Vector2d scalar_gradient(const Corners& corners, int size, const ElementVector& values)
{
    const QuadraturePoint point = size == 3 ? t3_points(corners)[0] : q4_point(corners, 0.0, 0.0);
    return point.gradient.leftCols(size) * values.head(size);
}

} // namespace damslip::fe2d
