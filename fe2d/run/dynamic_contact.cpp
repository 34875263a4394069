#include "fe2d/run/dynamic_contact.hpp"

#include "fe2d/contact/bond_law.hpp"
#include "fe2d/contact/joint_water.hpp"

#include <algorithm>

namespace damslip::fe2d {

using Eigen::VectorXd;

namespace {

StepState at_rest(const ContactStructure& structure, const StaticState& start, const ContactMemory& memory)
{
    StepState state;
    state.u = start.dam;
    state.v = state.a = VectorXd::Zero(structure.dam_unknowns());
    state.rock = structure.has_rock() ? start.rock : VectorXd();
    state.rock_v = state.rock_a = VectorXd::Zero(2 * structure.rock_nodes());
    state.contact = memory;
    state.rate_t = state.accel_t = VectorXd::Zero(structure.pairs());
    state.force_before = memory.force;
    return state;
}

} // namespace

GroundAcceleration middle_of(const GroundAcceleration& from, const GroundAcceleration& to, double dt)
{
    GroundAcceleration middle;
    for (const auto part : {&GroundAcceleration::h, &GroundAcceleration::v, &GroundAcceleration::velocity_h,
                            &GroundAcceleration::velocity_v, &GroundAcceleration::displacement_v,
                            &GroundAcceleration::drag_h, &GroundAcceleration::drag_v})
        middle.*part = 0.5 * (from.*part + to.*part);
    const double eighth = dt / 8.0;
    middle.velocity_h -= eighth * (to.h - from.h);
    middle.velocity_v -= eighth * (to.v - from.v);
    middle.displacement_v -= eighth * (to.velocity_v - from.velocity_v);
    return middle;
}

bool passes_over(int cuts, const JointLaws& laws)
{
    return cuts % 2 == 1 && laws.find<BondLaw>();
}

int most_cuts(const JointLaws& laws)
{
    // A line that cracks all at once has one answer in steps below about ℓ_ch over the speed of waves, some 0.1 ms.
    constexpr int of_bond = 8;
    return laws.find<BondLaw>() ? of_bond : largest_cuts;
}

DynamicContact::DynamicContact(const ContactStructure& structure, const RunDamping& damping, const Scheme& scheme,
                               const SplitLoad& load, const StaticState& start, const ContactMemory& memory,
                               const Contact& joint, const ContactOptions& options)
    : DynamicContact(std::make_shared<StepOperators>(structure, damping, scheme), load, start, memory, joint, options)
{
}

DynamicContact::DynamicContact(std::shared_ptr<StepOperators> operators, const SplitLoad& load,
                               const StaticState& start, const ContactMemory& memory, const Contact& joint,
                               const ContactOptions& options)
    : operators_(std::move(operators)), state_(at_rest(structure(), start, memory)),
      dam_(*operators_, load.dam, state_), rock_(*operators_, load, state_), stepper_(*operators_, joint, options),
      landing_(*operators_, joint.restitution), ledger_(*operators_, joint, state_, dam_, rock_),
      normal_force_(memory.force.head(structure().plane().pairs()).sum()),
      largest_slips_(structure().planes(), memory.slip)
{
}

bool DynamicContact::within_reach() const
{
    return !structure().slides_far() || structure().pairing().reaches(rock_.slip(state_));
}

void DynamicContact::set_wave_pressure(double pressure)
{
    for (const auto& law : state_.contact.laws.all())
        if (auto* water = dynamic_cast<CrackWater*>(law.get())) water->set_wave_pressure(pressure);
}

void DynamicContact::begin(double dt, const GroundAcceleration& ground)
{
    const StepConstants& constants = stepper_.take(dt).constants();
    counts_.factorisations = stepper_.step_sizes();
    dam_.prepare(constants, state_);
    if (structure().slides_far()) {
        state_.contact.opening = rock_.opening(state_);
        if (const auto change = rock_.follow(state_)) ledger_.add_move(*change, state_, rock_);
    }
    stepper_.begin(state_, ground, dam_, rock_);
}

void DynamicContact::end(const GroundAcceleration& ground, const ContactReport& report, const ContactLaw& law)
{
    const DynamicOperator& op = stepper_.op();
    states_before_ = state_.contact.states;
    const auto approach = landing_.approach(state_, rock_, op.constants().dt);
    const StepChange& change = stepper_.end(ground, rock_, state_);
    dam_.end_step(op.constants(), state_);
    rock_.end_step(state_);
    ledger_.add(op.constants(), state_, change, dam_, rock_);
    if (const LandingForces* forces =
            landing_.land(op, stepper_.solver(), states_before_, law, rock_, dam_, state_, approach)) {
        ledger_.add_landing(*forces, state_, dam_, rock_);
        ++counts_.landings;
    }
    counts_.add(report, report.residual * stepper_.largest_stuck_force() / normal_force_);
    largest_slips_.look(state_.contact.slip);
}

bool DynamicContact::cut_after_contact(const ContactReport& report, int cuts)
{
    return cuts_.after_contact(report, cuts, stepper_, state_, counts_);
}

/// Nothing of the state has changed when a step turns out not to be good enough.
ContactReport DynamicContact::in_halves(double dt, const GroundAcceleration& ground, const ContactLaw& law, int cuts)
{
    const ContactReport first = step(0.5 * dt, middle_of(state_.ground, ground, dt), law, cuts + 1);
    ContactReport second = step(0.5 * dt, ground, law, cuts + 1);
    second.path = std::max(first.path, second.path);
    second.iterations += first.iterations;
    second.residual = std::max(first.residual, second.residual);
    return second;
}

ContactReport DynamicContact::step(double dt, const GroundAcceleration& ground, const ContactLaw& law, int cuts)
{
    const bool passed_over = cuts_.expected() == 0 && passes_over(cuts, state_.contact.laws);
    if (cuts < cuts_.expected() || passed_over) return in_halves(dt, ground, law, cuts);
    begin(dt, ground);
    const InterfaceFactor& factor = stepper_.op().factor();
    factor.forward(stepper_.dam_vector());
    const ContactReport report = stepper_.solve(law, state_, rock_, counts_);
    if (cut_after_contact(report, cuts)) return in_halves(dt, ground, law, cuts);
    stepper_.accept(state_);
    factor.backward(stepper_.dam_vector());
    if (cut_after_step(cuts)) return in_halves(dt, ground, law, cuts);
    end(ground, report, law);
    return report;
}

ContactReport DynamicContact::advance(double dt, const GroundAcceleration& ground, const ContactLaw& law)
{
    return step(dt, ground, law, 0);
}

/// step() of each run, its two passes made of all together.
void DynamicContact::advance(std::span<BatchedRun> batch, double dt)
{
    if (batch.empty()) return;
    auto& [vectors, tried, whole, gathered] = batch.front().run->together_;
    vectors.clear();
    tried.clear();
    whole.clear();
    for (BatchedRun& batched : batch) {
        if (batched.run->cuts_.expected() > 0) {
            batched.report = batched.run->step(dt, batched.ground, *batched.law, 0);
            continue;
        }
        batched.run->begin(dt, batched.ground);
        tried.push_back(&batched);
        vectors.push_back(&batched.run->stepper_.dam_vector());
    }
    if (tried.empty()) return;
    const InterfaceFactor& factor = tried.front()->run->stepper_.op().factor();
    factor.forward(vectors, gathered);
    vectors.clear();
    for (BatchedRun* batched : tried) {
        DynamicContact& run = *batched->run;
        batched->report = run.stepper_.solve(*batched->law, run.state_, run.rock_, run.counts_);
        if (run.cut_after_contact(batched->report, 0)) {
            batched->report = run.in_halves(dt, batched->ground, *batched->law, 0);
            continue;
        }
        run.stepper_.accept(run.state_);
        whole.push_back(batched);
        vectors.push_back(&run.stepper_.dam_vector());
    }
    factor.backward(vectors, gathered);
    for (BatchedRun* batched : whole)
        if (batched->run->cut_after_step(0))
            batched->report = batched->run->in_halves(dt, batched->ground, *batched->law, 0);
        else
            batched->run->end(batched->ground, batched->report, *batched->law);
}

std::size_t DynamicContact::bytes() const
{
    return operators_->products().bytes() + stepper_.bytes() +
           16 * static_cast<std::size_t>(state_.u.size()) * sizeof(double);
}

int StepCuts::expected() const
{
    return control_ ? std::min(expected_, control_->largest_cuts) : 0;
}

bool StepCuts::after_contact(const ContactReport& report, int cuts, ContactStepper& step, const StepState& state,
                             DynamicCounts& counts) const
{
    const int more = control_ ? control_->largest_cuts : 0;
    if (!report.resolved() && cuts < most_cuts(state.contact.laws) + more) {
        ++counts.halved;
        return true;
    }
    if (cuts >= more || control_->local_error == 0.0 || step.slip_error(state) <= control_->local_error) return false;
    ++counts.refined;
    return true;
}

bool StepCuts::after_step(int cuts, const ContactStepper& step, const StepState& state, DynamicCounts& counts)
{
    if (!control_) return false;
    const double error = step.dam_error(state);
    if (cuts < control_->largest_cuts && control_->local_error > 0.0 && error > control_->local_error) {
        ++counts.refined;
        return true;
    }
    local_errors_.push_back(error);
    // twice the step has eight times the error
    expected_ = 8.0 * error > control_->local_error ? cuts : std::max(0, cuts - 1);
    return false;
}

} // namespace damslip::fe2d
