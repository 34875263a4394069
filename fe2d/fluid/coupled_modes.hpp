#pragma once

#include "fe2d/fluid/fluid_model.hpp"
#include "fe2d/solver/linear_solver.hpp"

#include <vector>

namespace damslip::fe2d {

/// Matrices of undamped dam and water: K φ_u - H φ_p = ω² M φ_u,  L φ_p = ω² (Hᵀ φ_u + Q φ_p).
struct CoupledPencil {
    SparseMatrix stiffness, mass;             ///< K, M of the structure alone, positive definite and semi-definite
    SparseMatrix coupling;                    ///< H
    SparseMatrix water_stiffness, water_mass; ///< L, Q, both positive definite
    Eigen::VectorXd inertia_x, inertia_y;     ///< M r of the structure [kg/m]
    Eigen::VectorXd flux_x, flux_y;           ///< of the water
    Eigen::Vector2d structure_mass{0.0, 0.0}; ///< in x and y, fixed nodes included [kg/m]
};

enum class CoupledModesStatus { ok, solver_failed, not_converged };

/// Lowest first. Normalised to a modal mass of 1, φ_uᵀMφ_u + φ_pᵀLφ_p/ω⁴ = 1.
struct CoupledModes {
    CoupledModesStatus status = CoupledModesStatus::ok;
    SolverReport solver;             ///< of the factorisation that failed, else of K
    Eigen::VectorXd frequency;       ///< [Hz]
    Eigen::MatrixXd displacement;    ///< φ_u by columns
    Eigen::MatrixXd pressure;        ///< φ_p by columns
    Eigen::VectorXd water_share;     ///< of the mode's potential energy, φ_pᵀQφ_p/(φ_uᵀKφ_u + φ_pᵀQφ_p) [-]
    Eigen::Matrix2Xd effective_mass; ///< in x and y [kg/m]
    Eigen::Matrix2Xd effective_share; ///< over total_mass [-]
    Eigen::VectorXd
        dam_share; ///< of the effective mass in x the part the dam's own mass carries, φ_uᵀM r Γ, over total_mass [-]; they sum
    ///< to the dam's mass; negative where the water pushes the dam against its motion
    Eigen::Vector2d total_mass{
        0.0, 0.0}; ///< of the structure and the added mass of incompressible water, fluxᵀ L⁻¹ flux [kg/m]

    bool of_water(Eigen::Index mode) const { return water_share[mode] > 0.5; }
};

/// The unsymmetric pencil has the symmetric form  diag(K, Q) z = ω² B z,  B = [M + H L⁻¹Hᵀ, H L⁻¹Q; Q L⁻¹Hᵀ, Q L⁻¹Q],  z = (φ_u, φ_p)
/// (Morand & Ohayon 1979: the displacement potential p/ω² eliminated), left side positive definite, right side semi-definite: real
/// frequencies, Lanczos' method with the inverse of the left side. L and K are factorised once each, no shift is needed.
/// Participation: left vector (φ_u, φ_p/ω²), Γ = φ_uᵀ M r + φ_pᵀ flux/ω²; effective masses Γ² sum to total_mass.
/// @param count  modes wanted
CoupledModes coupled_modes(const CoupledPencil& pencil, int count);

/// Every mode up to a frequency [Hz], and more until `leading` leading ones are among them (of 400 modes at most).
CoupledModes coupled_modes_up_to(const CoupledPencil& pencil, double frequency, int leading);

/// The first `count` modes, by frequency, that move the dam in x: dam_share of at least 0.1 %. A long reservoir adds any number of modes
/// between them that hardly do, and more with its length; the answer of the dam and its damping are ruled by these.
std::vector<Eigen::Index> leading_modes(const CoupledModes& modes, int count);

} // namespace damslip::fe2d
