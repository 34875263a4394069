#pragma once

#include "fe2d/run/step_operators.hpp"
#include "fe2d/run/step_state.hpp"

namespace damslip::fe2d {

/// The dam in implicit steps, with the water and the rock with mass that stand among its unknowns: its forces, but for those
/// that pass the planes (contact, slip damping), and its products K u, M v, M a with the state, kept from step to step.
///
/// A step solves A_d Δu = load, so one product gives the other: K Δu = (load - a0 M Δu - w a1 a_M M_dam Δu)/(w (1 + a1 b_K)), and
/// all products of the new state follow as u, v and a do. Every few steps they are multiplied anew: round-off does not add up.
class StepDam {
public:
    /// @param load  static, constant during the motion, in the order of the structure [N/m]
    StepDam(const StepOperators& operators, Eigen::VectorXd load, const DynamicState& start);

    /// For steps of another size: products that depend on it.
    void prepare(const StepConstants& constants, const DynamicState& state);
    /// b_d of (2-25) without the forces that pass the planes [N/m].
    void right_hand_side(const StepConstants& constants, const DynamicState& state, const GroundAcceleration& ground,
                         Eigen::VectorXd& b) const;
    /// Whether products follow from loads; not with water and dashpots, whose parts A_d Δu does not tell apart.
    bool follows() const { return !structure_.water() && !structure_.gyrates(); }
    /// Products of the new state. @param change  that led to it
    void end_step(const StepConstants& constants, const DynamicState& state, const StepChange& change);

    /// What impulses do to the products: the velocities have changed. @param load  A_d δv @returns C δv of the dam [N/m]
    Eigen::VectorXd change_velocity(const StepConstants& constants, const Eigen::VectorXd& change,
                                    const Eigen::VectorXd& load);
    /// The same of the accelerations. @returns M δa [N/m]
    Eigen::VectorXd change_acceleration(const StepConstants& constants, const Eigen::VectorXd& change,
                                        const Eigen::VectorXd& load);

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
    void multiply_all(const StepConstants& constants, const DynamicState& state);
    void follow(const StepConstants& constants, const StepChange& change);
    void combine(const StepConstants& constants);
    void multiply_change(const StepConstants& constants, const Eigen::VectorXd& change, const Eigen::VectorXd& load);
    void take_dam_mass(const DynamicState& state);
    Eigen::VectorXd ground_force(const GroundAcceleration& ground) const;

    const StepOperators& operators_;
    const ContactStructure& structure_;
    RunDamping damping_;
    Eigen::VectorXd load_;
    double dt_ = 0.0; ///< K y is for [s]
    Products products_, before_;
    Eigen::VectorXd deformation_, combined_;
    Eigen::VectorXd of_velocity_, of_accel_; ///< K v, K a where products follow
    int followed_ = 0;                       ///< steps since they were multiplied
    Eigen::VectorXd stiffness_change_, mass_change_, dam_mass_change_; ///< K, M, M_dam times a change
};

} // namespace damslip::fe2d
