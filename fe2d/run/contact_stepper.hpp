#pragma once

#include "fe2d/contact/joint_laws.hpp"
#include "fe2d/run/step_parts.hpp"

#include <map>
#include <memory>

namespace damslip::fe2d {

/// Makes one HHT-α step of dam, rock and contact (2-25), with the contact problem solved exactly (DynamicOperator). Contact
/// forces are weighted like internal forces, (1+α)λ₁ - αλ₀, slip damping and ground motion too. A pair that sticks keeps its
/// slip to the last bit, so nothing creeps.
///
/// In this order: begin(), the forward pass of op().factor() on dam_vector(), solve(), accept(), the backward pass, end(). The
/// state changes in end() alone, so a step can be given up before. Passes are the caller's: several steppers share them.
class ContactStepper {
public:
    /// @param operators  kept by reference, shared with other runs
    ContactStepper(StepOperators& operators, const Contact& joint, const ContactOptions& options);

    const DynamicOperator& take(double dt); ///< the step size of the steps from here on [s]
    const DynamicOperator& op() const { return *op_; }
    JointSolver& solver() { return *problems_.at(op_).solver; } ///< of the last solve()

    void begin(const StepState& state, const GroundAcceleration& ground, StepDam& dam, StepRock& rock);
    Eigen::VectorXd& dam_vector() { return free_.dam; } ///< b_d, and Δu after the backward pass
    ContactReport solve(const ContactLaw& law, const StepState& state, StepRock& rock, DynamicCounts& counts);
    void accept(const StepState& state);
    /// @returns what changed; valid until the next step
    const StepChange& end(const GroundAcceleration& ground, StepRock& rock, StepState& state);

    double slip_error(const StepState& state);                                  ///< after solve()
    double dam_error(const StepState& state) const;                             ///< when Δu is known
    double largest_stuck_force() const { return stuck_.cwiseAbs().maxCoeff(); } ///< of the step [N/m]
    int step_sizes() const { return static_cast<int>(problems_.size()); }
    std::size_t bytes() const; ///< operators of its step sizes included, which other runs may share

private:
    /// The contact problem of one step size at the present place of the dam on the rock.
    struct PairProblem {
        StepContact own; ///< where the dam has slid; else that of the operator
        int place = 0;   ///< StepRock::place() it was made for
        std::unique_ptr<JointSolver> solver;
        std::unique_ptr<JointLawSolver> with_laws; ///< null: none needed so far
    };
    const StepContact& contact_at(const StepRock& rock);
    ContactReport solve_laws(const ContactLaw& law, const StepState& state);

    StepOperators& operators_;
    const ContactStructure& structure_;
    const SlipDamping& slip_damping_;
    Contact joint_;
    ContactOptions options_;
    std::map<const DynamicOperator*, PairProblem> problems_;

    // Of the step being made.
    const DynamicOperator* op_ = nullptr;
    DynamicOperator::Free free_;
    Eigen::VectorXd known_, stuck_, tilde_;
    ContactSolution solution_;
    Eigen::VectorXd elastic_; ///< elastic part of the tangential gaps [m]
    JointLaws laws_;          ///< of the step; those of the state change in end()
    StepChange change_;
    Eigen::VectorXd slip_, mean_, drag_, motion_, on_pairs_; ///< work space
};

} // namespace damslip::fe2d
