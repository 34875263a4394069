#pragma once

#include "fe2d/run/contact_motion.hpp"
#include "fe2d/run/step_operators.hpp"
#include "fe2d/run/water_ledger.hpp"
#include "fe2d/time/energy.hpp"

#include <map>
#include <memory>
#include <optional>
#include <span>

namespace damslip::fe2d {

/// When a step's contact is not resolved, nothing of it is kept and it is made in two halves, these in halves again,
/// down to this share of it.
inline constexpr int largest_cuts = 4; ///< dt / 2^4

/// Error control of the steps: a step is made in halves, these in halves again, while its local error is larger than
/// wanted.
struct StepControl {
    double local_error = 0.0; ///< of slip and dam of one step [m]; 0: steps stay whole, their errors are only noted
    int largest_cuts = 0;     ///< smallest step dt / 2^k
};

/// HHT-α steps of dam, rock and contact (2-25), with the contact problem solved exactly in each. Equations:
/// DynamicOperator. Contact forces are weighted like internal forces, (1+α)λ₁ - αλ₀, slip damping and ground motion
/// too. A pair that sticks keeps its slip to the last bit, so nothing creeps.
///
/// A gap that is held from one step on keeps a velocity that rings in Newmark's formulas, v₁ = -(γ/β - 1) v₀: in a stiff
/// structure that, not elasticity, is most of the error of a step, and it makes landings bounce. So where some gap is
/// newly held, the velocities of all held gaps are made zero by contact impulses, see land().
///
/// Where the structure slides far, the opening is what the displacements and the present slip make it at the start of
/// each step, so the dam follows the bent surface of the rock; forces pass through the P of the last place where the
/// operators were made, at most `update_share` of an element away, so that a step's work is exact.
class DynamicContact final : public ContactMotion {
public:
    /// @param operators  shared with the other runs of this structure, damping and scheme
    /// @param load  static loads, constant during the motion
    /// @param start  in equilibrium under them; u, contact and rock are taken over, v = a = 0
    DynamicContact(std::shared_ptr<StepOperators> operators, SplitLoad load, const StaticState& start,
                   const ContactMemory& memory, const ContactOptions& options = {});
    DynamicContact(const ContactStructure& structure, const RunDamping& damping, const Scheme& scheme, SplitLoad load,
                   const StaticState& start, const ContactMemory& memory, const ContactOptions& options = {});

    /// One step to the given ground acceleration. @returns how the contact was solved; when unresolved the step has
    /// been made with the best state found.
    ContactReport advance(double dt, const GroundAcceleration& ground, const ContactLaw& law);

    /// From the next step on. @param control  of the steps that advance() is asked for
    void control(const StepControl& control) { control_ = control; }
    const std::vector<double>& local_errors() const { return local_errors_; } ///< of the steps made under control [m]

    /// One of several runs that share their operators and ground and go on in step.
    struct Lane {
        DynamicContact* run = nullptr;
        const ContactLaw* law = nullptr;
        ContactReport report;
    };
    /// advance() of each lane, with the same bits, in common passes over the factor.
    static void advance(std::span<Lane> lanes, double dt, const GroundAcceleration& ground);

    const DynamicState& state() const override { return state_; }
    /// False where the dam would leave the meshed plane: the step was not made (ContactStructure::slides_far()).
    bool within_reach() const;
    const Energy& energy() const override { return energy_; }
    double energy_imbalance() const override { return energy_.imbalance(energy_start_); }
    double energy_scale() const override { return energy_scale_; }
    const DynamicCounts& counts() const override { return counts_; }
    const LargestSlips& largest_slips() const override { return largest_slips_; }
    double static_normal_force() const override { return normal_force_; }
    const ContactStructure& structure() const override { return structure_; }
    std::size_t bytes() const override; ///< operators of its own step sizes included, which other runs may share

private:
    /// What the equation of motion's forces at one instant need for their work, see add_energy().
    struct Forces {
        Eigen::VectorXd dam;           ///< a_M M_dam v + K u - R
        Eigen::VectorXd ground;        ///< the moving ground's part of R
        Eigen::VectorXd v, a;          ///< of the dam
        Eigen::VectorXd rock;          ///< K_c r - f_r
        Eigen::VectorXd rock_v;        ///< of the rock
        Eigen::VectorXd contact;       ///< λ
        Eigen::VectorXd slip_rate;     ///< ωᵀ ġ_t, by plane
        Eigen::VectorXd mean_velocity; ///< Pᵀ v of SlipDamping, by plane
    };
    /// The contact problem of one step size at the present place of the dam on the rock.
    struct PairProblem {
        StepContact own; ///< where the dam has slid; else that of the operator
        int place = 0;   ///< number of the place it was made for
        std::unique_ptr<JointSolver> solver;
    };
    /// Damping forces of the velocities that land() took away, for the work ledger of the next step.
    struct Landing {
        bool pending = false;
        Eigen::VectorXd dam, rock;                ///< C δv
        Eigen::VectorXd slip_rate, mean_velocity; ///< of the slip damping, by plane
    };
    const DynamicOperator& operator_of(double dt);
    PairProblem& problem_of(const DynamicOperator& op);
    const StepContact& step_contact(const DynamicOperator& op, const PairProblem& problem) const;

