#include "fe2d/run/contact_landing.hpp"

#include <Eigen/Cholesky>

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
                                                                 double dt) const
{
    const ContactStates& states = state.contact.states;
    if (!(restitution_ > 0.0) ||
        !std::all_of(states.begin(), states.end(), [](ContactState s) { return s == ContactState::open; }))
        return std::nullopt;
    const Index m = structure_.pairs();
    Approach approach{dt, gap_values(state.v, state.rock_v, state.rate_t, rock),
                      gap_values(state.a, state.rock_a, state.accel_t, rock).head(m)};
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
                             StepState& state, LandingForces& forces) const
{
    const StepConstants& c = op.constants();
    const VectorXd force = -state.contact.contact_force();
    ContactSolution jumps{state.contact.states, solver.stiffness().llt().solve(c.a0 * force), c.a0 * force};
    change_accelerations(op, jumps, force, rock, dam, state, forces);
}

/// Normal and tangential gaps of any motion of dam and rock; the tangential ones are kept by themselves.
VectorXd ContactLanding::gap_values(const VectorXd& dam, const VectorXd& rock_values, const VectorXd& tangential,
                                    const StepRock& rock) const
{
    VectorXd gap = structure_.planes().gaps() * dam.tail(2 * structure_.interface());
    if (structure_.has_rock()) gap -= rock.trace() * rock_values;
    gap.tail(tangential.size()) = tangential;
    return gap;
}

/// What forces on the pairs change of dam and rock, through the operator of the step, as its own forces do.
ContactLanding::Change ContactLanding::change_by(StepRock::Jump of, const ContactSolution& jumps,
                                                 const DynamicOperator& op, StepRock& rock) const
{
    DynamicOperator::Free free;
    free.dam = VectorXd::Zero(structure_.dam_unknowns());
    free.interface = VectorXd::Zero(op.interface_unknowns());
    free.mean = VectorXd::Zero(structure_.planes().count());
    VectorXd tilde;
    op.finish(free, jumps.force, VectorXd::Zero(2 * structure_.pairs()), jumps.displacement, tilde);
    op.factor().backward(free.dam);
    VectorXd rock_change = rock.jump(of, op, free, jumps.displacement, tilde);
    return {std::move(free.dam), std::move(rock_change)};
}

std::optional<LandingForces> ContactLanding::land(const DynamicOperator& op, JointSolver& solver,
                                                  const ContactStates& before, const ContactLaw& law, StepRock& rock,
                                                  StepDam& dam, StepState& state,
                                                  const std::optional<Approach>& approach) const
{
    ContactStates& states = state.contact.states;
    if (!solver.lands(before, states)) return std::nullopt;
    const bool shuts = solver.shuts(before, states);
    const Index m = structure_.pairs();
    ContactSolution jumps{states, {}, {}};
    VectorXd rate = gap_values(state.v, state.rock_v, state.rate_t, rock);
    std::optional<Rebound> rebounds;
    if (shuts && approach) rebounds = rebound(op.constants(), solver, law, *approach, states);
    if (rebounds) {
        jumps.states = rebounds->states;
        rate.head(m) -= rebounds->target;
    }
    if (!(shuts ? solver.land(law, rate, jumps) : solver.hold(law, rate, jumps))) return std::nullopt;
    states = jumps.states;
    const auto [change, rock_change] = change_by(StepRock::Jump::velocity, jumps, op, rock);
    state.v += change;
    state.rock_v += rock_change;
    change_tangential(jumps, states, state.rate_t);

    LandingForces forces;
    forces.dam = dam.change_velocity(op.constants(), change);
    forces.rock = rock.damping_force(rock_change);
    if (slip_damping_.active()) {
        forces.slip_rate = slip_damping_.weights.transpose() * jumps.displacement.tail(m);
        forces.mean_velocity = slip_damping_.momentum.transpose() * change;
    }
    if (rebounds) {
        forces.impact = rebounds->loss;
        states.assign(states.size(), ContactState::open);
        release(op, solver, rock, dam, state, forces);
    } else if (shuts && !structure_.water()) {
        settle(op, solver, law, rock, dam, state, forces);
    }
    return forces;
}

void ContactLanding::settle(const DynamicOperator& op, JointSolver& solver, const ContactLaw& law, StepRock& rock,
                            StepDam& dam, StepState& state, LandingForces& forces) const
{
    const StepConstants& c = op.constants();
    ContactSolution jumps{state.contact.states, {}, {}};
    if (!solver.hold(law, gap_values(state.a, state.rock_a, state.accel_t, rock), jumps)) return;
    change_accelerations(op, jumps, jumps.force / c.a0, rock, dam, state, forces);
}

/// @param force  on the pairs [N/m], @param jumps  accelerations that it gives the gaps, and a0 times it
void ContactLanding::change_accelerations(const DynamicOperator& op, const ContactSolution& jumps,
                                          const VectorXd& force, StepRock& rock, StepDam& dam, StepState& state,
                                          LandingForces& forces) const
{
    const StepConstants& c = op.constants();
    const auto [change, rock_change] = change_by(StepRock::Jump::acceleration, jumps, op, rock);
    state.a += change;
    state.rock_a += rock_change;
    change_tangential(jumps, state.contact.states, state.accel_t);
    state.contact.force += force;

    forces.dam += dam.change_acceleration(c, change) / (1.0 + c.scheme.alpha);
    forces.dam.tail(2 * structure_.interface()) -= structure_.planes().gaps().transpose() * force;
    if (structure_.has_rock()) forces.rock += rock.trace().transpose() * force;
}

} // namespace damslip::fe2d
