#pragma once

#include "fe2d/time/integrate.hpp"

#include <Eigen/Core>

namespace damslip::fe2d {

/// How many modes a superposition takes. The number is doubled from `first` until the estimates of ModalTruncation are below
/// the tolerances, or `most` is reached.
struct ModalOptions {
    std::optional<int> modes;      ///< this many, >= 1, whatever the estimates; default: chosen
    int first = 12;                ///< >= 1
    int most = 192;                ///< >= first
    double crest_tolerance = 1e-3; ///< of the crest's peak displacement [-]
    double force_tolerance = 1e-2; ///< of the peaks of the crest's acceleration and of the base shear [-]
};

/// Why a run with these options cannot be made by superposition of modes; empty: it can.
std::string modal_obstacle(const TiedRunOptions& options);

/// Steps of a direct run from which on a superposition costs less. Measured (fe_bench): finding 12 modes of 6259 unknowns takes
/// as long as 170 direct steps, and a step of the modes an eighth of a direct one.
inline constexpr int modal_break_even = 200;

/// Without `options.dt` a step of the motion is divided into this many parts, for the peaks between its samples: half a part off a
/// peak of 20 Hz at 0.01 s is 0.3 % of it. Rows are kept at the motion's steps.
inline constexpr int modal_parts = 8;

/// The run of integrate() by superposition of modes: motion relative to the ground from the static state, u = u₀ + Φ q + w a,
///
///     q̈ + ΦᵀCΦ q̇ + Ω² q = Γ a(t),   w = K⁻¹ M r - Φ Ω⁻² Γ,   a = (a_h, -a_v)                       (2-37)...(2-51)
///
/// exact in time for the piecewise-linear record (ModalRecurrence), so there is no time-step error: `options.dt` only sets how
/// often rows are made. Modes left out follow the ground statically (w, "static correction", Hansteen & Bell 1979).
/// `options.scheme` is not used.
///
/// What their dynamic part would add is estimated with an oscillator of the highest mode's frequency and damping: its largest
/// departure from the static response, and its largest relative acceleration, times the static displacement and the share of
/// the rigid motion that the modes kept do not give at the crest (of the mass, for the base shear). Modes left out lie higher
/// and depart less.
///
/// Damping: Rayleigh's. Added mass is not damped, so with water C is not diagonal in the modes; the modes kept are then solved
/// coupled, exactly as well; those left out follow their damping forces statically, and what this gives back is neglected.
/// Energies are those of the modes and the static state. External work is exact; the damping's is integrated by the corrected
/// trapezoid rule from states and their rates, so the ledger closes with order 4 in the step, not to round-off.
/// @throws InputError where modal_obstacle() says so, and for damping that is not Rayleigh's
History integrate_modal(const Model& model, const GroundMotion& motion, const TiedRunOptions& options,
                        const ModalOptions& modal = {});

/// Modal equations of motion under loads that are linear between the ends of steps of one size, solved exactly:
///
///     q̈ + C q̇ + Ω² q = P a(t),   a linear from a₀ to a₁,   x = (Ω q, q̇):   x₁ = E x₀ + G₀ a₀ + G₁ a₁
///
/// (2-37)...(2-51). Where C is diagonal every mode has its own closed formula, that of Nigam & Jennings (1969), Bull. Seism. Soc. Am.
/// 59, 909-922. Where damping couples the modes, E, G₀, G₁ are parts of the exponential of the step's matrix, to round-off: the
/// same recurrence, only full.
class ModalRecurrence {
public:
    /// @param omega  Ω, N values > 0 [rad/s] @param damping  C = ΦᵀCΦ, N x N, symmetric [1/s]
    /// @param loads  P, N x L: modal loads of L amplitudes @param dt  > 0 [s]
    ModalRecurrence(const Eigen::VectorXd& omega, const Eigen::MatrixXd& damping, const Eigen::MatrixXd& loads,
                    double dt);

    Eigen::Index modes() const { return omega_.size(); }
    bool coupled() const { return coupled_; }
    const Eigen::VectorXd& omega() const { return omega_; }
    const Eigen::MatrixXd& damping() const { return damping_; }
    /// One step. @param q, rate  N values, start in, end out @param before, after  a₀, a₁, L values
    void step(Eigen::VectorXd& q, Eigen::VectorXd& rate, const Eigen::VectorXd& before,
              const Eigen::VectorXd& after) const;
    /// q̈ = P a - C q̇ - Ω² q.
    Eigen::VectorXd acceleration(const Eigen::VectorXd& q, const Eigen::VectorXd& rate,
                                 const Eigen::VectorXd& amplitudes) const;

private:
    void make_diagonal(double dt);
    void make_coupled(double dt);

    Eigen::VectorXd omega_;
    Eigen::MatrixXd damping_, loads_;
    bool coupled_;
    // Diagonal C: 2 x 2 per mode, rows q and q̇ of columns q, q̇, p₀, p₁.
    Eigen::ArrayXd qq_, qv_, vq_, vv_, q0_, q1_, v0_, v1_;
    Eigen::MatrixXd transition_, from_before_, from_after_; ///< E, G₀, G₁ of coupled modes
};

} // namespace damslip::fe2d