    void begin(double dt, const GroundAcceleration& ground); ///< right-hand side of a step on free_.dam
    ContactReport solve_contact(const ContactLaw& law);      ///< after the forward pass
    void accept();                                           ///< before the backward pass
    void end(const GroundAcceleration& ground, const ContactReport& report,
             const ContactLaw& law); ///< the step itself, once Δu is known
    ContactReport step(double dt, const GroundAcceleration& ground, const ContactLaw& law, int cuts);
    ContactReport in_halves(double dt, const GroundAcceleration& ground, const ContactLaw& law, int cuts);
    bool wants_halves(const ContactReport& report, int cuts);
    bool wants_halves(int cuts);
    double slip_error() const;
    double dam_error() const;

    /// Of dam and rock.
    struct Change {
        Eigen::VectorXd dam, rock;
    };
    Eigen::VectorXd gap_values(const Eigen::VectorXd& dam, const Eigen::VectorXd& rock,
                               const Eigen::VectorXd& tangential) const;
    Change change_by(const ContactSolution& jumps) const;
    void land(const ContactStates& before, const ContactLaw& law);
    void settle(JointSolver& solver, const ContactLaw& law);
    void multiply(const StepConstants& constants);
    WaterLedger::Instant water_instant() const;
    void start_ledger();
    void gather_forces(Forces& forces) const;
    void add_energy(const StepConstants& constants, const Eigen::VectorXd& gap_step,
                    const Eigen::VectorXd& force_before);
    Eigen::VectorXd ground_force(const GroundAcceleration& ground) const;
    void right_hand_side(const StepConstants& constants, const GroundAcceleration& ground);
    void follow_slip();
    double base_slip() const { return structure_.planes().mean(0, state_.contact.slip); }
    Eigen::VectorXd opening_at(double slip) const;
    Eigen::VectorXd across(const Forces& forces) const;
    void slide_to(double slip, const Pairing::Matrix& trace);

    std::shared_ptr<StepOperators> operators_;
    const ContactStructure& structure_;
    RunDamping damping_;
    const SlipDamping& slip_damping_;
    SplitLoad load_;
    ContactOptions options_;
    std::optional<StepControl> control_;
    std::vector<double> local_errors_;
    int expected_cuts_ = 0;          ///< that the next step is likely to need: larger steps are not tried
    Pairing::Matrix trace_;          ///< P
    double trace_slip_ = 0.0;        ///< slip it was made for [m]
    int place_ = 0;                  ///< counts the places it was made for
    Eigen::VectorXd geometric_rest_; ///< see opening_at() [m]
    Eigen::VectorXd rock_load_;      ///< f_r [N/m]
    Eigen::VectorXd rock_rest_;      ///< K_c⁻¹ f_r
    Eigen::VectorXd load_jump_;      ///< force on the rock that moved with the last change of P, for the energy [N/m]
    std::map<const DynamicOperator*, PairProblem> problems_;
    double last_dt_ = 0.0;
    double normal_force_ = 0.0; ///< static N', the scale of residuals [N/m]

    DynamicState state_;
    Products products_;          ///< K u, K y, M v, M a of the state, y = b_K (cv v + ca a)
    Eigen::VectorXd rock_force_; ///< K_c r
    Eigen::VectorXd rate_t_;     ///< tangential gap rates ġ_t
    Eigen::VectorXd accel_t_;    ///< and accelerations
    Products before_;            ///< products of the state before, for the energy
    Eigen::VectorXd rock_force_before_;
    Forces forces_, forces_before_, forces_before2_;
    Landing landed_;
    Energy energy_, energy_start_;
    double energy_scale_ = 0.0;
    std::shared_ptr<const WaterLedger> water_ledger_; ///< null: no acoustic water
    WaterLedger::Instant water_, water_before_, water_before2_;
    double stored_ = 0.0; ///< in soft normal contact, part of the strain energy [J/m]
    DynamicCounts counts_;
    LargestSlips largest_slips_;

    // Of the step being made.
    const DynamicOperator* op_ = nullptr;
    DynamicOperator::Free free_;
    ContactSolution solution_;
    Eigen::VectorXd deformation_, combined_, known_, rock_gap_, stuck_, gap_, tilde_, du_, dr_;
    Eigen::VectorXd elastic_; ///< elastic part of the tangential gaps [m]
};

} // namespace damslip::fe2d
