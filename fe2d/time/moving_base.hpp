#pragma once

#include "fe2d/time/energy.hpp"

#include <cstdint>

namespace damslip::fe2d {

/// A body with inertia of its own that a dam is tied to, radiating rock say; its steps see no more of it than the base.
/// All is zero at rest; p are the forces on it beyond those at rest, and p̃ = (1 + α) p₁ - α p₀ of a step.
class MovingBase {
public:
    virtual ~MovingBase() = default;

    virtual std::int64_t unknowns() const = 0;
    virtual const Eigen::MatrixXd& compliance() const = 0;            ///< W_r, Δu by p̃, symmetric, >= 0 [m²/N]
    virtual const Eigen::VectorXd& begin_step() = 0;                  ///< @returns Δu where p̃ = 0 [m]
    virtual void end_step(const Eigen::VectorXd& weighted_force) = 0; ///< @param weighted_force  p̃ [N/m]
    /// kinetic and strain of the state; damping, radiated and numerical since rest [J/m]. With the work of p, as
    /// BaseCoupling::numerical_work() splits it, they close.
    virtual Energy energy() const = 0;

    /// Last rows of all this that belong to the water's floor (ReducedRock::floor), and their v̇, v̈ at the start of the step.
    virtual Eigen::Index floor() const { return 0; }
    virtual Eigen::VectorXd floor_velocity() const { return {}; }
    virtual Eigen::VectorXd floor_acceleration() const { return {}; }
};

} // namespace damslip::fe2d
