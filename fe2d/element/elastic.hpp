#pragma once

#include "fe2d/element/shape.hpp"
#include "scene/scene.hpp"

#include <Eigen/Core>

/// Plane strain elements. Element unknowns in the order (u_x0, u_y0, u_x1, u_y1, ...): corners, middle nodes, centre
/// (Element::all); 6 for linear triangles and 8 for linear quadrilaterals, up to 18 with `extra` nodes; matrices are per
/// metre of dam length. `size` is the number of corners, 3 or 4.
namespace damslip::fe2d {

using ElementMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 18, 18>; ///< no heap
using ElementVector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 18, 1>;
using NodalStress = Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, 9>;

/// Displacement field of linear quadrilaterals; all other elements have one kind only.
enum class Q4Kind {
    plain,       ///< bilinear displacement, 2 x 2 Gauss points; locks in bending
    incompatible ///< with the modes 1 - xi^2, 1 - eta^2, corrected to pass the patch test: Wilson, Taylor, Doherty,
                 ///< Ghaboussi (1973); Taylor, Beresford, Wilson (1976), Int. J. Numer. Meth. Engng 10, 1211-1219
};

/// lumped: diagonal; row sums of linear elements, and of quadratic ones, whose row sums are negative or zero at corners,
/// the consistent diagonal scaled to the element's mass: Hinton, Rock, Zienkiewicz (1976), Earthq. Engng Struct. Dyn. 4,
/// 245-249.
enum class MassKind { consistent, lumped };

/// The kind of linear quadrilaterals in a mesh of these elements. Quadratic kinds: with the incompatible modes, for
/// elements whose edges all lie on contact planes; t3, t6: plain (quadrilaterals are split by the mesh).
Q4Kind q4_kind(ElementKind kind);

/// Integral of B^T D B [Pa]. The incompatible modes are condensed out.
ElementMatrix elastic_stiffness(const Corners& corners, int size, const Eigen::Matrix3d& d, Q4Kind kind,
                                const ExtraNodes& extra = {});

/// Integral of rho N^T N [kg/m]; the incompatible modes carry no mass.
ElementMatrix elastic_mass(const Corners& corners, int size, double density, MassKind kind,
                           const ExtraNodes& extra = {});

/// Integral of N^T b [N/m] for a constant force per volume b [N/m^3].
ElementVector body_force(const Corners& corners, int size, const Eigen::Vector2d& force, const ExtraNodes& extra = {});

/// Stresses (xx, yy, xy) [Pa] at the element's nodes, one column per node: quadrilaterals extrapolate bilinearly from
/// the 2 x 2 Gauss points (incompatible modes recovered from the displacement), linear triangles are constant, those of
/// quadratic triangles linear.
NodalStress nodal_stress(const Corners& corners, int size, const Eigen::Matrix3d& d, Q4Kind kind,
                         const ElementVector& u, const ExtraNodes& extra = {});

/// Stress (xx, yy, xy) [Pa] at the element's centre, where linear elements are most accurate; of quadratic
/// quadrilaterals the mean of the 2 x 2 Gauss points.
Eigen::Vector3d centre_stress(const Corners& corners, int size, const Eigen::Matrix3d& d, Q4Kind kind,
                              const ElementVector& u, const ExtraNodes& extra = {});

} // namespace damslip::fe2d
