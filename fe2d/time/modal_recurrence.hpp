#pragma once

#include <Eigen/Core>

namespace damslip::fe2d {

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
