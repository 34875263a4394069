#pragma once

#include "fe2d/contact/joint_law.hpp"
#include "scene/joint_laws.hpp"

#include <vector>

namespace damslip::fe2d {

/// Friction of one plane over the rate of slip.
struct RateFrictionPart {
    Eigen::Index first = 0, pairs = 0; ///< of the plane
    RateFriction law;
};

/// Friction over the rate of slip, pair by pair: mu = mu_s(S) r with
///
///     r(v) = k + (1 - k) exp(-|v|/v_c),   k = mu_k/mu_s      (Stribeck curve; Armstrong-Hélouvry et al. 1994, eq. (4))
///     r' = (r(v) - r)(1/tau + |v|/d)                         where it lags; mu_s(S) never does
///
/// v is the rate of the step's end, by the scheme's formula v = rate_slope s + rate_known; zero of a pair that sticks. A pair
/// that is open keeps its r. Over a step r goes on as by the constant rate v: exact for one.
///
/// Each contact problem is solved with r given (Z = 0, r = 0: pairs that stick do not feel the law), then r is found anew from
/// its slips, until no mu changes by more than 1e-12. With V_tt the stiffness of the slipping pairs and
///
///     D = diag(λ_n mu_s (-dr/dv) rate_slope)
///
/// the errors of one solution are V_tt⁻¹D of the one before, and the answer is the only one where V_tt - D is positive
/// definite (Cholesky) for the rates on the way through the step: D is taken with the smaller of the rates at its start and
/// end, where r falls most steeply. A start from rest so needs steps of a rigid block below v_c/(g' Δmu) for a rate of first
/// order, g' = N'/M. Where it is not, or no friction settles, the step is too_far and made in halves, in which V grows as
/// 1/Δt² and rate_slope as 1/Δt.
class RateFrictionLaw final : public JointLaw {
public:
    /// @param pairs  m, of all planes; those of no part keep their friction
    RateFrictionLaw(Eigen::Index pairs, std::vector<RateFrictionPart> parts);

    std::unique_ptr<JointLaw> clone() const override { return std::make_unique<RateFrictionLaw>(*this); }
    void begin(const JointStart& start) override;
    void add(JointTerms& terms) const override;
    JointFit revise(const ContactSolution& solution) override;
    void end(const ContactSolution& solution) override;
    JointEnergy energy() const override { return {}; } ///< friction's work is the ledger's

    const Eigen::VectorXd& ratio() const { return ratio_; } ///< r at the end of the last step [-]

private:
    /// r at the end of the step and its slope dr/dv, |v| given.
    struct Value {
        double ratio, slope;
    };
    Value value(const RateFriction& law, double start, double rate) const;
    bool unique(const ContactSolution& solution) const;

    std::vector<RateFrictionPart> parts_;
    Eigen::VectorXd ratio_, rate_; ///< r and |v| at the end of the last step

    // Of the step being made.
    double dt_ = 0.0, rate_slope_ = 0.0;
    Eigen::VectorXd rate_known_, trial_, rate_then_, slope_, strength_; ///< strength_: mu_s of the pairs
    const Eigen::MatrixXd* stiffness_ = nullptr;
    int solutions_ = 0;
};

} // namespace damslip::fe2d
