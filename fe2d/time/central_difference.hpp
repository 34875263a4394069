#pragma once

#include "fe2d/assembly/dof_map.hpp"
#include "fe2d/time/linear_integrator.hpp"

namespace damslip::fe2d {

/// A linear system as explicit steps want it. Displacements and forces have the sizes of LinearSystem's.
struct ExplicitSystem {
    SparseMatrix mass;              ///< M, diagonal in 2 x 2 blocks of one node's unknowns, positive definite [kg/m]
    SparseMatrix mass_damping;      ///< part of C with the same blocks, positive semi-definite [N s/m^2]
    SparseMatrix stiffness;         ///< K [N/m^2]
    double stiffness_damping = 0.0; ///< b_K of the part b_K K of C, >= 0 [s]
};

/// Row sums of everything that moves, by node: the lumped mass. Added mass on an inclined face couples the two directions of
/// a node. @param inertia_x, inertia_y  M r of rigid translations, fixed nodes included; the first `size` unknowns count
SparseMatrix lumped_mass(const DofMap& dofs, const Eigen::VectorXd& inertia_x, const Eigen::VectorXd& inertia_y,
                         Eigen::Index size);

/// Largest stable step of CentralDifference [s].
///
///     Δt = (2/ω)(√(1 + ζ²) - ζ),   ζ = b_K ω/2,   ω² = λ_max(M⁻¹K)
///
/// ζ of the lagged damping alone; mass damping does not count. For a mode of (M, K) with e = φᵀC_Mφ Δt/2 >= 0, b = b_K ω²Δt
/// and Ω = ωΔt a step u_n -> u_{n+1} has the characteristic polynomial (1+e) z² - (2 - b - Ω²) z + (1 - e - b); by Jury's
/// conditions |z| <= 1 where 4 - 2b - Ω² >= 0, which is the formula. It holds where C_M couples the modes, too: for an
/// eigenvector x of the quadratic eigenproblem the same polynomial follows with xᴴMx etc. Belytschko, Liu & Moran (2000).
/// @param highest_frequency  ω [rad/s]
double central_difference_limit(double highest_frequency, double stiffness_damping);

/// Central difference (2-28)...(2-35) in the form of Newmark's γ = ½, β = 0:
///
///     ṽ = v₀ + Δt/2 a₀,  u₁ = u₀ + Δt ṽ,  (M + Δt/2 C_M) a₁ = R₁ - K u₁ - (C_M + b_K K) ṽ,  v₁ = ṽ + Δt/2 a₁
///
/// ṽ is the velocity in the middle of the step. The mass damping acts on v₁, so without b_K the order is 2; b_K K acts on ṽ,
/// half a step old, which is explicit, of order 1 in the damping, and tightens the limit.
class CentralDifference {
public:
    CentralDifference(ExplicitSystem system, double dt);

    double dt() const { return dt_; }
    /// a₀ from M a₀ = R₀ - C v₀ - K u₀.
    State start(const Eigen::VectorXd& displacement, const Eigen::VectorXd& velocity,
                const Eigen::VectorXd& load) const;
    /// `after` is overwritten (its memory is used again) and must not be `before`. Its damping force is the one the step
    /// used. K u is carried on by K u₁ = K u₀ + Δt K ṽ and made anew every 256 steps.
    void step(const State& before, const Eigen::VectorXd& load_after, State& after);
    /// What EnergyLedger needs: Newmark's γ = ½, β = 0.
    StepConstants constants() const;

private:
    ExplicitSystem system_;
    double dt_;
    SparseMatrix inverse_; ///< of M + Δt/2 C_M
    int since_product_ = 0;
    Eigen::VectorXd middle_, product_; ///< ṽ, K ṽ
};

} // namespace damslip::fe2d
