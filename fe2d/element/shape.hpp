#pragma once

#include "core/geometry.hpp"
#include "fe2d/mesh/mesh.hpp"

#include <Eigen/Core>

#include <array>

/// Shape functions and quadrature of quadrilaterals and triangles with straight edges: linear ones here, those with
/// nodes in the middle of edges or at the centre in quadratic.hpp.
namespace damslip::fe2d {

using Corners = std::array<Point, 4>; ///< counter-clockwise; the fourth is not used by triangles

/// Which nodes an element has besides its corners.
struct ExtraNodes {
    std::array<bool, 4> mid{}; ///< in the middle of the edge from corner i to the next
    bool centre = false;       ///< quadrilaterals only

    bool any() const { return mid[0] || mid[1] || mid[2] || mid[3] || centre; }
    int count() const { return mid[0] + mid[1] + mid[2] + mid[3] + centre; }
};
ExtraNodes extra_nodes(const Element& element);

/// One quadrature point of an element in the global axes.
struct QuadraturePoint {
    double xi = 0.0, eta = 0.0;           ///< natural coordinates (quadrilaterals)
    double weight = 0.0;                  ///< includes the Jacobian: the weights of an element sum to its area [m^2]
    Eigen::Vector4d shape;                ///< N_i [-]; triangles: the fourth is zero
    Eigen::Matrix<double, 2, 4> gradient; ///< dN_i/dx, dN_i/dy [1/m]
};

/// 2 x 2 Gauss points of a quadrilateral, in the order (-,-), (+,-), (+,+), (-,+).
std::array<QuadraturePoint, 4> q4_points(const Corners& corners);

/// One point anywhere in a quadrilateral; its weight is the Jacobian's determinant [m^2].
QuadraturePoint q4_point(const Corners& corners, double xi, double eta);

/// Mid-edge points of a triangle: exact for quadratic integrands.
std::array<QuadraturePoint, 3> t3_points(const Corners& corners);

} // namespace damslip::fe2d
