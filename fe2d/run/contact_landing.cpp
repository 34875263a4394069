#include "fe2d/run/contact_landing.hpp"
#include "fe2d/solver/dense_algebra.hpp"

#include <algorithm>
#include <cmath>

namespace damslip::fe2d {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

/// Rates of the tangential gaps, or accelerations: changed by the impulses, none where held.
void change_tangential(const ContactSolution& jumps, const ContactStates& states, VectorXd& values)
{
    const Index m = values.size();
    values += jumps.displacement.tail(m);
    for (Index i = 0; i < m; ++i)
        if (holds(states, m + i)) values[i] = 0.0;
}

} // namespace

ContactLanding::ContactLanding(const StepOperators& operators, double restitution)
    : structure_(operators.structure()), slip_damping_(operators.slip_damping()), restitution_(restitution)
{
}

std::optional<ContactLanding::Approach> ContactLanding::approach(const StepState& state, const StepRock& rock,
                                                                 double dt)
{
    const ContactStates& states = state.contact.states;
    if (!(restitution_ > 0.0) ||
        !std::all_of(states.begin(), states.end(), [](ContactState s) { return s == ContactState::open; }))
        return std::nullopt;
    const Index m = structure_.pairs();
    Approach approach{dt, {}, {}};
    gap_values(state.a, state.rock_a, state.accel_t, rock, values_);
    approach.accel = values_.head(m);
    gap_values(state.v, state.rock_v, state.rate_t, rock, approach.rate);
    for (Index i = 0; i < m; ++i) {
        const double rate = approach.rate[i];
        const double square = rate * rate - 2.0 * approach.accel[i] * std::max(0.0, state.contact.opening[i]);
        approach.rate[i] = square > 0.0 ? -std::sqrt(square) : std::min(rate, 0.0);
    }
    return approach;
}

/// What leaves the base again, and how fast; nothing where every pair that shut is slow.
std::optional<ContactLanding::Rebound> ContactLanding::rebound(const StepConstants& constants, JointSolver& solver,
                                                               const ContactLaw& law, const Approach& approach,
                                                               const ContactStates& states) const
{
    const Index m = structure_.pairs();
    std::vector<Index> fast;
    for (Index i = 0; i < m; ++i)
        if (states[static_cast<std::size_t>(i)] != ContactState::open &&
            approach.rate[i] < -2.0 * std::abs(approach.accel[i]) * approach.dt)
            fast.push_back(i);
    if (fast.empty()) return std::nullopt;

    // Impulses for one e; pairs that would be pulled stay open. What solves a step gives a0/(1 + α) of an impulse. @returns ΔE
    const double to_impulse = (1.0 + constants.scheme.alpha) / constants.a0;
    Rebound found;
    const auto with = [&](double e) {
        ContactSolution jumps{states, {}, {}};
        VectorXd values = approach.rate;
        for (const Index i : fast) values[i] *= 1.0 + e;
        for (Index k = 0; k <= m; ++k) {
            if (!solver.land(law, values, jumps)) return HUGE_VAL;
            Index worst = 0;
            if (jumps.force.head(m).minCoeff(&worst) >= -1e-9 * jumps.force.head(m).cwiseAbs().maxCoeff()) break;
            jumps.states[static_cast<std::size_t>(worst)] = ContactState::open;
        }
        found.states = jumps.states;
        found.target = VectorXd::Zero(m);
        for (const Index i : fast) found.target[i] = -e * approach.rate[i];
        return to_impulse * jumps.force.dot(approach.rate + 0.5 * jumps.displacement);
    };
    double gain = with(restitution_), low = 0.0, high = restitution_;
    for (int k = 0; gain > 0.0 && k < 40; ++k) {
        const double middle = 0.5 * (low + high);
        gain = with(middle);
        (gain > 0.0 ? high : low) = middle;
    }
    if (gain > 0.0) gain = with(low);
    if (gain > 0.0) return std::nullopt;
    found.loss = -gain;
    return found;
}

/// Contact forces go to zero, accelerations to those of the flight that begins.
void ContactLanding::release(const DynamicOperator& op, JointSolver& solver, StepRock& rock, StepDam& dam,
                             StepState& state)
{
    const StepConstants& c = op.constants();
    force_ = -state.contact.contact_force();
    jumps_ = {state.contact.states, solver.stiffness().llt().solve(c.a0 * force_), c.a0 * force_};
    change_accelerations(op, rock, dam, state);
}

