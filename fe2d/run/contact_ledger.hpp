#pragma once

#include "fe2d/contact/joint_laws.hpp"
#include "fe2d/fluid/coupled_system.hpp"
#include "fe2d/run/node_products.hpp"
#include "fe2d/run/step_parts.hpp"
#include "fe2d/time/energy.hpp"
#include "fe2d/time/scheme.hpp"

#include <memory>

namespace damslip::fe2d {

/// The water's part of the work ledger of a sliding run, see CoupledEnergy: kinetic ½ ψᵀL_b ψ and strain ½ pᵀQ_b p of the
/// water in the mesh, what its boundaries take, numerical dissipation of its own rows and of the coupling. Vectors of
/// states are in the order of the steps.
class WaterLedger {
public:
    WaterLedger(const WaterBody& body, const NodeOrder& order);

    /// One instant. Vectors without a word of their own are of the mesh's pressures, with the signs of a pressure
    /// equation: what the products of a step hold of the water, turned.
    struct Instant {
        Eigen::VectorXd phi, rate, accel; ///< φ, φ̇, φ̈
        Eigen::VectorXd flow;             ///< s² L_b φ
        Eigen::VectorXd mass_rate;        ///< s² Q_b φ̇
        Eigen::VectorXd mass_accel;       ///< s² Q_b φ̈
        Eigen::VectorXd boundary; ///< of the boundaries: s² (Q - Q_b) φ̈ + s² A φ̇ + s² (L - L_b) φ, on their rows
        Eigen::VectorXd face, face_velocity; ///< sHᵀu, sHᵀu̇ on the rows of the dam's face
        Eigen::VectorXd load;
        Eigen::VectorXd force; ///< F: all but the inertia s²Q φ̈
        FloorMotion floor;     ///< of a floor that is the rock's, times s: sv, sv̇; part of face, face_velocity, too
        Eigen::VectorXd jolt_rate; ///< change of φ̇ by contact impulses at its end; empty: none
        Eigen::VectorXd jolt;      ///< change of F by contact impulses at its end; empty: none
    };
    static double flow(const Instant& instant) { return 0.5 * instant.phi.dot(instant.flow); }              ///< [J/m]
    static double compression(const Instant& instant) { return 0.5 * instant.rate.dot(instant.mass_rate); } ///< [J/m]

    /// Motion of all unknowns in the order of the steps, and K z, M ż, M z̈ of it.
    struct Motion {
        const Eigen::VectorXd &z, &v, &a, &stiffness_z, &mass_v, &mass_a;
    };
    Instant instant(const Motion& motion, const FloorMotion& floor, double velocity_h, double velocity_v,
                    double displacement_v) const;

    /// Adds the step `before` -> `now`, what passes through the floor into the rock included; `before2` is the instant before these.
    void add(const StepConstants& constants, const Instant& before2, const Instant& before, const Instant& now,
             Energy& energy) const;

private:
    using Rows = Eigen::SparseMatrix<double, Eigen::RowMajor>;
    Eigen::VectorXd water_of(const Eigen::VectorXd& vector) const;
    Eigen::VectorXd on_floor(const Eigen::VectorXd& mesh) const;
    Eigen::VectorXd on(const std::vector<Eigen::Index>& rows, const Eigen::VectorXd& mesh) const;

