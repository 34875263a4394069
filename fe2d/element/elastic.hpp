#pragma once

#include "fe2d/element/shape.hpp"
#include "scene/scene.hpp"

#include <Eigen/Core>

/// Plane strain elements. Element unknowns in the order (u_x0, u_y0, u_x1, u_y1, ...), 6 for triangles and 8 for
/// quadrilaterals; matrices are per metre of dam length.
namespace damslip::fe2d {

using ElementMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 8, 8>; ///< no heap
using ElementVector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 8, 1>;

/// Displacement field of quadrilaterals; triangles have one kind only.
enum class Q4Kind {
    plain,       ///< bilinear displacement, 2 x 2 Gauss points; locks in bending
    incompatible ///< with the modes 1 - xi^2, 1 - eta^2, corrected to pass the patch test: Wilson, Taylor, Doherty,
                 ///< Ghaboussi (1973); Taylor, Beresford, Wilson (1976), Int. J. Numer. Meth. Engng 10, 1211-1219
};

enum class MassKind { consistent, lumped }; ///< lumped: row sums, diagonal

Q4Kind q4_kind(ElementKind kind); ///< t3: plain (quadrilaterals are split by the mesh)

/// Integral of B^T D B [Pa]. The incompatible modes are condensed out. `size` is 3 or 4.
ElementMatrix elastic_stiffness(const Corners& corners, int size, const Eigen::Matrix3d& d, Q4Kind kind);

/// Integral of rho N^T N [kg/m]; the incompatible modes carry no mass.
ElementMatrix elastic_mass(const Corners& corners, int size, double density, MassKind kind);

/// Integral of N^T b [N/m] for a constant force per volume b [N/m^3].
ElementVector body_force(const Corners& corners, int size, const Eigen::Vector2d& force);

/// Stresses (xx, yy, xy) [Pa] at the element's nodes, one column per node: quadrilaterals extrapolate bilinearly from
/// the 2 x 2 Gauss points (incompatible modes recovered from the displacement), triangles are constant.
Eigen::Matrix<double, 3, 4> nodal_stress(const Corners& corners, int size, const Eigen::Matrix3d& d, Q4Kind kind,
                                         const ElementVector& u);

/// Stress (xx, yy, xy) [Pa] at the element's centre, where it is most accurate.
Eigen::Vector3d centre_stress(const Corners& corners, int size, const Eigen::Matrix3d& d, Q4Kind kind,
                              const ElementVector& u);

} // namespace damslip::fe2d
