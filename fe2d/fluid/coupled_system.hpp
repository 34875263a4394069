#pragma once

#include "fe2d/fluid/fluid_model.hpp"
#include "fe2d/model/model.hpp"
#include "fe2d/solver/linear_solver.hpp"

#include <Eigen/SparseCore>

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
    SolverReport solver;             ///< of the factorisation that failed, else of L
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

/// What a boundary adds to Q, A, L.
struct FluidTriplets {
    std::vector<Eigen::Triplet<double>> mass, damping, stiffness;
};

/// Nodes of a vertical far end, and what bounds the water beyond it above and below.
struct EndColumn {
    std::vector<double> y;           ///< surface to bottom, decreasing [m]
    std::vector<Eigen::Index> place; ///< unknown of each node; -1: p = 0 there
    double bottom_admittance = 0.0;  ///< of the bottom beyond the end [m/(Pa s)]
    double surface_mass = 0.0;       ///< 1/(ρ g) of a sloshing surface there [m/Pa], else 0
    double bottom_load = 0.0;        ///< -1 where the bottom moves with the ground (n_y), else 0
};

/// Unknowns an absorbing end adds, numbered from `first`: pressures of the layers, then their vertical momenta.
struct AbsorbingEnd {
    Eigen::Index pressures = 0, momenta = 0;
    FluidTriplets entries;
    /// Load on the layers by a bottom that moves: beside the face's flux times the ground's acceleration the end takes these times its
    /// velocity (cosine layers) and its acceleration (decay layers).
    std::vector<Eigen::Triplet<double>> velocity_load, acceleration_load; ///< (unknown, 0, value)
};

/// The infinite channel of constant depth beyond a vertical far end, in layers of linear elements integrated at their middle
/// (continued-fraction absorbing boundary: Guddati & Tassoulas 2000; Guddati & Lim 2006; also called perfectly matched discrete layers).
///
/// Beyond the end the discrete depth column obeys  M₁ p_xx = S(s) p, M₁ = ∫NN/ρ dy, S = L_y + s A_y + s² Q_y with everything the channel
/// has above and below. One such element of length l is  M₁/l [1 -1; -1 1] + S l/4 [1 1; 1 1],  and a channel behind it looks through
/// it unchanged, whatever l, because (1/l + λl/4)² - (-1/l + λl/4)² = λ. The error is that of what stands behind the last one (a wall):
/// a mode of wave number k comes back with Π ((k - a_j)/(k + a_j))², a_j = 2/l_j.
///  - a = s cos θ/c, l = 2c/(s cos θ), is exact for waves that leave at the angle θ to the axis, which is how a depth mode above its cut-off
///    frequency travels: cos θ = √(1 - ω_n²/ω²). The damper of Lysmer & Kuhlemeyer is the crude form for θ = 0.
///  - a = decay / depth, a real length, is exact for a field that decays so: the depth modes below their cut-off.
/// S l/4 of the first kind holds L_y/s. It is made of first-order unknowns w, one per depth element and layer, the vertical momentum of
/// the water there: (β/ρh)(Δq)²/s = stationary value over w of 2 w Δq - (s ρ h/β) w², β = c/(2 cos θ), q the sum of the element's two
/// pressures; so Q, A, L stay real, symmetric and constant. Q and A have the signs of an energy and a loss on the pressures, A the opposite
/// one on w: [pressures | w] is symmetric quasi-definite in every implicit step.
/// A bottom in uniform motion drives the channel too: its own field does not depend on x and passes through unchanged (the wall at the end).
AbsorbingEnd absorbing_end(const EndColumn& column, const FluidOptions& water, Eigen::Index first);

/// What stands before the water in the order of its unknowns.
enum class WaterBeside { dam, dam_and_rock };

/// Acoustic water of a dam that slides: CoupledSystem with its unknowns in nodes of two, as the dam's are. First the
/// dam's nodes (mesh order; then the rock's with WaterBeside::dam_and_rock), then pairs of the water's unknowns; a partner that is missing is an unknown of its own that
/// nothing drives. The dam's own blocks of all matrices are empty. Signs and scale: CoupledSystem.
struct WaterBody {
    FluidModel water;
    SparseMatrix coupling; ///< H, unknowns before the water x unknowns of the water [m]
    double scale = 1.0;    ///< s [Pa s/m]: p = s φ̇
    Eigen::Index dam_unknowns = 0, size = 0;
    std::vector<Eigen::Index> place; ///< of each of the water's unknowns among `size`

    SparseMatrix mass, damping, stiffness;                  ///< -s²Q; -sH, -sHᵀ, -s²A; -s²L
    Eigen::VectorXd velocity_x, velocity_y, displacement_y; ///< loads per ground velocity and displacement

    /// @param model  Base::separate, without added mass
    WaterBody(const Scene& scene, const Model& model, WaterBeside beside = WaterBeside::dam);
};

} // namespace damslip::fe2d
