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
                         Eigen::VectorXd& b) const;
    void end_step(const StepConstants& constants, const DynamicState& state); ///< products of the new state

    /// What impulses do to the products: the velocities have changed. @returns C δv of the dam [N/m]
    Eigen::VectorXd change_velocity(const StepConstants& constants, const Eigen::VectorXd& change);
    /// The same of the accelerations. @returns M δa [N/m]
    Eigen::VectorXd change_acceleration(const StepConstants& constants, const Eigen::VectorXd& change);

    // For the ledger, the water left out: it has its own.
    struct Instant : BodyInstant {
        Eigen::VectorXd ground; ///< load by the moving ground [N/m]
        Eigen::VectorXd accel;  ///< [m/s²]
    };
    void instant(const DynamicState& state, Instant& now) const;
    double strain() const { return 0.5 * deformation_.dot(products_.stiffness_1); } ///< [J/m]
    const Eigen::VectorXd& load() const { return load_; }
    const Products& products() const { return products_; } ///< K u, K y, M v, M a of the state, y = b_K (c_v v + c_a a)
    const Products& products_before() const { return before_; } ///< of the state before the last step

private:
    void multiply(const StepConstants& constants, const DynamicState& state);
    Eigen::VectorXd ground_force(const GroundAcceleration& ground) const;

    const StepOperators& operators_;
    const ContactStructure& structure_;
    RunDamping damping_;
    Eigen::VectorXd load_;
    double dt_ = 0.0; ///< K y is for [s]
    Products products_, before_;
    Eigen::VectorXd deformation_, combined_;
};

} // namespace damslip::fe2d