    Eigen::Index mesh_;
    std::vector<Eigen::Index> place_;         ///< of the water's unknowns in the order of the steps
    std::vector<Eigen::Index> boundary_rows_; ///< of the mesh's, bottom, surface and far end
    Rows end_mass_, damping_, end_stiffness_; ///< s² (Q - Q_b), s² A, s² (L - L_b) on these rows
    std::vector<Eigen::Index> face_rows_;     ///< of the mesh's: the dam's face, and a floor that is the rock's
    std::vector<Eigen::Index> floor_;         ///< unknowns of that floor
    double scale_;                            ///< s
    Rows coupling_;                           ///< s Hᵀ, these rows x all unknowns in the order of the steps
    Eigen::VectorXd velocity_x_, velocity_y_, displacement_y_;
};

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

/// What happens when gaps come to be held at the end of a step: an open pair shuts, a slipping one sticks.
///
/// A gap that is held from one step on keeps a velocity that rings in Newmark's formulas, v₁ = -(γ/β - 1) v₀: in a stiff
/// structure that, not elasticity, is most of the error of a step, and it makes landings bounce. So contact impulses make the
/// velocities of all held gaps zero; what kinetic energy they take counts as numerical.
///
/// After a flight accelerations follow. A gap v Δt wide that shuts within a step leaves its end with an acceleration of up to
/// v/(β Δt) away from the plane, and a force as large: the next steps would throw the body back, and friction would have met the
/// force, not the impulse m v. Held gaps stand still: their accelerations become zero, forces on the pairs with them,
/// M δa = w Bᵀδλ. Through the step's operator that holds but for (w/a0)(a1 C + K) δa, which the ledger of the next step knows.
///
/// With restitution e a body that flew leaves its base again: pairs that shut with the rate ġ⁻ < -v_min get
///
///     ġ⁺ + e ġ⁻ >= 0,   P_n >= 0,   (ġ⁺ + e ġ⁻) P_n = 0,   |P_t| <= mu P_n     (Moreau 1988 with Newton's e)
///
/// and contact forces are zero from there on. v_min = 2|g̈|Δt: what is slower would be back within the step, e = 0. With one e
/// for all pairs friction may make energy (Kane & Levinson 1985): where ΔE = Σ P·(ġ⁻ + ġ⁺)/2 > 0, e of this landing is lowered
/// until it is not. Nodes that shut one by one keep e = 0: of an elastic body a restitution by node has no limit as the mesh
/// is refined, its loss is the waves it sends out.
class ContactLanding {
public:
    /// @param restitution  e of landings of the whole base [-]
    explicit ContactLanding(const StepOperators& operators, double restitution = 0.0);

    /// Gaps at the start of a step in which the body flies, and the rates that they shut with.
    struct Approach {
        double dt = 0.0; ///< of the step [s]
        Eigen::VectorXd
            rate; ///< 2m: normal ones when the gap is nil, by its acceleration; tangential ones of the start [m/s]
        Eigen::VectorXd accel; ///< normal ones [m/s²]
    };
    /// Nothing where landings do not rebound, or some pair is shut. @param state  at the start of the step
    std::optional<Approach> approach(const StepState& state, const StepRock& rock, double dt);

    /// @param op, solver  of the step that has just been made @param before  states at its start
    /// @param state, dam, rock  at its end: velocities, accelerations, forces and products change
    /// @returns what happened; null where no gap is newly held, or nothing can be done. Valid until the next landing
    const LandingForces* land(const DynamicOperator& op, JointSolver& solver, const ContactStates& before,
                              const ContactLaw& law, StepRock& rock, StepDam& dam, StepState& state,
                              const std::optional<Approach>& approach = {});

private:
    struct Rebound {
        ContactStates states;   ///< while the impulses act
        Eigen::VectorXd target; ///< ġ⁺ of the normal gaps [m/s]
        double loss = 0.0;      ///< -ΔE [J/m]
    };
    std::optional<Rebound> rebound(const StepConstants& constants, JointSolver& solver, const ContactLaw& law,
                                   const Approach& approach, const ContactStates& states) const;
    void release(const DynamicOperator& op, JointSolver& solver, StepRock& rock, StepDam& dam, StepState& state);
    void change_by(StepRock::Jump of, const DynamicOperator& op, StepRock& rock);
    void gap_values(const Eigen::VectorXd& dam, const Eigen::VectorXd& rock_values, const Eigen::VectorXd& tangential,
                    const StepRock& rock, Eigen::VectorXd& gap);
    void settle(const DynamicOperator& op, JointSolver& solver, const ContactLaw& law, StepRock& rock, StepDam& dam,
                StepState& state);
    void change_accelerations(const DynamicOperator& op, StepRock& rock, StepDam& dam, StepState& state);

    const ContactStructure& structure_;
    const SlipDamping& slip_damping_;
    double restitution_;

    // Of the landing at hand.
    LandingForces forces_;
    ContactSolution jumps_;          ///< of rates or accelerations of the gaps, and impulses or forces times a0
    DynamicOperator::Free free_;     ///< what they change of the dam
    Eigen::VectorXd rock_;           ///< and of the rock
    Eigen::VectorXd values_, force_; ///< of all gaps; on the pairs [N/m]
    Eigen::VectorXd none_, tilde_, on_gaps_, by_trace_; ///< work space
};

} // namespace damslip::fe2d
