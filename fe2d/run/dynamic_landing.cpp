#include "fe2d/run/dynamic_contact.hpp"

namespace damslip::fe2d {

using Eigen::Index;
using Eigen::VectorXd;

/// The impulses go through the operator of the step, as its forces do; what kinetic energy they take counts as
/// numerical.
void DynamicContact::land(const ContactStates& before, const ContactLaw& law)
{
    JointSolver& solver = *problems_[op_].solver;
    const ContactStates& states = state_.contact.states;
    if (!solver.lands(before, states)) return;
    const Index m = structure_.pairs(), base = structure_.rock_nodes();
    VectorXd rate = structure_.planes().gaps() * state_.v.tail(2 * structure_.interface());
    if (structure_.has_rock()) rate -= trace_ * state_.rock_v;
    rate.tail(m) = rate_t_;
    ContactSolution jumps{states, {}, {}};
    if (!solver.land(law, rate, jumps)) return;
    ++counts_.landings;
    const VectorXd& jump = jumps.displacement;
    DynamicOperator::Free free;
    free.dam = VectorXd::Zero(state_.v.size());
    free.interface = VectorXd::Zero(2 * structure_.interface());
    free.mean = VectorXd::Zero(structure_.planes().count());
    VectorXd tilde;
    op_->finish(free, jumps.force, VectorXd::Zero(2 * m), jump, tilde);
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
    for (Index i = 0; i < m; ++i)
        if (holds(states, m + i)) rate_t_[i] = 0.0;

    landed_.pending = true;
    VectorXd stiffness_change, mass_change;
    operators_->products().multiply(change, stiffness_change, mass_change);
    structure_.clear_water(stiffness_change); // damping is the dam's
    VectorXd dam_mass_change = mass_change;
    structure_.leave_dam_mass(dam_mass_change, change);
    landed_.dam = damping_.constants.mass * dam_mass_change + damping_.constants.stiffness * stiffness_change;
    if (structure_.water()) {
        landed_.dam += structure_.gyration() * change;
        structure_.clear_water(landed_.dam);
    }
    if (structure_.has_rock())
        landed_.rock = damping_.constants.stiffness * (structure_.rock_stiffness() * rock_change);
    if (slip_damping_.active()) {
        landed_.slip_rate = slip_damping_.weights.transpose() * jump.tail(m);
        landed_.mean_velocity = slip_damping_.momentum.transpose() * change;
    }
    const double before_landing = energy_.kinetic + energy_.strain;
    const StepConstants& c = op_->constants();
    products_.mass_1 += mass_change;
    products_.dam_mass_1 += dam_mass_change;
    products_.stiffness_2 +=
        damping_.constants.stiffness * (c.scheme.alpha + (1.0 + c.scheme.alpha) * c.a4) * stiffness_change;
    VectorXd velocity = state_.v;
    structure_.clear_water(velocity);
    energy_.kinetic = 0.5 * velocity.dot(products_.mass_1);
    if (structure_.water()) {
        const WaterLedger::Instant now = water_instant();
        water_.jolt = now.force - water_.force;
        energy_.strain += water_ledger_->compression(now) - water_ledger_->compression(water_);
        energy_.kinetic += water_ledger_->flow(now);
        const VectorXd jolt = std::move(water_.jolt);
        water_ = now;
        water_.jolt = jolt;
    }
    energy_.numerical += before_landing - energy_.kinetic - energy_.strain;
    gather_forces(forces_);
}

} // namespace damslip::fe2d
