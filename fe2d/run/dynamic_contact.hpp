#pragma once

#include "fe2d/run/contact_landing.hpp"
#include "fe2d/run/contact_ledger.hpp"
#include "fe2d/run/contact_stepper.hpp"
#include "fe2d/run/step_cuts.hpp"

#include <memory>
#include <span>
#include <vector>

namespace damslip::fe2d {

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
    struct Lane {
        DynamicContact* run = nullptr;
        const ContactLaw* law = nullptr;
        GroundAcceleration ground; ///< at the end of the step
        ContactReport report;
    };
    /// advance() of each lane, with the same bits, in common passes over the factor.
    static void advance(std::span<Lane> lanes, double dt);

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

    /// Work space of steps of several lanes, kept by the first of them.
    struct Together {
        std::vector<Eigen::VectorXd*> vectors;
        std::vector<Lane*> tried, whole;
        std::vector<double> gathered;
    };
    Together together_;
};

} // namespace damslip::fe2d
