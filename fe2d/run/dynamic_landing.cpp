#include "fe2d/run/dynamic_contact.hpp"

#include <Eigen/Cholesky>

namespace damslip::fe2d {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Which of the 2m gaps a set of states holds as they are.
bool holds(const ContactStates& states, Index gap)
{
    const Index m = static_cast<Index>(states.size());
    const ContactState state = states[static_cast<std::size_t>(gap < m ? gap : gap - m)];
    return gap < m ? state != ContactState::open : state == ContactState::stick;
}

/// Velocity jumps of the gaps, -rate where held, by impulses on the held ones alone: V x, zero on the others.
void impulses(const MatrixXd& stiffness, const std::vector<Index>& held, const std::vector<Index>& loose,
              const VectorXd& rate, VectorXd& jump, VectorXd& impulse)
{
    jump = VectorXd::Zero(rate.size());
    for (const Index gap : held) jump[gap] = -rate[gap];
    if (!loose.empty()) {
        const VectorXd force = stiffness(loose, held) * jump(held);
        jump(loose) = -stiffness(loose, loose).llt().solve(force);
    }
    impulse = stiffness * jump;
    for (const Index gap : loose) impulse[gap] = 0.0;
}

} // namespace

/// The impulses go through the operator of the step, as its forces do; what kinetic energy they take counts as
/// numerical. Only where sticking and shutting are rigid: an elastic law brings gaps to rest by itself.
void DynamicContact::land(const ContactStates& before)
{
    if (options_.tangential_stiffness > 0.0 || options_.slip_tolerance > 0.0 ||
        options_.pressure_at_zero_clearance > 0.0)
        return;
    const Index m = structure_.pairs(), base = structure_.rock_nodes();
    std::vector<Index> held, loose;
    bool newly = false;
    for (Index gap = 0; gap < 2 * m; ++gap) {
        const bool now = holds(state_.contact.states, gap);
        (now ? held : loose).push_back(gap);
        newly |= now && !holds(before, gap);
    }
    if (!newly) return;
    ++counts_.landings;

    VectorXd rate = structure_.planes().gaps() * state_.v.tail(2 * structure_.interface());
    if (structure_.has_rock()) rate -= trace_ * state_.rock_v;
    rate.tail(m) = rate_t_;
    VectorXd jump, impulse, tilde;
    impulses(problems_[op_].solver->stiffness(), held, loose, rate, jump, impulse);
    DynamicOperator::Free free;
    free.dam = VectorXd::Zero(state_.v.size());
    free.interface = VectorXd::Zero(2 * structure_.interface());
    free.mean = VectorXd::Zero(structure_.planes().count());
    op_->finish(free, impulse, VectorXd::Zero(2 * m), jump, tilde);
    op_->factor().backward(free.dam);

    const VectorXd& change = free.dam;
    state_.v += change;
    VectorXd rock_change(2 * base);
    if (structure_.matching()) {
        const VectorXd rock = structure_.planes().gaps() * free.interface - jump;
        rock_change << rock.head(base), rock.segment(m, base);
    } else if (structure_.has_rock()) {
        rock_change = -op_->rock_share() * (structure_.rock_flexibility() * (trace_.transpose() * tilde));
    }
    state_.rock_v += rock_change;
    rate_t_ += jump.tail(m);
    for (const Index gap : held)
        if (gap >= m) rate_t_[gap - m] = 0.0;

    landed_.pending = true;
    landed_.dam = damping_.constants.mass * (structure_.mass() * change) +
                  damping_.constants.stiffness * (structure_.stiffness() * change);
    if (structure_.has_rock())
        landed_.rock = damping_.constants.stiffness * (structure_.rock_stiffness() * rock_change);
    if (slip_damping_.active()) {
        landed_.slip_rate = slip_damping_.weights.transpose() * jump.tail(m);
        landed_.mean_velocity = slip_damping_.momentum.transpose() * change;
    }
    const double kinetic = energy_.kinetic;
    multiply(op_->constants());
    energy_.kinetic = 0.5 * state_.v.dot(products_.mass_1);
    energy_.numerical += kinetic - energy_.kinetic;
    gather_forces(forces_);
}

} // namespace damslip::fe2d
