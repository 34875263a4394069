#pragma once

#include "fe2d/contact/joint_law.hpp"
#include "scene/anchor_bar.hpp"

#include <vector>

namespace damslip::fe2d {

/// Where a row of anchors crosses a joint: between two neighbouring pairs, by linear interpolation.
struct PlacedAnchor {
    AnchorBar bar;
    Eigen::Index pair = 0; ///< the upstream one of the two; of a joint with one pair that
    double share = 0.0;    ///< of the pair downstream of it, 0 ... 1 [-]
};

/// Anchors in the contact problem. Gap g and slip s of an anchor are those interpolated between its pairs, counted from
/// where it was put in, and its force -N d acts on the upper side in the same shares. While it is elastic N is linear within a
/// step, from the exact length at its start,
///
///     N = N₀ + (E A/L) d·Δ(g, s):    Z = (E A/L) b bᵀ,  b = d on the interpolated pairs
///
/// with d as it was when (g, s) last changed by 1 % of L, so that Z stays the same from step to step. Yielding: N = f_y A, slack
/// and snapped: N = 0, no Z. The dowel is cohesion of the pairs, F by N at the step's start: its work is part of
/// the contact's friction, not of energy().
///
/// Static stages: the first one (gravity) knows no anchor. Where one is prestressed the second is the stressing: the jack
/// holds N = P₀ whatever moves; then it is locked off. Passive anchors are put in at the same time. A motion without stages before
/// it locks them off where it starts.
///
/// A bar that reaches its rupture strain in a step is gone from the next one on.
class AnchorLaw final : public JointLaw {
public:
    /// @param pairs  m, of all planes
    AnchorLaw(std::vector<PlacedAnchor> anchors, Eigen::Index pairs);

    std::unique_ptr<JointLaw> clone() const override { return std::make_unique<AnchorLaw>(*this); }
    void begin(const JointStart& start) override;
    void add(JointTerms& terms) const override;
    JointFit revise(const ContactSolution& solution) override;
    void end(const ContactSolution& solution) override;
    JointEnergy energy() const override;
    void save(JointLawState& state) const override;
    void restore(const JointLawState& state) override;

    /// What the anchors of some pairs can do for a plane.
    struct Support {
        double normal = 0.0; ///< Σ N cos ψ', presses on the joint [N/m]
        double along = 0.0;  ///< Σ N sin ψ', against downstream slip [N/m]
        double moment = 0.0; ///< Σ (distance) N cos ψ', see pair_distance [N m/m]
        double dowel = 0.0;  ///< [N/m]
        bool any = false;
    };
    enum class Force { next_stage, yield }; ///< as the next static stage begins, or of bars that all yield
    /// @param first, count  pairs of the plane @param pair_distance  of them from the plane's upstream end [m]
    Support support(Force force, Eigen::Index first, Eigen::Index count, const Eigen::VectorXd& pair_distance) const;

    /// Slip at which every bar that has not snapped pulls back, whatever its inclination: the longest free length [m]; 0: none.
    double reach() const;

    bool locked_off() const { return phase_ == Phase::locked; }
    std::vector<AnchorOutcome> outcomes() const;

private:
    enum class Phase { absent, stressed, locked };

    struct Row {
        PlacedAnchor at;
        AnchorHistory history;
        double dowel_work = 0.0;                ///< spent [J/m]; the ledger has it in its friction
        double gap_zero = 0.0, slip_zero = 0.0; ///< where it was locked off [m]
        BarDirection direction;                 ///< d of Z
        BarDirection pulls;                     ///< of the force, where the step begins
        double gap_of_direction = 0.0, slip_of_direction = 0.0;

        // Of the step.
        double gap_start = 0.0, slip_start = 0.0; ///< of the joint there [m]
        double stretch_start = 0.0, stretch_end = 0.0, dowel = 0.0;
        AnchorState trial = AnchorState::elastic;
    };
    double interpolated(const Row& row, const Eigen::VectorXd& values, Eigen::Index shift = 0) const;
    double stretch_of(const Row& row, const ContactSolution& solution) const;
    void lock_off(Row& row, double gap, double slip) const;

    std::vector<Row> rows_;
    Eigen::Index pairs_;
    Phase phase_ = Phase::absent;
    double dt_ = 0.0, time_ = 0.0; ///< [s]
    int revisions_ = 0;
};

} // namespace damslip::fe2d
