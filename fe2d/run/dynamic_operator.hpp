#pragma once

#include "fe2d/contact/contact_solver.hpp"
#include "fe2d/modes/modes_and_damping.hpp"
#include "fe2d/rock/reduced_rock.hpp"
#include "fe2d/run/static_contact.hpp"
#include "fe2d/time/scheme.hpp"
#include "scene/scene.hpp"

#include <optional>

namespace damslip::fe2d {

/// Damping of the run: C = a_M M_dam + b_K K of dam and rock, never of the contact or the water.
struct RunDamping {
    RayleighConstants constants;
    MassDamping mass = MassDamping::deformation_only;
};

/// What damping of the deformation only adds to a_M M, M = M_dam: with r_k the rigid translation of all that stands above plane k
/// along it, w_k the area-weighted mean slip of that plane, r = [r_k], w = [w_k]
///
///     C_M = a_M (I - r wᵀ)ᵀ M (I - r wᵀ) = a_M M - P wᵀ - w Pᵀ + w κ wᵀ,   P = a_M M r,   κ = rᵀP
///
/// (fe2d/modes/modes_and_damping.hpp). On the planes w is the weights ω on the tangential components, so its part acts
/// like contact forces.
struct SlipDamping {
    Eigen::MatrixXd momentum; ///< P on the dam's unknowns, n x K [N s/m per m/s ...]; without columns: none
    Eigen::MatrixXd drag;     ///< κ, K x K [N s/m per m]
    Eigen::MatrixXd weights;  ///< ω, m x K, columns with sum 1 [-]

    SlipDamping(const ContactStructure& structure, const RunDamping& damping);
    bool active() const { return momentum.cols() > 0; }
};

/// V of one step size at one place of the dam on the rock, and what makes λ⁰ of a free step.
struct StepContact {
    Eigen::MatrixXd to_stuck; ///< -(1/w) EᵀW⁻¹; empty where gaps are all that is free (DynamicOperator)
    std::shared_ptr<const Eigen::MatrixXd> stiffness;
};

/// One step size: the factorised dam, the rock, and the linear part of the contact problem. Runs may share it.
///
/// Unknown increments Δu (dam), Δr (rock's contact nodes), w = 1 + α, with λ̃ = w λ₁ - α λ₀ + (slip damping) and D, P of
/// ContactPlanes and ContactStructure::trace():
///
///     A_d Δu = b_d + k s_Δ + Dᵀ λ̃,   Δr = r* - W_r Pᵀ λ̃,   A_d = a0 M + w a1 a_M M_dam + w (1 + a1 b_K) K,
///     k = w a1 (a_M M_dam r),   κ' = w a1 κ,   s_Δ = ωᵀΔg_t
///
/// with r* the rock's free step and W_r its compliance: K_c⁻¹/(w (1 + a1 b_K)) of massless rock, that of RockStep where the
/// rock radiates. Eliminating the bodies, W = D A_d⁻¹ Dᵀ + P W_r Pᵀ, E = I - z ωᵀ, z = D A_d⁻¹ k, ζ = kᵀA_d⁻¹k, gives
/// λ₁ = λ⁰ + V Δg with
///
///     V = (1/w) [Eᵀ W⁻¹ E + ω (κ' - ζ) ωᵀ]
///
/// Where lift joints cut a dam on a rigid base, or on rock that is a block of the structure, the gaps are all that is free on the
/// interface. With S and k' what A_d and k are there once the inner unknowns are eliminated, b' the same of b_d, ζ_i what k
/// has on the inner unknowns, kᵢᵀA_ii⁻¹kᵢ, nothing needs to be inverted:
///
///     w V = D S Dᵀ - D k' ωᵀ - ω k'ᵀDᵀ + ω (κ' - ζ_i) ωᵀ,   w λ⁰ = (known) - D b' - ω kᵢᵀA_ii⁻¹bᵢ,   Δq = DᵀΔg
///
/// Where the water's floor is the rock's (ReducedRock::floor) the rock's step also feels p̃_f = h Δφ_f + (known) on the volumes v of the
/// floor, and the water's rows there have h Δv, h = w a1 s, p = s φ̇ (CoupledSystem). The rock eliminated, with W_r = [W_b, W_bf;
/// W_fb, W_f]
///
///     A_d - h² W_f on φ_f in place of A_d,   [D, -h P W_bf] on [u, φ_f] in place of D,   b_f + h v* - (known)
///
/// and all else stays: W_f is positive semi-definite, the pressures' block negative, so A_d stays quasi-definite. Pressures of the
/// floor are then part of the interface, before the dam's nodes.
class DynamicOperator {
public:
    DynamicOperator(const ContactStructure& structure, const RunDamping& damping, const SlipDamping& slip_damping,
                    const StepConstants& constants, const ReducedRock* radiating = nullptr);

