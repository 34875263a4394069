#pragma once

#include "fe2d/run/contact_motion.hpp"
#include "fe2d/run/dynamic_operator.hpp"
#include "fe2d/run/node_products.hpp"

#include <map>
#include <memory>
#include <mutex>
#include <optional>

namespace damslip::fe2d {

/// Everything of the steps that is linear, by step size: made when first asked for, then shared by all runs of one
/// structure, damping and scheme, whatever their friction and motion. Threads may ask at the same time.
class StepOperators {
public:
    /// @param radiating  the rock of the motion on the plane of the base, rows as the structure's rock nodes; null: the massless one
    StepOperators(const ContactStructure& structure, const RunDamping& damping, const Scheme& scheme,
                  std::shared_ptr<const ReducedRock> radiating = {});
    StepOperators(const StepOperators&) = delete;
    StepOperators& operator=(const StepOperators&) = delete;

    const ContactStructure& structure() const { return structure_; }
    const RunDamping& damping() const { return damping_; }
    const SlipDamping& slip_damping() const { return slip_damping_; }
    const Scheme& scheme() const { return scheme_; }
    const ReducedRock* radiating() const { return radiating_.get(); } ///< null: rigid base or massless rock
    const BlockProducts& products() const { return products_; }

    const DynamicOperator& at(double dt); ///< @param dt  > 0 [s]
    int made() const;                     ///< factorisations so far

private:
    const ContactStructure& structure_;
    RunDamping damping_;
    Scheme scheme_;
    std::shared_ptr<const ReducedRock> radiating_;
    SlipDamping slip_damping_;
    BlockProducts products_;
    mutable std::mutex mutex_;
    std::map<double, std::unique_ptr<const DynamicOperator>> operators_;
};

/// All that goes from one implicit step to the next, apart from products kept for speed.
struct StepState : DynamicState {
    Eigen::VectorXd rate_t;  ///< tangential gap rates ġ_t [m/s]; kept for themselves: a pair that sticks has none,
                             ///< to the last bit
    Eigen::VectorXd accel_t; ///< and accelerations [m/s²]
    Eigen::VectorXd force_before;     ///< λ one step ago [N/m]
    Eigen::VectorXd law_force_before; ///< of it, the laws of the joint (JointLaws::force()); empty: no laws
};

/// What one step changed.
struct StepChange {
    Eigen::VectorXd dam;  ///< Δu [m]
    Eigen::VectorXd rock; ///< Δr [m]
    Eigen::VectorXd gap;  ///< Δg, 2m [m]
};

/// A body at one instant, as the work ledger wants it.
struct BodyInstant {
    Eigen::VectorXd force;    ///< of its equation of motion, without inertia, stiffness damping and contact [N/m]
    Eigen::VectorXd velocity; ///< [m/s]
};

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

/// Of the rock under the water, where the water's floor is the rock's (ReducedRock::floor); empty: it is not.
struct FloorMotion {
    Eigen::VectorXd volume; ///< v [m²]
    Eigen::VectorXd rate;   ///< v̇ [m²/s]
};

/// The rock below the dam in implicit steps, and where on it the dam stands: massless, K_c on its contact nodes, or radiating
/// (RockMotion). A rigid base gives nothing anywhere.
///
/// Steps know the rock by this class and by its compliance, P W_r Pᵀ in DynamicOperator::contact_at(): the contact sees the
/// free motion, the step the motion under contact forces, the ledger strain, loads and forces.
///
/// Radiating rock moves from the static state on: what acts on it is what contact and water press more than at rest, and in
/// the ledger only this appears, as a load, with energies of its own.
///
/// Where the dam slides far, the opening is what the displacements and the present slip make it at the start of each
/// step, so the dam follows the bent surface of the rock; forces pass through the P of the last place where the
/// operators were made, at most `update_share` of an element away, so that a step's work is exact.
class StepRock {
public:
    /// @param start  displacements, and the opening that belongs to them
    StepRock(const StepOperators& operators, const SplitLoad& load, const DynamicState& start);

