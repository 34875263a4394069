#pragma once

#include "fe2d/element/elastic.hpp"

#include <vector>

/// Elements with nodes in the middle of some or all edges, and at the centre: Q8, Q9, T6 and the transition elements
/// between them and linear ones. Straight edges with the node in the middle: the mapping is that of the corners.
///
/// Shape functions are built up from the corners' (Bathe, Finite Element Procedures, 1996, fig. 5.4 and 5.12): a node
/// that is there takes its share from those before it, a node that is not leaves its edge linear. Quadrilaterals with a
/// centre hold every quadratic field on any straight-sided shape; without it only on parallelograms (Lee & Bathe 1993,
/// Int. J. Numer. Meth. Engng 36, 3553-3576; Arnold, Boffi & Falk 2002, Math. Comp. 71, 909-922).
namespace damslip::fe2d {

/// One quadrature point in the global axes.
struct QuadraticPoint {
    double weight = 0.0;                                                      ///< includes the Jacobian [m^2]
    Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 9, 1> shape;    ///< N_i [-], in the order of Element::all
    Eigen::Matrix<double, 2, Eigen::Dynamic, Eigen::ColMajor, 2, 9> gradient; ///< dN_i/dx, dN_i/dy [1/m]
};

/// Shape functions at a place of the element: xi, eta in -1 ... 1 of quadrilaterals; of triangles the area coordinates
/// of the second and third corner. The weight is the Jacobian's determinant.
QuadraticPoint quadratic_point(const Corners& corners, int size, const ExtraNodes& extra, double xi, double eta);

/// 3 x 3 Gauss points of quadrilaterals, exact to degree 5 in each direction; 6 points of triangles, exact to degree 4
/// (Strang & Fix, An Analysis of the Finite Element Method, 1973).
std::vector<QuadraticPoint> quadratic_points(const Corners& corners, int size, const ExtraNodes& extra);

ElementMatrix quadratic_stiffness(const Corners& corners, int size, const ExtraNodes& extra, const Eigen::Matrix3d& d);
ElementMatrix quadratic_mass(const Corners& corners, int size, const ExtraNodes& extra, double density, MassKind kind);
ElementVector quadratic_body_force(const Corners& corners, int size, const ExtraNodes& extra,
                                   const Eigen::Vector2d& force);

/// Quadrilaterals: bilinear from the 2 x 2 Gauss points, where the stresses of quadratic elements are most accurate
/// (Barlow 1976, Int. J. Numer. Meth. Engng 10, 243-251); triangles: at the nodes themselves.
NodalStress quadratic_nodal_stress(const Corners& corners, int size, const ExtraNodes& extra, const Eigen::Matrix3d& d,
                                   const ElementVector& u);
Eigen::Vector3d quadratic_centre_stress(const Corners& corners, int size, const ExtraNodes& extra,
                                        const Eigen::Matrix3d& d, const ElementVector& u);

} // namespace damslip::fe2d
