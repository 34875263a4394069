#pragma once

#include "fe2d/run/step_operators.hpp"
#include "fe2d/run/step_state.hpp"

namespace damslip::fe2d {

/// The dam in implicit steps, with the water and the rock with mass that stand among its unknowns: its forces, but for those
/// that pass the planes (contact, slip damping), and its products K u, M v, M a with the state, kept from step to step.
class StepDam {
public:
    /// @param load  static, constant during the motion, in the order of the structure [N/m]
    StepDam(const StepOperators& operators, Eigen::VectorXd load, const DynamicState& start);

    /// For steps of another size: products that depend on it.
    void prepare(const StepConstants& constants, const DynamicState& state);
    /// b_d of (2-25) without the forces that pass the planes [N/m].
    void right_hand_side(const StepConstants& constants, const DynamicState& state, const GroundAcceleration& ground,
                         Eigen::VectorXd& b);
    void end_step(const StepConstants& constants, const DynamicState& state); ///< products of the new state

    /// What impulses do to the products: the velocities have changed. @param damping  gets C δv of the dam [N/m]
    void change_velocity(const StepConstants& constants, const Eigen::VectorXd& change, Eigen::VectorXd& damping);
    /// The same of the accelerations. @returns M δa [N/m]; valid until the next change
    const Eigen::VectorXd& change_acceleration(const StepConstants& constants, const Eigen::VectorXd& change);

    // For the ledger, the water left out: it has its own.
    struct Instant : BodyInstant {
        Eigen::VectorXd ground; ///< load by the moving ground [N/m]
        Eigen::VectorXd accel;  ///< [m/s²]
    };
    void instant(const DynamicState& state, Instant& now);
    double strain() const { return 0.5 * deformation_.dot(products_.stiffness_1); } ///< [J/m]
    const Eigen::VectorXd& load() const { return load_; }
    const Products& products() const { return products_; } ///< K u, K y, M v, M a of the state, y = b_K (c_v v + c_a a)
    const Products& products_before() const { return before_; } ///< of the state before the last step

private:
    void multiply(const StepConstants& constants, const DynamicState& state);
    void ground_force(const GroundAcceleration& ground, Eigen::VectorXd& force) const;

    const StepOperators& operators_;
    const ContactStructure& structure_;
    RunDamping damping_;
    Eigen::VectorXd load_;
    double dt_ = 0.0; ///< K y is for [s]
    Products products_, before_;
    Eigen::VectorXd deformation_, combined_;
    Eigen::VectorXd stiffness_change_, mass_change_, dam_mass_change_; ///< work space
    Eigen::VectorXd ground_, ground_before_, motion_, gyration_;       ///< the same
};

} // namespace damslip::fe2d
