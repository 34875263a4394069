#pragma once

#include "core/status.hpp"
#include "fe2d/assembly/assemble.hpp"
#include "fe2d/time/integrate.hpp"
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

/// Share of the stability limit that a step chosen by the program stays below: Lanczos' method finds the highest frequency from
/// below, and within a few per cent of the limit the highest modes ring long.
inline constexpr double explicit_step_share = 0.9;

/// What the steps of an explicit run are bounded by.
struct ExplicitLimit {
    double highest_frequency = 0.0; ///< ω of M⁻¹K, M lumped, by 80 steps of Lanczos' method [rad/s]
    double dt = 0.0;                ///< central_difference_limit() [s]
    double dt_undamped = 0.0;       ///< the same with b_K = 0 [s]
    Note note() const;
};
ExplicitLimit explicit_limit(const SparseMatrix& lumped, const SparseMatrix& stiffness, double stiffness_damping);

/// The step asked for, or the largest whole part of the motion's step below explicit_step_share of the limit [s].
/// @param asked  time.dt_s @throws InputError when it is above the limit, with both numbers
double explicit_step(double motion_dt, std::optional<double> asked, const ExplicitLimit& limit);

/// The run of integrate() by central differences with lumped mass (CentralDifference). Massless rock is condensed, which leaves
/// no massless unknown; rock with mass stays whole. `options.scheme` is not used. Quadratic elements need a model with
/// MassKind::lumped (their row sums are not positive).
///
/// Rows are kept at the motion's steps, peaks and energies see every step.
/// @throws InputError for a step above the limit, acoustic water, massless unknowns (RockTreatment::whole), damping that is neither
///         mass- nor stiffness-proportional
History integrate_explicit(const Model& model, const GroundMotion& motion, const TiedRunOptions& options);

} // namespace damslip::fe2d
