#pragma once

#include "fe2d/mesh/mesh.hpp"

#include <Eigen/Core>

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

} // namespace damslip::fe2d
