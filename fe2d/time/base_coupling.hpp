#pragma once

#include "fe2d/time/linear_integrator.hpp"
#include "fe2d/time/moving_base.hpp"

#include <Eigen/Cholesky>

#include <memory>
#include <span>

namespace damslip::fe2d {

/// A dam tied to a moving base. Both make equal steps of the base's unknowns: with λ of the base on the dam beyond what it is at
/// rest, p = -λ, and B Δu* , Δr* the steps without λ₁ of either body,
///
///     B Δu* + W_d λ₁ = Δr* - W_r [(1 + α) λ₁ - α λ₀]
///     [W_d + (1 + α) W_r] λ₁ = Δr* + α W_r λ₀ - B Δu*,        W_d = (1 + α) B A⁻¹ Bᵀ
///
/// W_d is positive definite, W_r is not negative: one Cholesky factor per step size.
class BaseCoupling {
public:
    /// @param dam  step of the dam with a free base, and of what goes along with it (water); ok(). Kept by reference
    /// @param unknowns  of the base in that system, in the order of `base`
    /// @param size  of that system
    BaseCoupling(std::unique_ptr<MovingBase> base, const StepOperator& dam, std::span<const Eigen::Index> unknowns,
                 Eigen::Index size);

    bool ok() const { return factor_.info() == Eigen::Success; }
    /// Makes the step of the base, whose forces take the dam along.
    InterfaceForces step(const FreeStep& free);
    /// ½ α (λ₁ - λ₋₁)ᵀ Δu of the last step [J/m]: a part of the work between the bodies that EnergyLedger has among the
    /// dam's numerical dissipation with the opposite sign.
    double numerical_work() const { return numerical_work_; }
    const MovingBase& base() const { return *base_; }

private:
    std::unique_ptr<MovingBase> base_;
    SparseMatrix map_; ///< B
    double alpha_;
    InterfaceFlexibility dam_;
    Eigen::LLT<Eigen::MatrixXd> factor_;
    Eigen::VectorXd force_, force_before_; ///< λ₀, λ₋₁ of the step to come [N/m]
    double numerical_work_ = 0.0;
};

} // namespace damslip::fe2d
