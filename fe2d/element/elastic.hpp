#pragma once

#include "core/geometry.hpp"
#include "fe2d/mesh/mesh.hpp"
#include "scene/scene.hpp"

#include <Eigen/Core>

#include <array>
#include <vector>

/// Shape functions and quadrature of quadrilaterals and triangles with straight edges: linear ones, and those
/// with nodes in the middle of edges or at the centre.
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

/// Plane strain elements. Element unknowns in the order (u_x0, u_y0, u_x1, u_y1, ...): corners, middle nodes, centre
/// (Element::all); 6 for linear triangles and 8 for linear quadrilaterals, up to 18 with `extra` nodes; matrices are per
/// metre of dam length. `size` is the number of corners, 3 or 4.

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

/// Elements with one unknown per node: acoustic pressure, hydraulic head. 3 x 3 for linear triangles, 4 x 4 for linear
/// quadrilaterals, up to 9 x 9 with `extra` nodes.

/// Integral of k grad N^T grad N, per metre of dam length; `conductivity` k is 1/rho for acoustics [m^3/kg], the
/// permeability for Darcy flow [m/s].
ElementMatrix scalar_gradient_matrix(const Corners& corners, int size, double conductivity,
                                     const ExtraNodes& extra = {});

/// Integral of s N^T N; `capacity` s is 1/K_w for acoustics [1/Pa].
ElementMatrix scalar_mass_matrix(const Corners& corners, int size, double capacity, const ExtraNodes& extra = {});

/// Linear elastic isotropic material.
struct ElasticMaterial {
    double density = 0.0;       ///< [kg/m^3]; 0: massless
    double young_modulus = 0.0; ///< [Pa], > 0
    double poisson_ratio = 0.0; ///< [-], 0 <= nu < 0.5
};

/// Stress (xx, yy, xy) of plane strain from strain (xx, yy, 2 xy): D of sigma = D epsilon [Pa]; tension positive.
Eigen::Matrix3d plane_strain_matrix(const ElasticMaterial& material);

/// The material whose plane strain matrix is the plane stress matrix of `material`, same density:
///     E' = E (1 + 2 nu) / (1 + nu)^2,   nu' = nu / (1 + nu).
/// For comparing with published plane stress results; the out-of-plane stress has no meaning then.
ElasticMaterial plane_stress_equivalent(const ElasticMaterial& material);

/// Checked material of a scene. @throws InputError naming `key` when there is no Young's modulus: FE needs one.
ElasticMaterial elastic_material(const Material& material, const Scene& scene, const char* key);

// Elements with nodes in the middle of some or all edges, and at the centre: Q8, Q9, T6 and the transition elements
// between them and linear ones. Straight edges with the node in the middle: the mapping is that of the corners.
//
// Shape functions are built up from the corners' (Bathe, Finite Element Procedures, 1996, fig. 5.4 and 5.12): a node
// that is there takes its share from those before it, a node that is not leaves its edge linear. Quadrilaterals with a
// centre hold every quadratic field on any straight-sided shape; without it only on parallelograms (Lee & Bathe 1993,
// Int. J. Numer. Meth. Engng 36, 3553-3576; Arnold, Boffi & Falk 2002, Math. Comp. 71, 909-922).

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
