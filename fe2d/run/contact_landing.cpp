#include "fe2d/run/contact_landing.hpp"

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

ContactLanding::ContactLanding(const StepOperators& operators)
    : structure_(operators.structure()), slip_damping_(operators.slip_damping())
{
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
    free.interface = VectorXd::Zero(2 * structure_.interface());
    free.mean = VectorXd::Zero(structure_.planes().count());
    VectorXd tilde;
    op.finish(free, jumps.force, VectorXd::Zero(2 * structure_.pairs()), jumps.displacement, tilde);
    op.factor().backward(free.dam);
    VectorXd rock_change = rock.jump(of, op, free, jumps.displacement, tilde);
    return {std::move(free.dam), std::move(rock_change)};
}

std::optional<LandingForces> ContactLanding::land(const DynamicOperator& op, JointSolver& solver,
                                                  const ContactStates& before, const ContactLaw& law, StepRock& rock,
                                                  StepDam& dam, StepState& state) const
{
    ContactStates& states = state.contact.states;
    if (!solver.lands(before, states)) return std::nullopt;
    const bool shuts = solver.shuts(before, states);
    const Index m = structure_.pairs();
    ContactSolution jumps{states, {}, {}};
    const VectorXd rate = gap_values(state.v, state.rock_v, state.rate_t, rock);
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
    if (shuts && !structure_.water()) settle(op, solver, law, rock, dam, state, forces);
    return forces;
}

void ContactLanding::settle(const DynamicOperator& op, JointSolver& solver, const ContactLaw& law, StepRock& rock,
                            StepDam& dam, StepState& state, LandingForces& forces) const
{
    const StepConstants& c = op.constants();
    ContactSolution jumps{state.contact.states, {}, {}};
    if (!solver.hold(law, gap_values(state.a, state.rock_a, state.accel_t, rock), jumps)) return;
    const auto [change, rock_change] = change_by(StepRock::Jump::acceleration, jumps, op, rock);
    state.a += change;
    state.rock_a += rock_change;
    change_tangential(jumps, state.contact.states, state.accel_t);
    const VectorXd force = jumps.force / c.a0;
    state.contact.force += force;

    forces.dam += dam.change_acceleration(c, change) / (1.0 + c.scheme.alpha);
    forces.dam.tail(2 * structure_.interface()) -= structure_.planes().gaps().transpose() * force;
    if (structure_.has_rock()) forces.rock += rock.trace().transpose() * force;
}

} // namespace damslip::fe2d
