#pragma once

#include "fe2d/run/step_operators.hpp"
#include "fe2d/run/step_state.hpp"

#include <optional>

namespace damslip::fe2d {

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