    // Where the dam stands.
    const Pairing::Matrix& trace() const { return trace_; } ///< P
    int place() const { return place_; }                    ///< counts the places P was made for; 0: as in the statics
    double slip(const DynamicState& state) const;           ///< of the base, area mean [m]
    /// Opening of the joint by displacements and place, less the slip of the static stages, which dynamics leave out [m].
    Eigen::VectorXd opening(const DynamicState& state) const;
    /// Renews P where the dam has slid too far for it. @returns the change of P; nothing: P still holds
    std::optional<Pairing::Matrix> follow(const DynamicState& state);
    const Eigen::VectorXd& water_in_joint() const { return surface_.joint; } ///< SplitLoad::joint

    // The step.
    void begin_step(const DynamicOperator& op, const DynamicState& state);
    /// What the rock's free motion does to the water on a floor that is its own. @param dam  b_d, before the forward pass
    void load_water(const DynamicOperator& op, Eigen::VectorXd& dam) const;
    FloorMotion floor() const; ///< at the end of the last step
    /// Free motion as part of the gaps, P r*, 2m [m]; empty: rigid base. Valid until the next step.
    const Eigen::VectorXd& free_gap();
    /// @param gap  change of the gaps [m] @param tilde  λ̃ [N/m], both of the step, as in DynamicOperator
    /// @param change  gets Δr [m]; empty: rigid base
    void step(const DynamicOperator& op, const DynamicOperator::Free& dam, const Eigen::VectorXd& gap,
              const Eigen::VectorXd& tilde, Eigen::VectorXd& change);
    enum class Jump { velocity, acceleration };
    /// The same by impulses, of velocities or accelerations: without free motion.
    void jump(Jump of, const DynamicOperator& op, const DynamicOperator::Free& dam, const Eigen::VectorXd& gap,
              const Eigen::VectorXd& tilde, Eigen::VectorXd& change);
    void end_step(const DynamicState& state);
    /// b_K K_c ṙ [N/m]; empty: rigid base
    void damping_force(const Eigen::VectorXd& velocity, Eigen::VectorXd& force) const;

    // For the ledger. Of radiating rock instant() has the loads alone, stiffness_step() and damping_force() nothing.
    void instant(const DynamicState& state, BodyInstant& now) const;
    double strain(const DynamicState& state) const;                                       ///< [J/m]
    void stiffness_step(Eigen::VectorXd& force) const { force = force_ - force_before_; } ///< K_c Δr [N/m]
    const Eigen::VectorXd& load() const { return load_; } ///< f_r; since rest, of radiating rock [N/m]
    RockEnergy energy() const { return motion_ ? motion_->energy() : RockEnergy(); } ///< of radiating rock

private:
    void find_load();
    double on_floor(const Eigen::VectorXd& dam, Eigen::Index k) const;
    const Eigen::VectorXd& weighted_force(const DynamicOperator& op, const DynamicOperator::Free& dam,
                                          const Eigen::VectorXd& tilde);
    void opposite(const DynamicOperator::Free& dam, const Eigen::VectorXd& gap, Eigen::VectorXd& change);
    void by_compliance(double share, const Eigen::VectorXd& tilde, Eigen::VectorXd& change);

    const ContactStructure& structure_;
    double stiffness_damping_;         ///< b_K [s]
    std::optional<RockMotion> motion_; ///< of radiating rock
    Eigen::VectorXd held_;             ///< K_c r at rest, which radiating rock bears all the time [N/m]
    SplitLoad surface_;                ///< `rock` and `joint` of the static load
    Pairing::Matrix trace_;
    double trace_slip_ = 0.0; ///< slip it was made for [m]
    int place_ = 0;
    Eigen::VectorXd geometric_rest_;                           ///< see opening() [m]
    Eigen::VectorXd load_, rest_;                              ///< f_r [N/m], K_c⁻¹ f_r
    Eigen::VectorXd force_, force_before_;                     ///< K_c r
    Eigen::VectorXd free_;                                     ///< r* of massless rock
    Eigen::VectorXd free_gap_;                                 ///< P r*
    Eigen::VectorXd constant_, weighted_, on_pairs_, on_rock_; ///< work space
};

} // namespace damslip::fe2d
