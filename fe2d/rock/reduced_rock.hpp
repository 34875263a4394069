#pragma once

#include "core/status.hpp"
#include "fe2d/time/energy.hpp"
#include "fe2d/time/scheme.hpp"

#include <Eigen/Core>
#include <complex>
#include <memory>
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
    Note missed_gate() const; ///< the error beside what is allowed, of a reduction that errs too much
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
    /// The same with axes that change from node to node. @param normals, tangents  unit vectors, a column for each node
    ReducedRock on_path(const Eigen::Matrix2Xd& normals, const Eigen::Matrix2Xd& tangents) const;
};

/// One step size of reduced rock; runs may share it. With w = 1 + α, p̃ = w p₁ - α p₀ and the elastic force r of the
/// residual, e = F_res r,
///
///     d Δq = h + Φᵀ p̃,              d = a0 + w [a1 (Ĉ + b_K K̂) + K̂]
///     w (1 + a1 b_K) Δr = g_r + p̃,   Δu_c = Φ Δq + F_res Δr
///
/// so contact sees the compliance W_r = Φ d⁻¹ Φᵀ + F_res/(w (1 + a1 b_K)), symmetric and positive semi-definite, in place of
/// K_c⁻¹/(w (1 + a1 b_K)) of massless rock.
class RockStep {
public:
    /// @param rock  kept by reference; rows in the caller's order
    /// @param stiffness_damping  b_K >= 0 [s]
    RockStep(const ReducedRock& rock, double stiffness_damping, const StepConstants& constants);

    const ReducedRock& rock() const { return rock_; }
    const StepConstants& constants() const { return constants_; }
    double stiffness_damping() const { return b_k_; }
    const Eigen::MatrixXd& compliance() const { return compliance_; } ///< W_r, Δu_c by p̃, 2n x 2n [m²/N]

    const Eigen::MatrixXd& inverse() const { return inverse_; }       ///< d⁻¹, N x N
    const Eigen::MatrixXd& modal_pull() const { return modal_pull_; } ///< d⁻¹ Φᵀ, N x 2n
    double residual_share() const { return residual_share_; }         ///< 1/(w (1 + a1 b_K)) [-]

private:
    const ReducedRock& rock_;
    StepConstants constants_;
    double b_k_, residual_share_;
    Eigen::MatrixXd inverse_, modal_pull_, compliance_;
};

/// Of reduced rock, in the terms of Energy: Δ(kinetic + strain) + damping + radiated + numerical = work of the forces on
/// the interface, ½ (p₁ + p₀)ᵀ Δu_c + ½ α (p₁ - p₋₁)ᵀ Δu_c summed over the steps (EnergyLedger) [J/m].
struct RockEnergy {
    double kinetic = 0.0;   ///< ½ q̇²
    double strain = 0.0;    ///< ½ qᵀ K̂ q + ½ eᵀ r
    double radiated = 0.0;  ///< ∫ q̇ᵀ Ĉ q̇: by edges and sponge
    double damping = 0.0;   ///< ∫ b_K (q̇ᵀ K̂ q̇ + ėᵀ ṙ)
    double numerical = 0.0; ///< by the scheme, and what jumps of the velocity take
};

/// Motion of reduced rock from rest: all zero is the static state, p what acts on its interface beyond the static forces. One step:
///
///     begin(step);  ... free_step() into the contact problem, which finds p̃ ...  finish(p̃);
///
/// begin() may be called again, with another step size too, before finish(): it changes no state.
class RockMotion {
public:
    explicit RockMotion(const ReducedRock& rock);

    /// @param step  of the same rock; kept until finish()
    /// @param constant  force that acts on top of p all the time: static contact forces which p̃ lacks [N/m]; empty: none
    void begin(const RockStep& step, const Eigen::VectorXd& constant = {});
    const Eigen::VectorXd& free_step() const { return free_; } ///< Δu_c where p̃ = 0 [m]
    void finish(const Eigen::VectorXd& weighted_force);
    const Eigen::VectorXd& step() const { return step_; } ///< Δu_c of the last finish() [m]

    /// Velocities jump by what the impulse-like `force` does through the operator of the last step, as its own forces do:
    /// δu̇_c = W_r force. @returns δu_̇c; valid until the next jump
    const Eigen::VectorXd& jump_velocity(const Eigen::VectorXd& force);
    /// The same of accelerations, after which forces on the interface have changed by force/(w ...) as the caller decides.
    const Eigen::VectorXd& jump_acceleration(const Eigen::VectorXd& force);

    const Eigen::VectorXd& displacement() const { return u_; } ///< of the interface [m]
    const Eigen::VectorXd& velocity() const { return v_; }
    const Eigen::VectorXd& acceleration() const { return a_; }
    const RockEnergy& energy() const { return energy_; }

    const Eigen::VectorXd& modal_displacement() const { return q_; }
    const Eigen::VectorXd& modal_velocity() const { return qv_; }
    const Eigen::VectorXd& residual_force() const { return r_; } ///< r [N/m]

private:
    /// What the equation of motion's forces at one instant need for their work.
    struct Instant {
        Eigen::VectorXd modal;    ///< (Ĉ + b_K K̂) q̇ + K̂ q
        Eigen::VectorXd residual; ///< r + b_K ṙ
    };
    void add_energy();
    void land(); ///< starts to collect what jumps do, unless it has begun

    const ReducedRock& rock_;
    const RockStep* op_ = nullptr;
    Eigen::VectorXd q_, qv_, qa_, r_, rv_, ra_, u_, v_, a_;
    Eigen::VectorXd e_;                                 ///< F_res r [m]
    Eigen::VectorXd radiating_, radiating_a_;           ///< Ĉ q̇, Ĉ q̈
    Eigen::VectorXd free_modal_, free_residual_, free_; ///< Δq, Δr, Δu_c of the free step
    Eigen::VectorXd modal_step_, residual_step_, step_, e_step_;
    Instant now_, before_, before2_;
    Eigen::VectorXd before_qv_, before_qa_, before_rv_; ///< q̇, q̈, ṙ at the start of the last step
    Eigen::VectorXd landed_modal_,
        landed_residual_; ///< damping forces of velocities that have jumped since the last step
    bool landed_ = false;
    RockEnergy energy_;
    Eigen::VectorXd modal_, residual_, product_, jump_; ///< work space
};

/// Reduced rock that a dam is tied to (RockMotion), at rest.
/// @param rock  kept by reference; rows (x, y) by node
/// @param stiffness_damping  b_K >= 0 [s]
std::unique_ptr<MovingBase> rock_base(const ReducedRock& rock, const StepConstants& constants,
                                      double stiffness_damping);

} // namespace damslip::fe2d
