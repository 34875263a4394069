#pragma once

#include "core/geometry.hpp"
#include "fe2d/element/elastic.hpp"
#include "fe2d/mesh/mesh.hpp"
#include "scene/uplift_models.hpp"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <array>
#include <cassert>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace damslip::fe2d {

inline constexpr int no_dof = -1;

/// Where the unknowns of the nodes stand in the vectors and matrices of the system. Nodes may share unknowns (tied
/// base).
struct DofMap {
    int components = 2;    ///< unknowns per node: 2 displacement, 1 scalar field
    int count = 0;         ///< unknowns in the system
    std::vector<int> dofs; ///< of node n, component c at [components * n + c]; no_dof: fixed or not part of the system

    int operator()(int node, int component = 0) const { return dofs[components * node + component]; }
    int node_count() const { return static_cast<int>(dofs.size()) / components; }
};

/// How the dam stands on the rock, and the blocks above lift joints on what is below them.
enum class Base {
    tied,    ///< the two nodes of every pair share their unknowns; without rock the base nodes are fixed
    separate ///< the two sides are independent: contact is elsewhere; without rock the dam floats
};

/// The sides and the bottom of the rock box.
enum class RockEdges {
    fixed, ///< normal to themselves: the sides in x, the bottom in y
    free   ///< held by nothing but what the caller puts there (dashpots)
};

/// Displacements (x, y).
/// A tied base needs a mesh whose contact plane is `matching`.
/// Order: all unknowns of dam nodes first (dam_dof_count of them), then the rock's, each side in node order.
DofMap displacement_dofs(const Mesh& mesh, Base base, RockEdges edges = RockEdges::fixed);

/// Unknowns on dam nodes; they are 0 ... dam_dof_count - 1. With a tied base the base nodes are among them.
int dam_dof_count(const Mesh& mesh, const DofMap& dofs);

/// Every displacement component of every node, nothing fixed or shared: for checks and for forces at fixed nodes.
DofMap all_dofs(const Mesh& mesh, int components);

/// One unknown for every node of the elements of `regions` except the `prescribed` nodes.
DofMap scalar_dofs(const Mesh& mesh, std::span<const Region> regions, std::span<const int> prescribed);

/// Values of all nodes, node by node (components * node count), from a vector of unknowns; fixed ones are zero.
Eigen::VectorXd nodal_values(const DofMap& dofs, const Eigen::VectorXd& unknowns);

using SparseMatrix = Eigen::SparseMatrix<double>; ///< by columns; symmetric ones are stored whole

/// Matrix of one element; an empty (0 x 0) matrix leaves the element out.
using ElementMatrixFunction = std::function<ElementMatrix(const Element& element, const Corners& corners)>;
using ElementVectorFunction = std::function<ElementVector(const Element& element, const Corners& corners)>;

/// Sum of the element matrices, dofs.count x dofs.count. Fixed unknowns are left out. Elements are added in mesh order:
/// same bits each time.
SparseMatrix assemble(const Mesh& mesh, const DofMap& dofs, const ElementMatrixFunction& element_matrix);

/// The same with different unknowns for rows and columns, rows.count x columns.count: for parts of a matrix, such as
/// the coupling of free and prescribed values. Both maps have the same number of components.
SparseMatrix assemble(const Mesh& mesh, const DofMap& rows, const DofMap& columns,
                      const ElementMatrixFunction& element_matrix);

/// Sum of the element vectors, length dofs.count.
Eigen::VectorXd assemble_vector(const Mesh& mesh, const DofMap& dofs, const ElementVectorFunction& element_vector);

/// Material of each region, and how the quadrilaterals are formulated.
struct Materials {
    ElasticMaterial dam, rock, curtain;
    ElasticMaterial block; ///< the rock above a seam
    Q4Kind kind = Q4Kind::incompatible; ///< of linear quadrilaterals; whether an element is quadratic, its nodes say

    const ElasticMaterial& of(Region region) const;
};

/// Materials of the scene; the curtain takes the rock's density, and its modulus where it has none of its own.
/// @throws InputError where Young's modulus is missing.
Materials materials_of(const Scene& scene);

/// The same without inertia or weight of rock and curtain; rock above a seam keeps its own.
Materials without_rock_density(Materials materials);

SparseMatrix stiffness_matrix(const Mesh& mesh, const DofMap& dofs, const Materials& materials); ///< K [N/m per m]
/// The same of the dam's elements alone.
SparseMatrix dam_stiffness_matrix(const Mesh& mesh, const DofMap& dofs, const Materials& materials);
SparseMatrix mass_matrix(const Mesh& mesh, const DofMap& dofs, const Materials& materials, MassKind kind); ///< M [kg/m]

/// M r for a rigid translation r = `direction` of every node, the fixed ones included [kg/m]: the ground acceleration
/// a_g along it loads the relative motion with - M r a_g. `kind` is that of M.
Eigen::VectorXd inertia_vector(const Mesh& mesh, const DofMap& dofs, const Materials& materials,
                               const Eigen::Vector2d& direction, MassKind kind = MassKind::consistent);

