#pragma once

#include "fe2d/run/contact_motion.hpp"
#include "fe2d/run/dynamic_operator.hpp"

#include <memory>
#include <span>

namespace damslip::fe2d {

/// One pair of an explicit step: rates x = free + W P of its opening and slip under the impulse P = (P_n, P_t).
struct ExplicitPair {
    double nn = 0.0, nt = 0.0, tt = 0.0; ///< W of D M⁻¹ Dᵀ, positive definite [m/kg ...]
};
struct ExplicitImpulse {
    double normal = 0.0, tangential = 0.0; ///< [N s/m]
    ContactState state = ContactState::open;
};
/// The law of ContactLaw between impulses and rates of one step, solved in closed form.
/// @param target  rate that shuts the pair at the end of the step: -opening/Δt, <= 0 [m/s]
/// @param cohesion  times the pair's area and Δt [N s/m]
ExplicitImpulse solve_pair(const ExplicitPair& pair, double free_normal, double free_tangential, double target,
                           double friction, double cohesion, JointOpening separation);

/// What explicit steps of one structure share, at any step size: rigid base, lumped mass.
class ExplicitOperators {
public:
    ExplicitOperators(const ContactStructure& structure, const RunDamping& damping);

    /// Does every pair have nodes of its own, so that D M⁻¹ Dᵀ is 2 x 2 blocks?
    bool separable() const { return separable_; }
    double highest_frequency() const { return highest_frequency_; } ///< ω of M⁻¹K [rad/s]
    /// Largest stable step [s]: 4 M - 2 Δt C - Δt² K stays positive semi-definite for
    ///
    ///     Δt = 4 / (λ_C + √(λ_C² + 4ω²)),   λ_C = b_K ω² + a_M (1 + Σ_k |r_k|_M |w_k|_M⁻¹)² >= λ_max(M⁻¹C)
    ///
    /// (central_difference_limit() with all damping lagged; the norms bound the damping of the deformation only). Contact takes
    /// freedom from the nodes, which lowers frequencies, or dissipates.
    double limit() const;
    double undamped_limit() const { return 2.0 / highest_frequency_; }

    const ContactStructure& structure() const { return structure_; }
    const RunDamping& damping() const { return damping_; }
    void add_damping(const Eigen::VectorXd& v, const Eigen::VectorXd& stiffness_product, Eigen::VectorXd& force) const;

    SparseMatrix mass, inverse;      ///< M in blocks of nodes, M⁻¹ [kg/m, m/kg]
    SparseMatrix stiffness;          ///< K, in the dam's node order
    SparseMatrix gaps, pull;         ///< D on all unknowns, 2m x n; M⁻¹ Dᵀ
    std::vector<ExplicitPair> pairs; ///< m

private:
    void make_mass();
    void make_pairs();

    const ContactStructure& structure_;
    RunDamping damping_;
    SlipDamping slip_damping_;
    Eigen::VectorXd damped_; ///< a_M M_dam, lumped
    double highest_frequency_ = 0.0, damping_bound_ = 0.0;
    bool separable_ = true;
};

/// Explicit steps of a dam that slides on a rigid base, contact exact by forward increments (Carpenter, Taylor & Katona 1991, Int. J.
/// Numer. Meth. Engrg 32, 103-128), independent of DynamicContact:
///
///     M (v₊ - v₋) = Δt (R_n - K u_n - C v₋) + Dᵀ P,   u_{n+1} = u_n + Δt v₊
///
/// v₋, v₊ are velocities in the middle of the steps before and after t_n. The impulses P hold the gaps at t_{n+1}: a pair is shut
/// where it would be penetrated there, lands exactly in the plane, and obeys Coulomb's law between P_t and its slip of the step. With
/// lumped mass every pair is a problem of its own (solve_pair).
///
/// Work ledger in the middle of the steps: with v̄ = (v₊ + v₋)/2, ½v₊ᵀMv₊ + ½u_{n+1}ᵀKu_n changes by exactly
/// Δt v̄ᵀ(R_n - C v₋) + Pᵀ D v̄; P_n's part is contact normal work (landings), P_t's friction.
class ExplicitContact final : public ContactMotion {
public:
    /// As DynamicContact. The structure has no rock, no water.
    ExplicitContact(std::shared_ptr<const ExplicitOperators> operators, SplitLoad load, const StaticState& start,
                    const ContactMemory& memory);

    /// Steps of one size from the present time to that of the given ground. Contact forces of the state are the impulses over the
    /// time of all of them.
    /// @param ground  at the ends of the steps, in order
    void advance(double dt, std::span<const GroundAcceleration> ground, const ContactLaw& law);

    const DynamicState& state() const override { return state_; }
    const ContactStructure& structure() const override { return operators_->structure(); }
    const Energy& energy() const override { return energy_; }
    double energy_imbalance() const override { return energy_.imbalance(energy_start_); }
    double energy_scale() const override { return energy_scale_; }
    const DynamicCounts& counts() const override { return counts_; }
    const LargestSlips& largest_slips() const override { return largest_slips_; }
    double static_normal_force() const override { return normal_force_; }
    std::size_t bytes() const override;

private:
    void step(double dt, const GroundAcceleration& ground, const ContactLaw& law);
    void contact(double dt, const ContactLaw& law);
    void add_energy(double dt, const Eigen::VectorXd& v_before);

    std::shared_ptr<const ExplicitOperators> operators_;
    SplitLoad load_;
    DynamicState state_;
    double normal_force_ = 0.0;
    Eigen::VectorXd product_, rate_product_; ///< K u, K v₋
    int since_product_ = 0;
    Eigen::VectorXd impulse_, impulses_;    ///< of the step, and summed up, 2m
    Eigen::VectorXd loads_, damping_force_; ///< of the step
    Energy energy_, energy_start_;
    double energy_scale_ = 0.0;
    DynamicCounts counts_;
    LargestSlips largest_slips_;
};

} // namespace damslip::fe2d
