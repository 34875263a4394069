#pragma once

#include "fe2d/contact/joint_laws.hpp"
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
    Eigen::VectorXd gap_v, gap_a; ///< rates of the gaps, elastic part included, 2m [m/s, m/s²]
    ContactMemory contact;
    GroundAcceleration ground;
};

/// The steps of DynamicContact on a reduced dam: same scheme, same contact solver, same damping.
class ReducedContact {
public:
    /// @param model  kept by reference
    /// @param rest  contact in static equilibrium; the motion starts there, at rest
    ReducedContact(const ReducedModel& model, const ContactMemory& rest, const Contact& joint = {},
                   const ContactOptions& options = {});

    /// One step to the given ground acceleration, as DynamicContact::advance.
    ContactReport advance(double dt, const GroundAcceleration& ground, const ContactLaw& law);

    const ReducedState& state() const { return state_; }
    const DynamicCounts& counts() const { return counts_; }
    double mean_slip() const; ///< area mean since the static state [m]
    double crest() const;     ///< horizontal motion of the crest since then, relative to the ground [m]
    double kinetic() const { return 0.5 * state_.q_v.squaredNorm(); } ///< of the modes [J/m]
    double friction() const { return friction_; } ///< dissipated since the start, by the mean force of each step [J/m]

private:
    /// A step size: what all runs share, and the contact solver of this run.
    struct Step {
        const ReducedOperator* shared;
        std::unique_ptr<JointSolver> contact;
    };
    Step& step_of(double dt);
    void change_by(const Step& step);
    void land(Step& step, const ContactLaw& law);
    void right_hand_side(const StepConstants& constants, const GroundAcceleration& ground);

    const ReducedModel& model_;
    const Plane& plane_;
    const ReducedSystem& system_;
    Contact joint_;
    ContactOptions options_;
    std::map<double, Step> steps_; ///< by size
    Eigen::VectorXd rest_force_, rest_slip_;
    double normal_force_ = 0.0; ///< static N', the scale of residuals [N/m]
    ReducedState state_;
    double friction_ = 0.0;
    DynamicCounts counts_;

    // Work space.
    Eigen::VectorXd load_, massless_, known_, stuck_, modal_step_, massless_step_, gap_step_, rates_, inertia_, strain_, elastic_;
    Eigen::VectorXd no_force_;                   ///< zeros
    Eigen::VectorXd force_before_, slip_before_; ///< of the step
    ContactStates states_before_;
    ContactSolution solution_, jumps_;
    ReducedOperator::Work work_, no_load_work_;
};

} // namespace damslip::fe2d
