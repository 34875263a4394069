#pragma once

#include "fe2d/run/contact_ledger.hpp"
#include "fe2d/run/contact_stepper.hpp"

#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace damslip::fe2d {

/// When a step's contact is not resolved, nothing of it is kept and it is made in two halves, these in halves again,
/// down to this share of it.
inline constexpr int largest_cuts = 4; ///< dt / 2^4
int most_cuts(const JointLaws& laws);  ///< the same with these laws: bonds need more
bool passes_over(int cuts, const JointLaws& laws); ///< of bonds every other length is tried: each has matrices of its own

/// The ground half-way through a step: velocities by the trapezoid, displacements by velocities, for the acceleration is linear.
GroundAcceleration middle_of(const GroundAcceleration& from, const GroundAcceleration& to, double dt);

/// Error control of the steps: a step is made in halves, these in halves again, while its local error is larger than
/// wanted.
struct StepControl {
    double local_error = 0.0; ///< of slip and dam of one step [m]; 0: steps stay whole, their errors are only noted
    int largest_cuts = 0;     ///< smallest step dt / 2^k
};

/// Says which steps are made in halves: those whose contact is not resolved, and with control those whose error is too
/// large.
class StepCuts {
public:
    void control(const StepControl& control) { control_ = control; }
    int expected() const; ///< cuts the next step is likely to need: larger steps are not tried
    const std::vector<double>& local_errors() const { return local_errors_; } ///< of the steps made under control [m]

    /// Asked when the contact of a step is known and nothing of the step is kept yet. @param cuts  that led to it
    bool after_contact(const ContactReport& report, int cuts, ContactStepper& step, const StepState& state,
                       DynamicCounts& counts) const;
    /// Asked again when all of the step is known.
    bool after_step(int cuts, const ContactStepper& step, const StepState& state, DynamicCounts& counts);

private:
    std::optional<StepControl> control_;
    int expected_ = 0;
    std::vector<double> local_errors_;
};

/// Implicit motion of dam, rock and contact. Each step: the stepper makes it (ContactStepper), whole or in halves (StepCuts), the
/// ledger adds up its work (ContactLedger), and where gaps come to be held they are brought to rest (ContactLanding).
class DynamicContact final : public ContactMotion {
public:
    /// @param operators  shared with the other runs of this structure, damping and scheme
    /// @param load  static loads, constant during the motion
    /// @param start  in equilibrium under them; u, contact and rock are taken over, v = a = 0
    /// @param joint  law of the joints, see JointSolver
    DynamicContact(std::shared_ptr<StepOperators> operators, const SplitLoad& load, const StaticState& start,
                   const ContactMemory& memory, const Contact& joint = {}, const ContactOptions& options = {});
    DynamicContact(const ContactStructure& structure, const RunDamping& damping, const Scheme& scheme,
                   const SplitLoad& load, const StaticState& start, const ContactMemory& memory,
                   const Contact& joint = {}, const ContactOptions& options = {});

    /// One step to the given ground acceleration. @returns how the contact was solved; when unresolved the step has
    /// been made with the best state found.
    ContactReport advance(double dt, const GroundAcceleration& ground, const ContactLaw& law);

    /// From the next step on. @param control  of the steps that advance() is asked for
    void control(const StepControl& control) { cuts_.control(control); }
    /// Largest slips are counted from these of all pairs, in place of those at the start [m].
    void count_slips_from(const Eigen::VectorXd& start) { largest_slips_.count_from(start); }
    const std::vector<double>& local_errors() const { return cuts_.local_errors(); }

    /// One of several runs that share their operators and go on in step.
    struct BatchedRun {
        DynamicContact* run = nullptr;
        const ContactLaw* law = nullptr;
        GroundAcceleration ground; ///< at the end of the step
        ContactReport report;
    };
    /// advance() of each run, with the same bits, in common passes over the factor.
    static void advance(std::span<BatchedRun> batch, double dt);

    /// Of the reservoir's waves at the upstream end of the base, for water that flows along it, until the next call [Pa].
    void set_wave_pressure(double pressure);

    const DynamicState& state() const override { return state_; }
    /// False where the dam would leave the meshed plane: the step was not made (ContactStructure::slides_far()).
    bool within_reach() const;
    const Energy& energy() const override { return ledger_.energy(); }
    double energy_imbalance() const override { return ledger_.imbalance(); }
    double energy_scale() const override { return ledger_.scale(); }
    const DynamicCounts& counts() const override { return counts_; }
    const LargestSlips& largest_slips() const override { return largest_slips_; }
    double static_normal_force() const override { return normal_force_; }
    const ContactStructure& structure() const override { return operators_->structure(); }
    std::size_t bytes() const override; ///< operators of its own step sizes included, which other runs may share

private:
    void begin(double dt, const GroundAcceleration& ground);
    void end(const GroundAcceleration& ground, const ContactReport& report, const ContactLaw& law);
    ContactReport step(double dt, const GroundAcceleration& ground, const ContactLaw& law, int cuts);
    ContactReport in_halves(double dt, const GroundAcceleration& ground, const ContactLaw& law, int cuts);
    bool cut_after_contact(const ContactReport& report, int cuts);
    bool cut_after_step(int cuts) { return cuts_.after_step(cuts, stepper_, state_, counts_); }

    std::shared_ptr<StepOperators> operators_;
    StepState state_;
    StepDam dam_;
    StepRock rock_;
    ContactStepper stepper_;
    ContactLanding landing_;
    ContactLedger ledger_;
    StepCuts cuts_;
    double normal_force_; ///< static N', the scale of residuals [N/m]
    DynamicCounts counts_;
    LargestSlips largest_slips_;
    ContactStates states_before_; ///< work space: at the start of the step

    /// Work space of steps of several runs, kept by the first of them.
    struct Together {
        std::vector<Eigen::VectorXd*> vectors;
        std::vector<BatchedRun*> tried, whole;
        std::vector<double> gathered;
    };
    Together together_;
};

} // namespace damslip::fe2d
