#pragma once

#include "fe2d/contact/joint_solver.hpp"
#include "fe2d/run/contact_ledger.hpp"

namespace damslip::fe2d {

/// What happens when gaps come to be held at the end of a step: an open pair shuts, a slipping one sticks.
///
/// A gap that is held from one step on keeps a velocity that rings in Newmark's formulas, v₁ = -(γ/β - 1) v₀: in a stiff
/// structure that, not elasticity, is most of the error of a step, and it makes landings bounce. So contact impulses make the
/// velocities of all held gaps zero; what kinetic energy they take counts as numerical.
///
/// After a flight accelerations follow. A gap v Δt wide that shuts within a step leaves its end with an acceleration of up to
/// v/(β Δt) away from the plane, and a force as large: the next steps would throw the body back, and friction would have met the
/// force, not the impulse m v. Held gaps stand still: their accelerations become zero, forces on the pairs with them,
/// M δa = w Bᵀδλ. Through the step's operator that holds but for (w/a0)(a1 C + K) δa, which the ledger of the next step knows.
class ContactLanding {
public:
    explicit ContactLanding(const StepOperators& operators);

    /// @param op, solver  of the step that has just been made @param before  states at its start
    /// @param state, dam, rock  at its end: velocities, accelerations, forces and products change
    /// @returns nothing where no gap is newly held, or nothing can be done
    std::optional<LandingForces> land(const DynamicOperator& op, JointSolver& solver, const ContactStates& before,
                                      const ContactLaw& law, StepRock& rock, StepDam& dam, StepState& state) const;

private:
    struct Change {
        Eigen::VectorXd dam, rock;
    };
    Change change_by(StepRock::Jump of, const ContactSolution& jumps, const DynamicOperator& op, StepRock& rock) const;
    Eigen::VectorXd gap_values(const Eigen::VectorXd& dam, const Eigen::VectorXd& rock_values,
                               const Eigen::VectorXd& tangential, const StepRock& rock) const;
    void settle(const DynamicOperator& op, JointSolver& solver, const ContactLaw& law, StepRock& rock, StepDam& dam,
                StepState& state, LandingForces& forces) const;

    const ContactStructure& structure_;
    const SlipDamping& slip_damping_;
};

} // namespace damslip::fe2d
