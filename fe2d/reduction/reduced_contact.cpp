#include "fe2d/reduction/reduced_contact.hpp"

#include "core/watch.hpp"
#include "fe2d/reduction/reduced_run.hpp"
#include "fe2d/run/step_error.hpp"
#include "fe2d/solver/dense_product.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace damslip::fe2d {

using Eigen::Index;
using Eigen::VectorXd;

ReducedContact::ReducedContact(const ReducedModel& model, const ContactMemory& rest, const Contact& joint,
                               const ContactOptions& options)
    : model_(model), plane_(model.plane()), system_(model.system()), joint_(joint), options_(options),
      rest_force_(rest.force), rest_slip_(rest.slip), normal_force_(rest.force.head(plane_.pairs()).sum()),
      no_force_(VectorXd::Zero(2 * plane_.pairs()))
{
    state_.q = state_.q_v = state_.q_a = VectorXd::Zero(system_.modes.count());
    state_.p = state_.p_v = state_.p_a = state_.gap_v = state_.gap_a = no_force_;
    state_.contact = rest;
}

ReducedContact::Step& ReducedContact::step_of(double dt)
{
    const auto found = steps_.find(dt);
    if (found != steps_.end()) return found->second;
    const ReducedOperator& shared = model_.at(dt);
    ++counts_.factorisations;
    return steps_
        .emplace(dt, Step{&shared, std::make_unique<JointSolver>(shared.stiffness(), plane_.area, joint_, options_)})
        .first->second;
}

/// b without the force of the damping, the rates that make it (ReducedOperator), π and the known contact-like forces;
/// DynamicContact::right_hand_side in modal amplitudes since rest.
void ReducedContact::right_hand_side(const StepConstants& c, const GroundAcceleration& ground)
{
    const double alpha = c.scheme.alpha, w = 1.0 + alpha, cv = alpha + w * c.a4, ca = w * c.a5;
    const double b_k = system_.damping.constants.stiffness;
    const double h = w * ground.h - alpha * state_.ground.h, v = w * ground.v - alpha * state_.ground.v;
    const ReducedState& s = state_;
    const double drag_h = w * ground.drag_h - alpha * state_.ground.drag_h,
                 drag_v = w * ground.drag_v - alpha * state_.ground.drag_v;
    const double per_rate = 1.0 / (w * c.a1);
    rates_ = (per_rate * cv) * s.q_v + (per_rate * ca) * s.q_a;
    inertia_ = (c.a2 - c.a0 * per_rate * cv) * s.q_v + (c.a3 - c.a0 * per_rate * ca) * s.q_a;
    strain_ = -s.q - w * rates_;
    load_ = inertia_ + system_.modes.omega2.cwiseProduct(strain_);
    const auto of_dam = [&](const VectorXd& vector) { return vector.head(system_.dam_modes); }; // the others have zeros
    load_.head(system_.dam_modes) += h * of_dam(system_.modes.ground_x) - v * of_dam(system_.modes.ground_y) +
                                     drag_h * of_dam(system_.modes.dam_x) - drag_v * of_dam(system_.modes.dam_y);
    if (const ReducedWater* water = system_.water.get()) {
        const auto of_water = [&](auto& vector) { return vector.segment(system_.water_begin, water->count()); };
        const auto weighted = [&](double GroundAcceleration::*part) {
            return w * ground.*part - alpha * state_.ground.*part;
        };
        auto load = of_water(load_);
        load.setZero();
        add_product(water->mass, of_water(inertia_), load);
        add_product(water->stiffness, of_water(strain_), load);
        load += weighted(&GroundAcceleration::displacement_v) * water->displacement_y -
                weighted(&GroundAcceleration::velocity_h) * water->velocity_x +
                weighted(&GroundAcceleration::velocity_v) * water->velocity_y;
    }
    massless_ = (b_k * cv) * s.p_v + (b_k * ca) * s.p_a - s.p;
    known_ = alpha * s.contact.force + rest_force_;
    if (!system_.slips_damped()) return;
    const Index m = plane_.pairs();
    const double slip = cv * system_.weights.dot(s.gap_v.tail(m)) + ca * system_.weights.dot(s.gap_a.tail(m));
    const double mean = system_.mean_motion.dot(rates_) / per_rate;
    load_ -= (system_.slip_damping * slip) * system_.mean_motion;
    known_.tail(m) -= (system_.slip_damping * (slip - mean)) * system_.weights;
}

