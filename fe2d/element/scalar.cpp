#include "fe2d/element/scalar.hpp"

namespace damslip::fe2d {

ElementMatrix scalar_gradient_matrix(const Corners& corners, int size, double conductivity)
{
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

ElementMatrix scalar_mass_matrix(const Corners& corners, int size, double capacity)
{
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
