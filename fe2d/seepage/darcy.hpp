#pragma once

#include "fe2d/element/shape.hpp"
#include "fe2d/mesh/mesh.hpp"
#include "fe2d/solver/linear_solver.hpp"

#include <Eigen/Core>

#include <functional>
#include <span>

/// Steady flow of water through saturated rock, ∇·(k ∇H) = 0 (Darcy 1856), on the rock and curtain elements of a mesh.
namespace damslip::fe2d {

/// Hydraulic conductivity of the zones [m/s], isotropic, > 0.
struct Permeability {
    double rock = 1e-4;    ///< thesis table 4-1
    double curtain = 1e-8; ///< grout, thesis table 4-1
};

/// Prescribed hydraulic head H = p/γ_w + y [m] at a node, y measured from the heel.
struct NodeHead {
    int node = 0;
    double head = 0.0;
};

/// One value per node of the mesh; NaN on nodes that belong to no rock element.
struct DarcySolution {
    Eigen::VectorXd head; ///< H [m]
    Eigen::VectorXd
        inflow; ///< water that enters at a node, Σ K H over its elements [m^3/s per m]; round-off on free nodes
    SolverReport solver; ///< when not ok(), head and inflow are NaN
};

/// Everywhere else on the boundary no water passes. Inflows are consistent nodal fluxes: their sum is zero to
/// round-off, and they converge with twice the order of the gradients.
/// @param heads  at least one; a node given twice takes the last value
DarcySolution solve_darcy(const Mesh& mesh, const Permeability& permeability, std::span<const NodeHead> heads);

/// Water that the chosen elements take from the given nodes [m^3/s per m], as consistent nodal fluxes: the flow across
/// a line is what the elements on its far side take from the nodes on it.
double flow_into(const Mesh& mesh, const Permeability& permeability, const DarcySolution& solution,
                 std::span<const int> nodes, const std::function<bool(const Element&, const Corners&)>& chosen);

} // namespace damslip::fe2d
