#pragma once

#include "fe2d/contact/joint_water.hpp"

namespace damslip::fe2d {

/// Water that flows along the joint as it opens and shuts (JointFlow), width w = w_0 + opening. At rest the pressure stays
/// as it was: what the flow along the joint lacks for it comes from the rock, and goes on doing so.
///
/// In the contact problem the pressure at the end of a step is linearised about the last solution,
///
///     A (p_rest - p) = r + Z g,   Z = A (T+S)⁻¹ A/Δt
///
/// and solved again until p is that of the flow. Z may be an older one: it decides how often, not what comes out. So it
/// stays as it is while the state of the cells is the same and no w³ has changed by more than `rebuild_share`.
class ReynoldsWater final : public CrackWater {
public:
    static constexpr double rebuild_share = 0.1; ///< change of w³ that makes Z anew [-]
    static constexpr double tolerance = 1e-7;    ///< of p, over the largest pressure held [-]
    static constexpr int largest_passes = 40;    ///< contact problems of a step; then it is too long

    ReynoldsWater(const JointWaterLaw& law, std::shared_ptr<const WetJoint> joint);

    std::unique_ptr<JointLaw> clone() const override { return std::make_unique<ReynoldsWater>(*this); }
    void begin(const JointStart& start) override;
    void add(JointTerms& terms) const override;
    JointFit revise(const ContactSolution& solution) override;
    void end(const ContactSolution& solution) override;
    const JointWaterReport& report() const override { return report_; }
    void rest_with(const PressureProfile& pressure) override;
    void set_wave_pressure(double pressure) override { waves_ = with_waves_ ? pressure : 0.0; }

private:
    JointFlowStep step() const;
    void linearise(const JointFlowStep& flow, const Eigen::VectorXd& opening, bool anew);
    Eigen::VectorXd width(const Eigen::VectorXd& opening) const;

    double clearance_;
    bool with_waves_;
    JointChannel channel_;
    HeldPressure held_;
    double waves_ = 0.0; ///< [Pa]
    double scale_ = 1.0; ///< of pressures [Pa]

    // At the end of the last step.
    JointFlowState water_;
    Eigen::VectorXd source_; ///< from the rock; empty until it shakes
    Eigen::VectorXd change_; ///< of the pressure, as the contact problem had it [Pa]

    // Of this step.
    double dt_ = 0.0;
    Eigen::VectorXd opening_; ///< at its start [m]
    HeldPressure now_;
    JointFlowState next_;
    Eigen::VectorXd force_; ///< r [N/m]
    int passes_ = 0;

    // Z and what it was made for; shared by copies.
    struct Linear {
        Eigen::MatrixXd stiffness;
        Eigen::VectorXd width;
        std::vector<char> cavitated;
        double dt = 0.0;
    };
    std::shared_ptr<const Linear> linear_;
};

} // namespace damslip::fe2d