/// Weight: density times gravity, downwards [N/m], of the given regions.
Eigen::VectorXd gravity_load(const Mesh& mesh, const DofMap& dofs, const Materials& materials, double gravity,
                             std::span<const Region> regions);

/// What a horizontal stress that no strain has made pushes with: - integral of B^T (stress, 0, 0) [N/m]. In itself it balances.
/// @param stress  of each node, linear in each element [Pa, tension positive]
Eigen::VectorXd locked_stress_load(const Mesh& mesh, const DofMap& dofs, const Eigen::VectorXd& stress);

/// Mass, damping and stiffness stored at the same places, zeros included, so that a matrix made of them at any frequency
/// has the pattern of each and is ordered once.
struct SharedPattern {
    Eigen::SparseMatrix<double> mass, damping, stiffness;
};

/// @pre of one size
inline SharedPattern on_one_pattern(const Eigen::SparseMatrix<double>& mass, const Eigen::SparseMatrix<double>& damping,
                                    const Eigen::SparseMatrix<double>& stiffness)
{
    assert(mass.rows() == stiffness.rows() && damping.rows() == stiffness.rows());
    const auto pattern = [](Eigen::SparseMatrix<double> m) {
        m.makeCompressed();
        m.coeffs().setOnes();
        return m;
    };
    Eigen::SparseMatrix<double> zero = pattern(mass) + pattern(damping) + pattern(stiffness);
    zero.makeCompressed();
    zero.coeffs().setZero();
    SharedPattern shared{mass + zero, damping + zero, stiffness + zero};
    assert(shared.mass.nonZeros() == zero.nonZeros() && shared.damping.nonZeros() == zero.nonZeros());
    return shared;
}

/// Mass of water that moves with the face in its normal direction, per area of wet face [kg/m^2]; `face_angle` phi is
/// the inclination of the face from the vertical, positive where the body widens downwards [rad].
using AddedMassLaw = std::function<double(Point, double face_angle)>;

/// Loads and added mass on boundary chains. Integrals are taken below `surface_level` only: an edge that the water
/// surface cuts is integrated over its wet part, so a level between two nodes costs no accuracy in the resultant. Chains
/// are of corners; edges with a node in their middle are integrated with their three shape functions.

inline constexpr double everywhere = std::numeric_limits<double>::infinity();

/// Pressure at a point of the boundary [Pa]; positive pushes against the body.
using PressureField = std::function<double(Point)>;

/// Nodal forces - integral of N^T p n_out dS [N/m] of a pressure on a chain. Exact for pressures linear along each wet
/// edge.
Eigen::VectorXd pressure_load(const Mesh& mesh, const DofMap& dofs, const NodeChain& chain,
                              const PressureField& pressure, double surface_level = everywhere);

/// Integral of m N^T n n^T N dS [kg/m] (Goldgruber 2015, (3-29) with m the normal component): consistent, full along
/// each edge.
SparseMatrix added_mass_matrix(const Mesh& mesh, const DofMap& dofs, const NodeChain& chain, const AddedMassLaw& law,
                               double surface_level);

/// The same matrix times a rigid translation of every node, the fixed ones included [kg/m]; compare inertia_vector.
Eigen::VectorXd added_mass_inertia(const Mesh& mesh, const DofMap& dofs, const NodeChain& chain,
                                   const AddedMassLaw& law, double surface_level, const Eigen::Vector2d& direction);

enum class ContactSide { dam, rock };

/// Water pressure in the joint [N/m]: on the dam it lifts along the upward normal of the plane, on the rock it presses
/// the opposite way.
/// @param profile  integrated exactly, whatever the mesh; nothing outside of it
Eigen::VectorXd uplift_load(const Mesh& mesh, const DofMap& dofs, const PressureProfile& profile, ContactSide side);

/// Water pressure in a lift joint on both its faces [N/m]: it lifts the block above along the upward normal of the joint
/// and presses the dam below the opposite way; with shared unknowns (tied) the two cancel.
/// @param profile  distances from the upstream face along the joint [m]
Eigen::VectorXd lift_water_load(const Mesh& mesh, const DofMap& dofs, std::size_t joint,
                                const PressureProfile& profile);

/// A force at a point of the dam, shared by the nodes of its element so that force and moment are kept [N/m].
/// @returns nothing when the point is more than 1e-6 of the dam's size outside.
std::optional<Eigen::VectorXd> point_load(const Mesh& mesh, const DofMap& dofs, Point at, const Eigen::Vector2d& force);

/// One quadrature point of the added mass: a mass that moves with the face in its normal direction alone.
struct AddedMassPoint {
    std::array<int, 3> nodes{-1, -1, -1}; ///< both corners of the edge and its middle; -1: linear edge
    std::array<double, 3> shape{};        ///< N_i there [-]
    Eigen::Vector2d normal;               ///< outward unit vector
    Point at;
    double mass = 0.0; ///< [kg/m]
};

/// The points of added_mass_matrix(): the sum of mass N_i N_j n n^T over them is that matrix, to round-off. For programs
/// that know point masses, but no matrices of a face.
std::vector<AddedMassPoint> added_mass_points(const Mesh& mesh, const NodeChain& chain, const AddedMassLaw& law,
                                              double surface_level);

} // namespace damslip::fe2d
