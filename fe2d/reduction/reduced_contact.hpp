#pragma once

#include "fe2d/reduction/reduced_operator.hpp"
#include "fe2d/run/dynamic_contact.hpp"

#include <map>
#include <memory>

namespace damslip::fe2d {

/// Motion since the static state, on the modes kept, and the contact as in the full run.
struct ReducedState {
    double time = 0.0;           ///< [s]
    Eigen::VectorXd q, q_v, q_a; ///< modal amplitudes since the static state
    Eigen::VectorXd p, p_v, p_a; ///< elastic force of the massless body since then, and its rates [N/m]
    ContactMemory contact;
    GroundAcceleration ground;
};

/// The steps of DynamicContact on a reduced dam: same scheme, same contact solver, same damping.
class ReducedContact {
public:
    /// @param system  kept by reference
    /// @param rest  contact in static equilibrium; the motion starts there, at rest
    ReducedContact(const Plane& plane, const ReducedSystem& system, const Scheme& scheme, const ContactMemory& rest,
                   const Contact& joint = {}, const ContactOptions& options = {});

    /// One step to the given ground acceleration, as DynamicContact::advance.
    ContactReport advance(double dt, const GroundAcceleration& ground, const ContactLaw& law);

    const ReducedState& state() const { return state_; }
    const DynamicCounts& counts() const { return counts_; }
    double mean_slip() const; ///< area mean since the static state [m]
    double crest() const;     ///< horizontal motion of the crest since then, relative to the ground [m]
    double kinetic() const { return 0.5 * state_.q_v.squaredNorm(); } ///< of the modes [J/m]

private:
    ReducedOperator& operator_of(double dt);
    double change_by(ReducedOperator& op, const ContactSolution& jumps);
    void land(ReducedOperator& op, const ContactStates& before, const ContactLaw& law);
    void right_hand_side(const StepConstants& constants, const GroundAcceleration& ground);

    const Plane& plane_;
    const ReducedSystem& system_;
    Scheme scheme_;
    Contact joint_;
    ContactOptions options_;
    std::map<double, std::unique_ptr<ReducedOperator>> operators_;
    Eigen::VectorXd rest_force_, rest_slip_;
    double normal_force_ = 0.0; ///< static N', the scale of residuals [N/m]
    ReducedState state_;
    double rate_ = 0.0, accel_ = 0.0; ///< of the area-weighted tangential gap [m/s, m/s²]
    Eigen::VectorXd load_, massless_, known_, stuck_, modal_step_, massless_step_; ///< work space
    ContactSolution solution_;
    DynamicCounts counts_;
};

} // namespace damslip::fe2d
