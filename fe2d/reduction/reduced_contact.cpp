#include "fe2d/reduction/reduced_contact.hpp"

#include "core/stopwatch.hpp"
#include "fe2d/run/dense_product.hpp"

#include <algorithm>

namespace damslip::fe2d {

using Eigen::Index;
using Eigen::VectorXd;

ReducedContact::ReducedContact(const Plane& plane, const ReducedSystem& system, const Scheme& scheme,
                               const ContactMemory& rest, const Contact& joint, const ContactOptions& options)
    : plane_(plane), system_(system), scheme_(scheme), joint_(joint), options_(options), rest_force_(rest.force),
      rest_slip_(rest.slip), normal_force_(rest.force.head(plane.pairs()).sum())
{
    state_.q = state_.q_v = state_.q_a = VectorXd::Zero(system.modes.count());
    state_.p = state_.p_v = state_.p_a = VectorXd::Zero(2 * plane.pairs());
    state_.contact = rest;
}

ReducedOperator& ReducedContact::operator_of(double dt)
{
    auto& slot = operators_[dt];
    if (!slot) {
        slot = std::make_unique<ReducedOperator>(plane_, system_, step_constants(scheme_, dt), joint_, options_);
        ++counts_.factorisations;
    }
    return *slot;
}

/// b, π and the known contact-like forces; DynamicContact::right_hand_side in modal amplitudes since rest.
void ReducedContact::right_hand_side(const StepConstants& c, const GroundAcceleration& ground)
{
    const double alpha = c.scheme.alpha, w = 1.0 + alpha, cv = alpha + w * c.a4, ca = w * c.a5;
    const double a_m = system_.damping.constants.mass, b_k = system_.damping.constants.stiffness;
    const double h = w * ground.h - alpha * state_.ground.h, v = w * ground.v - alpha * state_.ground.v;
    const ReducedState& s = state_;
    const double drag_h = w * ground.drag_h - alpha * state_.ground.drag_h,
                 drag_v = w * ground.drag_v - alpha * state_.ground.drag_v;
    load_ = h * system_.modes.ground_x - v * system_.modes.ground_y + drag_h * system_.modes.dam_x -
            drag_v * system_.modes.dam_y + c.a2 * s.q_v + c.a3 * s.q_a +
            a_m * (system_.modes.dam_mass * VectorXd(cv * s.q_v + ca * s.q_a)) +
            system_.modes.omega2.cwiseProduct((b_k * cv) * s.q_v + (b_k * ca) * s.q_a - s.q);
    system_.subtract_radiation(-(cv * s.q_v + ca * s.q_a), load_);
    massless_ = (b_k * cv) * s.p_v + (b_k * ca) * s.p_a - s.p;
    known_ = alpha * s.contact.force + rest_force_;
    if (!system_.slips_damped()) return;
    const double slip = cv * rate_ + ca * accel_;
    const double mean = system_.mean_motion.dot(cv * s.q_v + ca * s.q_a);
    load_ -= (system_.slip_damping * slip) * system_.mean_motion;
    known_.tail(system_.weights.size()) -= (system_.slip_damping * (slip - mean)) * system_.weights;
}

ContactReport ReducedContact::advance(double dt, const GroundAcceleration& ground, const ContactLaw& law)
{
    ReducedOperator& op = operator_of(dt);
    const StepConstants& c = op.constants();
    const Index m = plane_.pairs();
    right_hand_side(c, ground);
    op.stuck_force(load_, massless_, known_, stuck_);
    ContactMemory& memory = state_.contact;
    const Eigen::MatrixXd& stiffness = op.contact().stiffness();
    for (Index i = 0; i < m; ++i)
        if (memory.opening[i] != 0.0) stuck_ -= memory.opening[i] * stiffness.col(i);

    const Stopwatch before;
    solution_.states = memory.states;
    solution_.force = memory.force;
    const VectorXd elastic = memory.elastic;
    const ContactReport report = op.contact().solve(stuck_, law, memory.elastic, solution_);
    counts_.contact_seconds += before.seconds();

    const VectorXd tangential = solution_.displacement.tail(m) + memory.elastic - elastic;
    const double slip = system_.weights.dot(tangential);
    op.finish(load_, massless_, known_, solution_.force, slip, modal_step_, massless_step_);

    const auto update = [&](const auto& step, auto& x, auto& velocity, auto& acceleration) {
        x += step;
        for (Index i = 0; i < x.size(); ++i) {
            const double v = velocity[i], a = acceleration[i];
            velocity[i] = c.a1 * step[i] - c.a4 * v - c.a5 * a;
            acceleration[i] = c.a0 * step[i] - c.a2 * v - c.a3 * a;
        }
    };
    update(modal_step_, state_.q, state_.q_v, state_.q_a);
    update(massless_step_, state_.p, state_.p_v, state_.p_a);
    const double rate = c.a1 * slip - c.a4 * rate_ - c.a5 * accel_;
    accel_ = c.a0 * slip - c.a2 * rate_ - c.a3 * accel_;
    rate_ = rate;
    const ContactStates states_before = memory.states;
    memory.force = solution_.force;
    memory.states = solution_.states;
    memory.opening = solution_.displacement.head(m);
    memory.slip += solution_.displacement.tail(m);
    state_.time += dt;
    state_.ground = ground;
    land(op, states_before, law);

    counts_.contact_iterations += report.iterations;
    counts_.add(report, report.residual * stuck_.cwiseAbs().maxCoeff() / normal_force_);
    return report;
}

/// Changes of modes and massless body by forces on the pairs, into modal_step_ and massless_step_.
/// @returns the change of the mean tangential gap
double ReducedContact::change_by(ReducedOperator& op, const ContactSolution& jumps)
{
    const Index m = plane_.pairs();
    const double slip = system_.weights.dot(jumps.displacement.tail(m));
    const VectorXd none = VectorXd::Zero(2 * m);
    op.finish(VectorXd::Zero(system_.modes.count()), none, none, jumps.force, slip, modal_step_, massless_step_);
    return slip;
}

/// DynamicContact::land() and settle() in modal amplitudes.
void ReducedContact::land(ReducedOperator& op, const ContactStates& before, const ContactLaw& law)
{
    ContactStates& states = state_.contact.states;
    if (!op.contact().lands(before, states)) return;
    const bool shuts = op.contact().shuts(before, states);
    const auto gaps = [&](const VectorXd& modes, const VectorXd& massless) {
        VectorXd values, of_massless;
        set_product(system_.modes.on_plane, modes, values);
        set_product(system_.flexibility, massless, of_massless);
        return VectorXd(values + of_massless);
    };
    ContactSolution jumps{states, {}, {}};
    const VectorXd rate = gaps(state_.q_v, state_.p_v);
    if (!(shuts ? op.contact().land(law, rate, jumps) : op.contact().hold(law, rate, jumps))) return;
    states = jumps.states;
    ++counts_.landings;
    rate_ += change_by(op, jumps);
    state_.q_v += modal_step_;
    state_.p_v += massless_step_;
    if (!shuts || !op.contact().hold(law, gaps(state_.q_a, state_.p_a), jumps)) return;
    accel_ += change_by(op, jumps);
    state_.q_a += modal_step_;
    state_.p_a += massless_step_;
    state_.contact.force += jumps.force / op.constants().a0;
}

double ReducedContact::mean_slip() const
{
    return system_.weights.dot(state_.contact.slip - rest_slip_);
}

double ReducedContact::crest() const
{
    return system_.modes.crest.dot(state_.q) + system_.modes.residual_crest.dot(state_.p);
}

} // namespace damslip::fe2d