    bool regular() const { return factor_.regular(); }
    const StepConstants& constants() const { return constants_; }
    const InterfaceFactor& factor() const { return factor_; }
    double rock_share() const { return rock_share_; } ///< W_r K_c of massless rock [-]
    const RockStep* rock_step() const
    {
        return rock_step_ ? &*rock_step_ : nullptr;
    } ///< null: the rock does not radiate

    bool has_floor() const { return structure_.floor_nodes() > 0; }
    double floor_factor() const { return floor_factor_; } ///< h [Pa]
    Eigen::VectorXd
    on_floor(const Eigen::VectorXd& interface) const; ///< values of the floor's pressures among those of the interface
    Eigen::Index interface_unknowns() const { return 2 * (structure_.interface() + structure_.floor_nodes()); }

    /// The contact problem before the dam has slid; the only one where it does not slide far.
    const StepContact& contact() const { return contact_; }
    /// @param trace  P of another place of the dam on the rock (ContactStructure::slides_far())
    StepContact contact_at(const Pairing::Matrix& trace) const;

    /// The step without contact forces at its end.
    struct Free {
        Eigen::VectorXd dam;                          ///< b_d after the forward pass of factor() [N/m]
        Eigen::VectorXd interface;                    ///< Δu of the interface [m]; by gaps: from finish() on
        Eigen::VectorXd gap;                          ///< Δg without λ̃ [m]; by gaps: D b' [N/m]
        Eigen::VectorXd mean;                         ///< kᵀA_d⁻¹b_d, K values; by gaps: kᵢᵀA_ii⁻¹bᵢ
        Eigen::VectorXd slip, drag, pulled, on_pairs; ///< work space, by plane and by pair
    };
    /// @param free  with `dam` = b_d after the forward pass on entry
    /// @param rock_gap  P r*, 2m [m]; empty: rigid base
    void solve_free(Free& free, const Eigen::VectorXd& rock_gap) const;

    /// λ⁰ for gaps that stay as they are; `known` = α λ₀ - (slip damping of the start) [N/m].
    void stuck_force(const StepContact& contact, Free& free, const Eigen::VectorXd& known,
                     Eigen::VectorXd& stuck) const;

    /// The step for λ₁ = `force` and Δg = `gap`: free.interface becomes Δu of the interface, and free.dam what the
    /// backward pass of factor() turns into Δu.
    /// @param tilde  λ̃ [N/m], which rock asks for; by gaps: left alone
    void finish(Free& free, const Eigen::VectorXd& force, const Eigen::VectorXd& known, const Eigen::VectorXd& gap,
                Eigen::VectorXd& tilde) const;

    std::size_t bytes() const;

private:
    void couple_floor();
    Eigen::MatrixXd stiffness_by_gaps() const;
    Eigen::MatrixXd sticking_stiffness(const Pairing::Matrix& trace) const;

    const ContactStructure& structure_;
    const SlipDamping& slip_damping_;
    StepConstants constants_;
    InterfaceFactor factor_;
    ContactPlanes::Matrix gaps_; ///< D on the interface, the floor's part included
    double floor_factor_ = 0.0;
    bool by_gaps_ = false;                  ///< gaps are all that is free on the interface
    Eigen::MatrixXd interface_flexibility_; ///< inverse of the Schur complement, interface
    Eigen::MatrixXd pull_;                  ///< of the interface by forces on the pairs: the same times Dᵀ
    Eigen::MatrixXd dam_flexibility_;       ///< D A_d⁻¹ Dᵀ
    double rock_share_ = 0.0;               ///< of the massless rock's flexibility that a step feels, W_r K_c
    std::optional<RockStep> rock_step_;     ///< of rock that radiates
    Eigen::MatrixXd momentum_;              ///< k after the forward pass
    Eigen::MatrixXd interface_momentum_;    ///< A_d⁻¹ k on the interface
    Eigen::MatrixXd z_, zeta_, drag_;       ///< D A_d⁻¹ k, kᵀA_d⁻¹k, κ'; by gaps: D k', ζ_i, κ'
    Eigen::MatrixXd unmixed_;               ///< (I - zᵀω)⁻¹
    StepContact contact_;
};

} // namespace damslip::fe2d
