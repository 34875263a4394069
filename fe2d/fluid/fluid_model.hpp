#pragma once

#include "fe2d/assembly/assemble.hpp"
#include "fe2d/fluid/water_boundary.hpp"
#include "fe2d/mesh/reservoir_mesh.hpp"

namespace damslip::fe2d {

/// Acoustic water as a linear body, per metre of dam length. With the pressure p beyond the static one [Pa], ü the dam's acceleration
/// relative to the ground and (a_x, a_y) the ground's, v_y its velocity (x downstream, y up):
///
///     Q p̈ + A ṗ + L p = -Hᵀ ü - flux_x a_x - flux_y a_y - end_y v_y
///
/// Q = ∫NN/K_w,  L = ∫∇N·∇N/ρ,  A = ∫ NN (1/ρc)(1-α)/(1+α) on the bottom and ∫ NN/(ρc) on a damper; the matrices of an absorbing end
/// (absorbing_end.hpp) are in them. All are symmetric, both triangles stored. Free surface: p = 0, (3-51); sloshing: ∫NN/(ρ g) in Q, (3-59).
/// Where the floor is the rock (FluidOptions::floor_on_rock) the right side has -v̈ on the floor's rows, v_j = ∫ N_j n·u dS the
/// volume that the rock's motion u relative to the ground takes from the water; p_j is then the force on v_j.
/// Order of unknowns: pressures of the mesh, of the layers of an absorbing end, then the layers' momenta.
struct FluidModel {
    ReservoirMesh reservoir;
    FluidOptions options;
    DofMap dofs;                    ///< pressure unknowns of the mesh's nodes
    Eigen::Index mesh_unknowns = 0; ///< pressures of the mesh
    Eigen::Index layer_pressures = 0, layer_momenta = 0;
    SparseMatrix mass, damping, stiffness; ///< Q, A, L: unknowns() x unknowns()
    SparseMatrix body_mass,
        body_stiffness; ///< Q and L of the water in the mesh alone, same size: its energy is ½ pᵀQp + ½ ψᵀLψ, ψ = ∫p dt
    Eigen::VectorXd flux_x,
        flux_y; ///< ∫ N n dS of what moves with the ground: the dam's face and, where it moves, the bottom (y) [m]
    std::vector<Eigen::Index>
        floor;             ///< FluidOptions::floor_on_rock: unknowns of the floor's nodes, far end to heel; else empty
    Eigen::VectorXd end_y; ///< of a moving bottom beyond an absorbing end [m^2/s]
    Eigen::VectorXd force_x, force_y; ///< ∫ N n dS of the dam's face: hydrodynamic force on the dam = force · p

    Eigen::Index unknowns() const { return mass.rows(); }
};

FluidModel build_fluid(ReservoirMesh reservoir, const FluidOptions& options);

/// Mesh and boundaries of the scene's reservoir.
FluidModel build_fluid(const Scene& scene);

} // namespace damslip::fe2d
