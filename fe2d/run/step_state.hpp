#pragma once

#include "fe2d/run/contact_motion.hpp"

namespace damslip::fe2d {

/// All that goes from one implicit step to the next, apart from products kept for speed.
struct StepState : DynamicState {
    Eigen::VectorXd rate_t;  ///< tangential gap rates ġ_t [m/s]; kept for themselves: a pair that sticks has none,
                             ///< to the last bit
    Eigen::VectorXd accel_t; ///< and accelerations [m/s²]
    Eigen::VectorXd force_before;     ///< λ one step ago [N/m]
    Eigen::VectorXd law_force_before; ///< of it, the laws of the joint (JointLaws::force()); empty: no laws
};

/// What one step changed.
struct StepChange {
    Eigen::VectorXd dam;  ///< Δu [m]
    Eigen::VectorXd rock; ///< Δr [m]
    Eigen::VectorXd gap;  ///< Δg, 2m [m]
};

/// A body at one instant, as the work ledger wants it.
struct BodyInstant {
    Eigen::VectorXd force;    ///< of its equation of motion, without inertia, stiffness damping and contact [N/m]
    Eigen::VectorXd velocity; ///< [m/s]
};

} // namespace damslip::fe2d
