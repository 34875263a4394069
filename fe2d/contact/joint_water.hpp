#pragma once

#include "fe2d/contact/joint_flow.hpp"
#include "fe2d/contact/joint_law.hpp"
#include "scene/joint_laws.hpp"
#include "scene/uplift_models.hpp"

#include <functional>
#include <memory>

namespace damslip::fe2d {

/// Pressure under the base with cracks of these lengths from heel and toe [m]: full head in them.
using CrackedUplift = std::function<PressureProfile(double heel, double toe)>;

/// Drains that shear off while the joint slips (drains.lost_at_slip): the pressure without them.
struct DrainLoss {
    double path = 0.0;           ///< sum of the joint's mean slips, both ways, at which the drains are lost [m]
    PressureProfile before;      ///< without a crack
    CrackedUplift cracked;       ///< as WetJoint::cracked
    CrackedUplift cracked_after; ///< as RunOptions::cracked_uplift_after; empty: the crack does not matter then
    CrackedUplift uplift_after;  ///< as RunOptions::uplift_after
};

/// A joint with water in it, as the laws of that water see it.
struct WetJoint {
    Eigen::Index first = 0;                                    ///< its first pair among all
    Eigen::VectorXd distance;                                  ///< of its m pairs from the upstream end [m]
    Eigen::VectorXd area;                                      ///< length that belongs to each [m]
    PressureProfile before;                                    ///< before the earthquake: a load, outside of the laws
    double upstream_pressure = 0.0, downstream_pressure = 0.0; ///< of the water before its ends; 0: dry [Pa]
    double fall = 0.0;                                         ///< sin θ of its slope, positive: dips downstream [-]
    /// With cracks of these lengths from the upstream and the downstream end: full head in them, and what that makes of
    /// the pressure beyond.
    CrackedUplift cracked;
    std::optional<DrainLoss> drain_loss; ///< none: the drains hold
    std::optional<Eigen::Index> drain;   ///< pair at the drains
    JointFluid fluid;                    ///< of JointWaterLaw

    Eigen::Index pairs() const { return area.size(); }
    double length() const { return area.sum(); }
};

/// Mean pressure on each pair: ∫ p N ds over its area, N linear between the pairs [Pa].
Eigen::VectorXd pair_pressure(const WetJoint& joint, const PressureProfile& profile);

/// Lengths of the runs of open pairs that begin at the two ends [m]: up to the place where the opening, continued linearly
/// from the last two open pairs, is zero, at most up to the first shut pair; of a single open pair half the way to it.
struct CrackLengths {
    double upstream = 0.0, downstream = 0.0;
};
/// Pressure under the base with cracks of these lengths from heel and toe [m]: full head in them.
/// @param opening, states  of the joint's pairs
CrackLengths crack_lengths(const WetJoint& joint, const Eigen::VectorXd& opening, const ContactStates& states);

/// What the water in a joint has come to, for people.
struct JointWaterReport {
    CrackLengths crack;                ///< now [m]
    CrackLengths largest;              ///< so far [m]
    double wet_length = 0.0;           ///< how far the water has come from the upstream end (opening mouth) [m]
    Eigen::VectorXd pressure;          ///< by pair now [Pa]
    Eigen::VectorXd force;             ///< on both faces of each pair, beyond that of the pressure before [N/m]
    double least_pressure = 0.0;       ///< so far [Pa]
    double largest_pressure = 0.0;     ///< so far [Pa]
    double reynolds_number = 0.0;      ///< largest so far, opening reynolds [-]
    double cracked_through = 0.0;      ///< time during which a crack went from end to end [s]
    JointFlowWork flow;                ///< opening reynolds, since the start [J/m]
    std::optional<double> drains_lost; ///< time since the start at which they sheared off [s]; none: they hold
};

/// Water that follows the opening of a joint: a change of the pressure before the earthquake, on both faces. It acts while
/// it shakes only; static stages (dt = 0) have the pressure of their load.
class CrackWater : public JointLaw {
public:
    virtual const JointWaterReport& report() const = 0;
    /// Pressure of the reservoir's waves at the upstream end, on top of the water at rest [Pa].
    virtual void set_wave_pressure(double) {}
    JointEnergy energy() const override { return energy_; }

    /// Another pressure at rest, part of the static load from now on: that after an earthquake, before the next one.
    virtual void rest_with(const PressureProfile& pressure);
    /// How far the joint has cracked, and sums and extremes for people. The water itself comes to rest.
    void save(JointLawState& state) const override;
    void restore(const JointLawState& state) override;

protected:
    explicit CrackWater(std::shared_ptr<const WetJoint> joint);
    void look(double dt, const Eigen::VectorXd& opening, const ContactStates& states);
    /// The step's slip is made: drains that have slipped far enough are lost from the next step on.
    void shear_drains(double dt, const ContactSolution& solution);
    void add_work(const Eigen::VectorXd& before, const Eigen::VectorXd& after, const Eigen::VectorXd& opened);

    std::shared_ptr<const WetJoint> joint_;
    Eigen::VectorXd at_rest_; ///< pressure before the earthquake by pair [Pa]
    Eigen::VectorXd lost_;    ///< what the loss of the drains has added to it [Pa]
    JointWaterReport report_;
    JointEnergy energy_;

private:
    void lose_drains();

    double time_ = 0.0, path_ = 0.0; ///< since the start [s]; of the mean slip, both ways [m]
};

/// @returns null for water that stays as it was: it neither follows (JointWaterLaw::follows()) nor loses its drains
std::unique_ptr<CrackWater> make_joint_water(const JointWaterLaw& law, std::shared_ptr<const WetJoint> joint);

} // namespace damslip::fe2d