ContactReport ReducedContact::advance(double dt, const GroundAcceleration& ground, const ContactLaw& law)
{
    Step& step = step_of(dt);
    const ReducedOperator& op = *step.shared;
    const StepConstants& c = op.constants();
    const Index m = plane_.pairs();
    ContactMemory& memory = state_.contact;
    force_before_ = memory.force;
    slip_before_ = memory.slip;
    states_before_ = memory.states;
    right_hand_side(c, ground);
    op.stuck_force(load_, rates_, massless_, known_, work_, stuck_);
    subtract_columns(step.contact->stiffness(), memory.opening, stuck_);

    const Stopwatch before;
    solution_.states = memory.states;
    solution_.force = memory.force;
    elastic_ = memory.elastic;
    const ContactReport report = step.contact->solve(stuck_, law, memory.elastic, solution_);
    counts_.contact_seconds += before.seconds();

    gap_step_ = solution_.displacement;
    gap_step_.head(m) -= memory.opening;
    gap_step_.tail(m) += memory.elastic - elastic_;
    const double slip = system_.weights.dot(gap_step_.tail(m));
    op.finish(massless_, known_, solution_.force, slip, work_, modal_step_, massless_step_);

    const auto update = [&](const VectorXd& change, VectorXd& velocity, VectorXd& acceleration) {
        for (Index i = 0; i < change.size(); ++i) {
            const double v = velocity[i], a = acceleration[i];
            velocity[i] = c.a1 * change[i] - c.a4 * v - c.a5 * a;
            acceleration[i] = c.a0 * change[i] - c.a2 * v - c.a3 * a;
        }
    };
    state_.q += modal_step_;
    state_.p += massless_step_;
    update(modal_step_, state_.q_v, state_.q_a);
    update(massless_step_, state_.p_v, state_.p_a);
    update(gap_step_, state_.gap_v, state_.gap_a);
    memory.force = solution_.force;
    memory.states = solution_.states;
    memory.opening = solution_.displacement.head(m);
    memory.slip += solution_.displacement.tail(m);
    state_.time += dt;
    state_.ground = ground;
    land(step, law);
    friction_ -= 0.5 * (force_before_.tail(m) + memory.force.tail(m)).dot(memory.slip - slip_before_);

    counts_.contact_iterations += report.iterations;
    counts_.add(report, report.residual * stuck_.cwiseAbs().maxCoeff() / normal_force_);
    return report;
}

/// Changes of modes and massless body by the forces of jumps_, into modal_step_ and massless_step_.
void ReducedContact::change_by(const Step& step)
{
    const double slip = system_.weights.dot(jumps_.displacement.tail(plane_.pairs()));
    no_load_work_.free.setZero(system_.modes.count());
    step.shared->finish(no_force_, no_force_, jumps_.force, slip, no_load_work_, modal_step_, massless_step_);
}

/// DynamicContact::land() and settle() in modal amplitudes.
void ReducedContact::land(Step& step, const ContactLaw& law)
{
    ContactStates& states = state_.contact.states;
    if (!step.contact->lands(states_before_, states)) return;
    const bool shuts = step.contact->shuts(states_before_, states);
    jumps_.states = states;
    if (!(shuts ? step.contact->land(law, state_.gap_v, jumps_) : step.contact->hold(law, state_.gap_v, jumps_))) return;
    states = jumps_.states;
    ++counts_.landings;
    change_by(step);
    state_.q_v += modal_step_;
    state_.p_v += massless_step_;
    state_.gap_v += jumps_.displacement;
    if (!shuts || !step.contact->hold(law, state_.gap_a, jumps_)) return;
    change_by(step);
    state_.q_a += modal_step_;
    state_.p_a += massless_step_;
    state_.gap_a += jumps_.displacement;
    state_.contact.force += jumps_.force / step.shared->constants().a0;
}

