#pragma once

#include "fe2d/contact/contact_solver.hpp"
#include "fe2d/damping/rayleigh.hpp"
#include "fe2d/run/static_contact.hpp"
#include "fe2d/time/scheme.hpp"
#include "scene/scene.hpp"

namespace damslip::fe2d {

/// Damping of the run: C = a_M M + b_K K of dam and rock, never of the contact.
struct RunDamping {
    RayleighConstants constants;
    MassDamping mass = MassDamping::deformation_only;
};

/// What damping of the deformation only adds to a_M M: k' (w wᵀ - w m̂ᵀ - m̂ wᵀ), k' = a_M rᵀM r, m̂ = M r / rᵀM r, r
/// the rigid translation of the dam along the plane, w the area-weighted mean slip (fe2d/damping/deformation_only.hpp).
/// On the plane w is the weights ω on the tangential components, so its part acts like contact forces.
struct SlipDamping {
    double coefficient = 0.0; ///< k' [N s/m per m]; 0: none
    Eigen::VectorXd momentum; ///< m̂ on the dam's unknowns [-]
    Eigen::VectorXd weights;  ///< ω, m values, sum 1 [-]

    SlipDamping(const ContactStructure& structure, const RunDamping& damping);
    bool active() const { return coefficient != 0.0; }
};

/// One step size: the factorised dam, the rock, and the contact problem on the plane.
///
/// Unknown increments Δu (dam), Δr (rock's contact nodes), w = 1 + α, with λ̃ = w λ₁ - α λ₀ + (slip damping):
///
///     A_d Δu = b_d + k m̂ s_Δ + Dᵀ λ̃,   A_r Δr = b_r - λ̃,   A_d = (a0 + w a1 a_M) M + w (1 + a1 b_K) K,
///     A_r = w (1 + a1 b_K) K_c,   k = w a1 k',   s_Δ = ωᵀΔg_t,   m_Δ = m̂ᵀΔu
///
/// Eliminating the bodies, W = F_d + F_r, E = I - k z ωᵀ, z = D A_d⁻¹ m̂, ζ = m̂ᵀA_d⁻¹m̂, gives λ₁ = λ⁰ + V Δg with
///
///     V = (1/w) [Eᵀ W⁻¹ E + k (1 - k ζ) ω ωᵀ]
class DynamicOperator {
public:
    DynamicOperator(const ContactStructure& structure, const RunDamping& damping, const SlipDamping& slip_damping,
                    const StepConstants& constants, const ContactOptions& options);

    bool regular() const { return factor_.regular(); }
    const StepConstants& constants() const { return constants_; }
    JointSolver& contact() { return *contact_; }
    double rock_share() const { return rock_share_; } ///< A_r⁻¹ K_c [-]

    /// The step without contact forces at its end.
    struct Free {
        Eigen::VectorXd dam;     ///< b_d after the forward pass [N/m]
        Eigen::VectorXd on_base; ///< its interface part on the plane
        Eigen::VectorXd gap;     ///< Δg without λ̃ [m]
        Eigen::VectorXd dam_gap; ///< F_d times on_base: what the dam contributes [m]
        double mean = 0.0;       ///< m̂ᵀA_d⁻¹b_d [m]
    };
    /// @param free  with `dam` = b_d on entry
    /// @param rock_gap  A_r⁻¹ b_r on the plane [m]
    void solve_free(Free& free, const Eigen::VectorXd& rock_gap) const;

    /// Takes the contact problem to another place of the dam on the rock (ContactStructure::slides_far()).
    void slide_to(const Pairing::Matrix& trace);

    /// λ⁰ for a gap that stays as it is; `known` = α λ₀ - (slip damping of the start) on the plane [N/m].
    void stuck_force(const Free& free, const Eigen::VectorXd& known, Eigen::VectorXd& stuck) const;

    /// Δu of the dam for λ₁ = `force` and Δg = `gap`; overwrites free.dam.
    /// @param dam_interface  the dam's part of Δg
    /// @returns λ̃ on the plane [N/m]
    const Eigen::VectorXd& finish(Free& free, const Eigen::VectorXd& force, const Eigen::VectorXd& known,
                                  const Eigen::VectorXd& gap, Eigen::VectorXd& dam_interface);

    std::size_t bytes() const;

private:
    void set_contact(const Pairing::Matrix* trace);

    const ContactStructure& structure_;
    const SlipDamping& slip_damping_;
    StepConstants constants_;
    InterfaceFactor factor_;
    ContactOptions options_;
    Eigen::MatrixXd dam_flexibility_; ///< F_d
    Eigen::MatrixXd to_stuck_;        ///< -(1/w) EᵀW⁻¹
    double rock_share_ = 0.0;         ///< of the rock's static flexibility that a step feels, A_r⁻¹ K_c
    double k_ = 0.0, zeta_ = 0.0;
    Eigen::VectorXd momentum_; ///< m̂ after the forward pass
    Eigen::VectorXd on_base_;  ///< its interface part on the plane
    Eigen::VectorXd z_;        ///< D A_d⁻¹ m̂
    Eigen::VectorXd tilde_;    ///< λ̃
    std::unique_ptr<JointSolver> contact_;
};

} // namespace damslip::fe2d
