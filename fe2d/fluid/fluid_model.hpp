#pragma once

#include "fe2d/assembly/assemble.hpp"
#include "fe2d/mesh/build_mesh.hpp"
#include "scene/scene.hpp"

#include <vector>

namespace damslip::fe2d {

/// Layers that stand for the water beyond the far end (absorbing_end.hpp).
struct AbsorbingLayers {
    std::vector<double> cosines = {1.0, 0.72, 0.4,
                                   0.16};    ///< cos θ of waves that leave without reflection, in 0 ... 1 [-]
    std::vector<double> decays = {0.7, 1.6}; ///< decay rate times depth of the fields that do [-], > 0
};

/// The water and its boundaries, apart from the shape.
struct FluidOptions {
    double density = 1000.0;        ///< ρ [kg/m^3]
    double bulk_modulus = 2200e6;   ///< K_w [Pa]
    double gravity = 9.81;          ///< of a sloshing surface [m/s^2]
    double bottom_reflection = 1.0; ///< α [-], -1 ... 1
    WaterSurface surface = WaterSurface::free;
    FarEnd far_end = FarEnd::absorbing;
    BottomMotion bottom_motion = BottomMotion::still;
    AbsorbingLayers layers = {};
    bool floor_on_rock =
        false; ///< the floor of the mesh is the rock's (FluidModel::floor); α is then of the bottom beyond the
               ///< far end alone

    double sound_speed() const; ///< c = √(K_w/ρ) [m/s]
};

/// Of a scene with a reservoir.
FluidOptions fluid_options(const Scene& scene);

/// Velocity into a boundary per pressure on it, (1/ρc)(1-α)/(1+α) [m/(Pa s)] for the wave reflection coefficient α
/// (Hall & Chopra 1982; Goldgruber 2015, (3-54)...(3-58)). Infinite for α = -1, where p = 0.
double wave_admittance(double density, double sound_speed, double reflection);

/// α = (Z - ρc)/(Z + ρc), Z = √(E_r ρ_r): normal incidence on a half-space of density ρ_r and modulus E_r (3-55).
double reflection_of_bottom(double density, double sound_speed, double bottom_density, double bottom_modulus);

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

/// H = ∫ N_sᵀ n N_f dS over the face that water and dam share [m], rows: displacement unknowns, columns: `pressures` unknowns of
/// the water. n points out of the water into the dam, so +H p is the force of the pressure on the dam and Hᵀ ü the volume acceleration
/// the dam takes from the water (Goldgruber 2015, (3-39) with the other normal).
///
/// The two sides may have different nodes: the product of the two traces is integrated over every piece between neighbouring nodes of
/// either side, where it is quadratic, so the rows sum to the exact resultants. Both faces must have the same kinks. Water above the
/// crest has no partner.
SparseMatrix face_coupling(const Mesh& structure, const DofMap& displacements, const ReservoirMesh& water,
                           const DofMap& pressures, Eigen::Index unknowns);

/// ∫ N_f n·r dS over a chain of the water's boundary, n out of the water [m], length `unknowns`.
Eigen::VectorXd boundary_flux(const Mesh& water, const DofMap& pressures, const NodeChain& chain,
                              const Eigen::Vector2d& direction, Eigen::Index unknowns);

} // namespace damslip::fe2d