/// Normal and tangential gaps of any motion of dam and rock; the tangential ones are kept by themselves.
void ContactLanding::gap_values(const VectorXd& dam, const VectorXd& rock_values, const VectorXd& tangential,
                                const StepRock& rock, VectorXd& gap)
{
    gap.noalias() = structure_.planes().gaps() * dam.tail(2 * structure_.interface());
    if (structure_.has_rock()) {
        on_gaps_.noalias() = rock.trace() * rock_values;
        gap -= on_gaps_;
    }
    gap.tail(tangential.size()) = tangential;
}

/// What forces on the pairs change of dam and rock, through the operator of the step, as its own forces do.
void ContactLanding::change_by(StepRock::Jump of, const DynamicOperator& op, StepRock& rock)
{
    free_.dam.setZero(structure_.dam_unknowns());
    free_.interface.setZero(op.interface_unknowns());
    free_.mean.setZero(structure_.planes().count());
    none_.setZero(2 * structure_.pairs());
    op.finish(free_, jumps_.force, none_, jumps_.displacement, tilde_);
    op.factor().backward(free_.dam);
    rock.jump(of, op, free_, jumps_.displacement, tilde_, rock_);
}

const LandingForces* ContactLanding::land(const DynamicOperator& op, JointSolver& solver, const ContactStates& before,
                                          const ContactLaw& law, StepRock& rock, StepDam& dam, StepState& state,
                                          const std::optional<Approach>& approach)
{
    ContactStates& states = state.contact.states;
    if (!solver.lands(before, states)) return nullptr;
    const bool shuts = solver.shuts(before, states);
    const Index m = structure_.pairs();
    jumps_.states = states;
    gap_values(state.v, state.rock_v, state.rate_t, rock, values_);
    std::optional<Rebound> rebounds;
    if (shuts && approach) rebounds = rebound(op.constants(), solver, law, *approach, states);
    if (rebounds) {
        jumps_.states = rebounds->states;
        values_.head(m) -= rebounds->target;
    }
    if (!(shuts ? solver.land(law, values_, jumps_) : solver.hold(law, values_, jumps_))) return nullptr;
    states = jumps_.states;
    change_by(StepRock::Jump::velocity, op, rock);
    state.v += free_.dam;
    state.rock_v += rock_;
    change_tangential(jumps_, states, state.rate_t);

    forces_.impact = 0.0;
    dam.change_velocity(op.constants(), free_.dam, forces_.dam);
    rock.damping_force(rock_, forces_.rock);
    if (slip_damping_.active()) {
        forces_.slip_rate.noalias() = slip_damping_.weights.transpose() * jumps_.displacement.tail(m);
        forces_.mean_velocity.noalias() = slip_damping_.momentum.transpose() * free_.dam;
    }
    if (rebounds) {
        forces_.impact = rebounds->loss;
        states.assign(states.size(), ContactState::open);
        release(op, solver, rock, dam, state);
    } else if (shuts && !structure_.water()) {
        settle(op, solver, law, rock, dam, state);
    }
    return &forces_;
}

void ContactLanding::settle(const DynamicOperator& op, JointSolver& solver, const ContactLaw& law, StepRock& rock,
                            StepDam& dam, StepState& state)
{
    jumps_.states = state.contact.states;
    gap_values(state.a, state.rock_a, state.accel_t, rock, values_);
    if (!solver.hold(law, values_, jumps_)) return;
    force_ = jumps_.force / op.constants().a0;
    change_accelerations(op, rock, dam, state);
}

/// By force_ on the pairs, and jumps_: accelerations that it gives the gaps, and a0 times it.
void ContactLanding::change_accelerations(const DynamicOperator& op, StepRock& rock, StepDam& dam, StepState& state)
{
    const StepConstants& c = op.constants();
    change_by(StepRock::Jump::acceleration, op, rock);
    state.a += free_.dam;
    state.rock_a += rock_;
    change_tangential(jumps_, state.contact.states, state.accel_t);
    state.contact.force += force_;

    forces_.dam += dam.change_acceleration(c, free_.dam) / (1.0 + c.scheme.alpha);
    on_gaps_.noalias() = structure_.planes().gaps().transpose() * force_;
    forces_.dam.tail(on_gaps_.size()) -= on_gaps_;
    if (!structure_.has_rock()) return;
    by_trace_.noalias() = rock.trace().transpose() * force_;
    forces_.rock += by_trace_;
}

} // namespace damslip::fe2d
