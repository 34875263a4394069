#pragma once

#include "fe2d/contact/joint_water.hpp"

namespace damslip::fe2d {

/// The rules of guidelines for the water in a crack that opens from a wet end while it shakes:
///
/// - unchanged: the pressure before; the crack is followed for the state after the earthquake.
/// - zero: none in what the earthquake opens, the pressure before elsewhere, and back where it shuts.
/// - full: full head of the wet end to the tip, beyond it as WetJoint::cracked says.
/// - mouth: full head to x_w, which follows the tip with the speed v_w at most and is driven back by it; none from
///   there to the tip; beyond it as a crack of length x_w has it. v_w → ∞: full; v_w → 0: zero.
///
/// Drains that shear off take the rule on with the pressure without them, from the next step on.
///
/// Where a crack shuts at its mouth first, the pairs behind it that are still open keep the pressure they had until they shut:
/// water that vanished there would give back another work than it took, and the rocking dam would live on it.
///
/// The tip at the end of a step gives the pressure at the end of the next: in a step it goes there linearly. So a step
/// knows its water, and full head that opens the joint further does so step by step.
class WaterRule final : public CrackWater {
public:
    WaterRule(const JointWaterLaw& law, std::shared_ptr<const WetJoint> joint);

    std::unique_ptr<JointLaw> clone() const override { return std::make_unique<WaterRule>(*this); }
    void begin(const JointStart& start) override;
    void add(JointTerms& terms) const override;
    JointFit revise(const ContactSolution&) override { return JointFit::fits; }
    void end(const ContactSolution& solution) override;
    const JointWaterReport& report() const override { return report_; }

private:
    Eigen::VectorXd by_rule() const;
    void follow(const ContactStates& states);

    JointWaterLaw law_;
    Eigen::VectorXd change_;     ///< of the pressure, at the end of the last step [Pa]
    Eigen::VectorXd next_;       ///< and of this one [Pa]
    Eigen::VectorXd target_;     ///< of the next step [Pa]
    std::vector<char> wet_pair_; ///< has been in a crack from a wet end since it opened
    Eigen::VectorXd opening_;    ///< at the start of the step [m]
    CrackLengths at_start_;      ///< cracks of the static state [m]
    CrackLengths wet_;           ///< x_w from both ends [m]
    double dt_ = 0.0;
};

} // namespace damslip::fe2d