double ReducedContact::mean_slip() const
{
    return system_.weights.dot(state_.contact.slip - rest_slip_);
}

double ReducedContact::crest() const
{
    return system_.modes.crest.dot(state_.q) + system_.modes.residual_crest.dot(state_.p);
}

namespace {

/// Modes of the estimate's reference: four times as many, or twice where that would cost more than the run.
int reference_modes(int modes)
{
    return std::max(2 * modes, std::min(4 * modes, 64));
}

} // namespace

const ReducedRun::Estimators& ReducedRun::estimators() const
{
    std::call_once(estimators_made_, [this] {
        if (model_->system().modes.complete) return;
        DamModes reference = dam_modes(full_.structure(), reference_modes(wanted_));
        if (!reference.regular) return;
        if (water_) {
            estimators_.reference = std::make_unique<const ReducedModel>(
                model_->plane(), system_of(std::move(reference)), scheme_of(scene_.time));
            return;
        }
        const auto coarse = [&](const ReducedSystem& system) {
            return std::make_unique<const ReducedModel>(coarse_.plane(), coarse_.coarsened(system),
                                                        scheme_of(scene_.time));
        };
        estimators_.kept = coarse(model_->system());
        estimators_.fewer = coarse(system_of(reference.first(3 + wanted_ / 2)));
        estimators_.reference = coarse(system_of(std::move(reference)));
    });
    return estimators_;
}

std::optional<double> ReducedRun::truncation_error(const Motion& motion, const Start& start,
                                                   const std::vector<double>& first) const
{
    if (model_->system().modes.complete) return 0.0;
    const Estimators& systems = estimators();
    if (!systems.reference) return std::numeric_limits<double>::quiet_NaN(); // the modes beyond did not converge
    const double modes = static_cast<double>(model_->system().dam_modes - 3);
    const double more = static_cast<double>(systems.reference->system().dam_modes - 3);
    if (water_) {
        Motion coarsest = motion;
        coarsest.parts = 1 << motion.halvings.value_or(0);
        Strength strength(start.contact, model_->plane());
        strength.follow(start.rest);
        RunResult result;
        shake(coarsest, *systems.reference, strength, start.rest, nullptr, result);
        if (result.status == Status::interrupted) return std::nullopt;
        const double to_more = largest_difference(first, result.history.slip);
        return systems.reference->system().modes.complete ? to_more : to_more / (1.0 - modes / more);
    }
    const ContactMemory memory = coarse_.shut(start.rest);
    Motion coarse_motion = motion;
    coarse_motion.contact.landing = Landing::ringing; // few pairs land together: jolts that the full plane has not
    bool interrupted = false;
    const auto slips = [&](const ReducedModel& model) {
        Strength strength(start.contact, coarse_.plane());
        strength.follow(memory);
        RunResult result;
        shake(coarse_motion, model, strength, memory, nullptr, result);
        interrupted = interrupted || result.status == Status::interrupted;
        return result.history.slip;
    };
    const double fewer = static_cast<double>(systems.fewer->system().dam_modes - 3);
    const std::vector<double> kept = slips(*systems.kept);
    const double to_more = largest_difference(kept, slips(*systems.reference));
    if (interrupted) return std::nullopt;
    if (systems.reference->system().modes.complete) return to_more;
    if (fewer < 1.0) return to_more / (1.0 - modes / more); // one mode: none to compare with, n^-1 as if the slower
    const double from_fewer = largest_difference(slips(*systems.fewer), kept);
    if (interrupted) return std::nullopt;
    // The error as n^-p: both differences tell it, and their ratio tells p.
    const auto gone = [&](double p) { return 1.0 - std::pow(modes / more, p); };
    const auto gained = [&](double p) { return std::pow(modes / fewer, p) - 1.0; };
    double slow = 1.0, fast = 2.0; // of modes whose frequencies grow as n^1/2; of smooth loads
    for (int k = 0; k < 40; ++k) {
        const double p = 0.5 * (slow + fast);
        (from_fewer * gone(p) > to_more * gained(p) ? slow : fast) = p;
    }
    return std::sqrt(to_more / gone(slow) * from_fewer / gained(slow));
}

} // namespace damslip::fe2d
