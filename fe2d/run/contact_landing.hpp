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
///
/// With restitution e a body that flew leaves its base again: pairs that shut with the rate ġ⁻ < -v_min get
///
///     ġ⁺ + e ġ⁻ >= 0,   P_n >= 0,   (ġ⁺ + e ġ⁻) P_n = 0,   |P_t| <= mu P_n     (Moreau 1988 with Newton's e)
///
/// and contact forces are zero from there on. v_min = 2|g̈|Δt: what is slower would be back within the step, e = 0. With one e
/// for all pairs friction may make energy (Kane & Levinson 1985): where ΔE = Σ P·(ġ⁻ + ġ⁺)/2 > 0, e of this landing is lowered
/// until it is not. Nodes that shut one by one keep e = 0: of an elastic body a restitution by node has no limit as the mesh
/// is refined, its loss is the waves it sends out.
class ContactLanding {
public:
    /// @param restitution  e of landings of the whole base [-]
    explicit ContactLanding(const StepOperators& operators, double restitution = 0.0);

    /// Gaps at the start of a step in which the body flies, and the rates that they shut with.
    struct Approach {
        double dt = 0.0; ///< of the step [s]
        Eigen::VectorXd
            rate; ///< 2m: normal ones when the gap is nil, by its acceleration; tangential ones of the start [m/s]
        Eigen::VectorXd accel; ///< normal ones [m/s²]
    };
    /// Nothing where landings do not rebound, or some pair is shut. @param state  at the start of the step
    std::optional<Approach> approach(const StepState& state, const StepRock& rock, double dt);

    /// @param op, solver  of the step that has just been made @param before  states at its start
    /// @param state, dam, rock  at its end: velocities, accelerations, forces and products change
    /// @returns what happened; null where no gap is newly held, or nothing can be done. Valid until the next landing
    const LandingForces* land(const DynamicOperator& op, JointSolver& solver, const ContactStates& before,
                              const ContactLaw& law, StepRock& rock, StepDam& dam, StepState& state,
                              const std::optional<Approach>& approach = {});

private:
    struct Rebound {
        ContactStates states;   ///< while the impulses act
        Eigen::VectorXd target; ///< ġ⁺ of the normal gaps [m/s]
        double loss = 0.0;      ///< -ΔE [J/m]
    };
    std::optional<Rebound> rebound(const StepConstants& constants, JointSolver& solver, const ContactLaw& law,
                                   const Approach& approach, const ContactStates& states) const;
    void release(const DynamicOperator& op, JointSolver& solver, StepRock& rock, StepDam& dam, StepState& state);
    void change_by(StepRock::Jump of, const DynamicOperator& op, StepRock& rock);
    void gap_values(const Eigen::VectorXd& dam, const Eigen::VectorXd& rock_values, const Eigen::VectorXd& tangential,
                    const StepRock& rock, Eigen::VectorXd& gap);
    void settle(const DynamicOperator& op, JointSolver& solver, const ContactLaw& law, StepRock& rock, StepDam& dam,
                StepState& state);
    void change_accelerations(const DynamicOperator& op, StepRock& rock, StepDam& dam, StepState& state);

    const ContactStructure& structure_;
    const SlipDamping& slip_damping_;
    double restitution_;

    // Of the landing at hand.
    LandingForces forces_;
    ContactSolution jumps_;          ///< of rates or accelerations of the gaps, and impulses or forces times a0
    DynamicOperator::Free free_;     ///< what they change of the dam
    Eigen::VectorXd rock_;           ///< and of the rock
    Eigen::VectorXd values_, force_; ///< of all gaps; on the pairs [N/m]
    Eigen::VectorXd none_, tilde_, on_gaps_, by_trace_; ///< work space
};

} // namespace damslip::fe2d
