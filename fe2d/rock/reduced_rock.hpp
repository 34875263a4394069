#pragma once

#include <Eigen/Core>

#include <complex>
#include <span>
#include <string>

namespace damslip::fe2d {

/// What a reduction was made of and how good it is.
struct ReductionReport {
    int unknowns = 0;    ///< of the box
    int patterns = 0;    ///< loads on the interface that it was shaken by
    int frequencies = 0; ///< at which
    int modes = 0;       ///< N
    int rounds = 0;      ///< of making and checking
    double error = 0.0;  ///< largest ‖ΔF p‖/‖F p‖ of two random loads p at frequencies in between [-]
    double wanted = 0.0; ///< gate of that [-]
    double seconds = 0.0;

    bool passed() const { return error <= wanted; }
    std::string missed_gate() const; ///< of one that did not pass: a sentence with the figures and what to do
};

/// Rock with mass that lets waves out, reduced to its interface: two passive bodies in series,
///
///     u_c = Φ q + e,   q̈ + (Ĉ + b_K K̂) q̇ + K̂ q = Φᵀ p,   e + b_K ė = F_res p,
///
/// p the forces on the interface nodes. K̂ is diagonal, Ĉ (edges and sponge) and F_res are positive semi-definite.
/// Statics are exact for any N: Φ K̂⁻¹ Φᵀ + F_res = B_r K⁻¹ B_rᵀ (MacNeal 1971; Rubin 1975). Mass is 1.
struct ReducedRock {
    Eigen::VectorXd stiffness; ///< K̂ = ω², ascending, > 0 [1/s²]
    Eigen::MatrixXd damping;   ///< Ĉ without b_K K̂ [1/s]
    Eigen::MatrixXd modes;     ///< Φ, 2n x N, rows (x, y) by node [kg^-1/2 m^1/2]
    Eigen::MatrixXd residual;  ///< F_res, 2n x 2n [m²/N]
    ReductionReport report;
    /// How many of the rows, the last ones, are of the water's floor: v_j = ∫ N_j n·u dS, n out of the water, N_j the shape of
    /// the water's node j, far end to heel. The force on v_j is the pressure p_j [Pa].
    Eigen::Index floor = 0;

    Eigen::Index count() const { return stiffness.size(); }
    Eigen::Index interface() const { return modes.rows(); }    ///< 2n, and `floor`
    Eigen::Index base() const { return modes.rows() - floor; } ///< 2n

    Eigen::MatrixXd static_flexibility() const; ///< Φ K̂⁻¹ Φᵀ + F_res
    /// u_c e^{iωt} for p e^{iωt}. @param frequency  ω [rad/s] @param stiffness_damping  b_K [s]
    Eigen::MatrixXcd response(double frequency, double stiffness_damping, const Eigen::MatrixXd& loads) const;

    /// The rock of another modulus, density and size whose geometry over size, Poisson's ratio and ω size/c_s are this
    /// one's: K̂ ∝ E/(ρ L²), Ĉ ∝ √(E/ρ)/L, Φ ∝ 1/(√ρ L), F_res ∝ 1/E; rows of the floor times L.
    ReducedRock scaled(double young_modulus, double density, double length) const;

    /// With rows in the order of Plane: normal components of all nodes, then tangential ones.
    /// @param normal, tangent  unit vectors
    ReducedRock on_plane(const Eigen::Vector2d& normal, const Eigen::Vector2d& tangent) const;
};

} // namespace damslip::fe2d
