#pragma once

#include "fe2d/fluid/fluid_model.hpp"

#include <array>
#include <vector>

namespace damslip::fe2d {

/// Dam and water as one symmetric linear system  M z̈ + G ż + K z = f,  z = (u, φ).
///
/// In pressures the coupling is not symmetric: -H p stands in the dam's rows, Hᵀ ü in the water's. With ψ = ∫p dt the water's equation,
/// integrated once from rest, and the dam's read (velocity potential; Everstine 1981)
///
///     M_s ü + C u̇ + K_s u - H ψ̇ = f_s
///     -(Q ψ̈ + A ψ̇ + L ψ) - Hᵀ u̇ = flux_x v_x + flux_y v_y + end_y d_y        v, d: ground velocity and displacement
///
/// so both couplings are of one kind and M = diag(M_s, -Q), G = [C, -H; -Hᵀ, -A], K = diag(K_s, -L) are symmetric. With ψ = s φ and the water's
/// rows times s: M = diag(M_s, -s²Q), G = [C, -sH; -sHᵀ, -s²A], K = diag(K_s, -s²L). s = ρc makes φ a length, s²Q ~ ρ and s²L ~ K_w beside
/// M_s ~ ρ_s and K_s ~ E: diagonals within a factor of 20 for concrete and water at any step size and mesh.
/// a0 M + w (a1 G + K) is symmetric quasi-definite, positive on u (and on the momenta of an absorbing end), negative on the pressures: L D Lᵀ
/// exists without pivoting in every ordering (Vanderbei 1995).
struct CoupledSystem {
    SparseMatrix mass, damping, stiffness; ///< M, G, K, structure first; both triangles
    Eigen::Index structure_unknowns = 0, water_unknowns = 0;
    double scale = 1.0; ///< s [Pa s/m]: p = s φ̇

    Eigen::VectorXd velocity_x, velocity_y; ///< loads on all unknowns per ground velocity, x downstream, y up
    Eigen::VectorXd displacement_y;         ///< and per vertical ground displacement

    /// Unknowns of the water in pairs of neighbours, for orderings by nodes of two unknowns; -1: no partner.
    std::vector<std::array<Eigen::Index, 2>> water_pairs;

    Eigen::Index size() const { return structure_unknowns + water_unknowns; }
    /// Pressures (and momenta) of the water from the rate of change of all unknowns [Pa].
    Eigen::VectorXd pressures(const Eigen::VectorXd& rate) const { return scale * rate.tail(water_unknowns); }
};

/// @param mass, damping, stiffness  of the structure, n x n, added mass left out
/// @param coupling  H, n x unknowns of the water (face_coupling)
CoupledSystem couple(const SparseMatrix& mass, const SparseMatrix& damping, const SparseMatrix& stiffness,
                     const SparseMatrix& coupling, const FluidModel& water);

/// Of a floor that is the rock's (FluidModel::floor) among the unknowns of the system; empty: it is not. What its rates v̇ do to the
/// water is s v̇ on the right side of these rows; the force of the pressures on v is s φ̇.
std::vector<Eigen::Index> unknowns_of_floor(const CoupledSystem& system, const FluidModel& water);

} // namespace damslip::fe2d
