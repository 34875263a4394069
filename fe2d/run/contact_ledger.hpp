#pragma once

#include "fe2d/run/step_dam.hpp"
#include "fe2d/run/step_rock.hpp"
#include "fe2d/run/water_ledger.hpp"
#include "fe2d/time/energy.hpp"

#include <memory>

namespace damslip::fe2d {

/// Damping forces of the velocities that contact impulses took away at the end of a step (ContactLanding), for the work of
/// the next one.
struct LandingForces {
    Eigen::VectorXd dam, rock;                ///< C δv [N/m]; after a flight with M δa
    Eigen::VectorXd slip_rate, mean_velocity; ///< of the slip damping, by plane
    double impact = 0.0;                      ///< kinetic energy that the impulses of a rebound took [J/m]
};

/// Work ledger of the implicit steps: EnergyLedger with its products arranged for dam and rock joined by contact. K Δu,
/// M Δa, ... are differences of products of the states; vᵀKΔu stands for ΔuᵀKv. The dam adds what StepDam says, the rock what
/// StepRock does, the planes contact, friction and slip damping, the water what WaterLedger finds.
class ContactLedger {
public:
    ContactLedger(const StepOperators& operators, const Contact& joint, const StepState& start, StepDam& dam,
                  const StepRock& rock);

    /// A step has been made. @param state, dam, rock  at its end
    void add(const StepConstants& constants, const StepState& state, const StepChange& step, StepDam& dam,
             const StepRock& rock);
    /// Impulses have changed velocities and forces of the present state.
    void add_landing(const LandingForces& forces, const StepState& state, StepDam& dam, const StepRock& rock);
    /// P has changed. What moves on the rock is no motion of it: the forces of the two last instants are kept as they
    /// were, and the jump of the present ones counts with the next step. @param rock  with the new P
    void add_move(const Pairing::Matrix& change, const StepState& state, const StepRock& rock);

    const Energy& energy() const { return energy_; }
    double imbalance() const { return energy_.imbalance(start_); }
    double scale() const { return scale_; } ///< largest term so far [J/m]

private:
    /// What the equation of motion's forces at one instant need for their work.
    struct Forces {
        StepDam::Instant dam;
        BodyInstant rock;
        Eigen::VectorXd contact;       ///< λ
        Eigen::VectorXd slip_rate;     ///< ωᵀ ġ_t, by plane
        Eigen::VectorXd mean_velocity; ///< Pᵀ v of SlipDamping, by plane
    };
    void gather(const StepState& state, StepDam& dam, const StepRock& rock, Forces& forces) const;
    Eigen::VectorXd across(const Forces& forces) const;
    double stored(const Eigen::VectorXd& opening) const;
    void add_laws(const StepState& state, const Eigen::VectorXd& gap_step);
    double slip_work(const Eigen::VectorXd& slip_rate, const Eigen::VectorXd& mean_velocity);
    void note_laws(const JointEnergy& now);
    WaterLedger::Instant water_instant(const StepState& state, const StepDam& dam, const StepRock& rock) const;

    const ContactStructure& structure_;
    RunDamping damping_;
    const SlipDamping& slip_damping_;
    Contact joint_;
    Energy energy_, start_;
    double scale_ = 0.0;
    JointEnergy of_laws_; ///< as far as they are counted in `energy_`
    RockEnergy of_rock_;  ///< that radiates, as far as it is counted in `energy_`
    double stored_ = 0.0; ///< in soft normal contact, part of the strain energy [J/m]
    Forces forces_, before_, before2_;
    Eigen::VectorXd load_jump_; ///< force on the rock that moved with the last change of P [N/m]
    bool has_landed_ = false;
    LandingForces landed_;                            ///< since the last step, where it has landed
    std::shared_ptr<const WaterLedger> water_ledger_; ///< null: no acoustic water
    WaterLedger::Instant water_, water_before_, water_before2_;
    // Of the step at hand, and work space.
    Eigen::VectorXd rock_stiffness_step_, dam_step_, slip_, mean_; ///< K_c Δr; Δu without water; by plane
    Eigen::VectorXd contact_force_, opening_before_, rate_, mean_rate_, drag_, two_velocities_, edges_;
};

} // namespace damslip::fe2d
