#include "fe2d/run/dynamic_contact.hpp"

namespace damslip::fe2d {

using Eigen::Index;
using Eigen::VectorXd;

/// Normal and tangential gaps of any motion of dam and rock; the tangential ones are kept by themselves.
VectorXd DynamicContact::gap_values(const VectorXd& dam, const VectorXd& rock, const VectorXd& tangential) const
{
    VectorXd gap = structure_.planes().gaps() * dam.tail(2 * structure_.interface());
    if (structure_.has_rock()) gap -= trace_ * rock;
    gap.tail(tangential.size()) = tangential;
    return gap;
}

/// What forces on the pairs change of dam and rock, through the operator of the step, as its own forces do.
DynamicContact::Change DynamicContact::change_by(const ContactSolution& jumps) const
{
    const Index m = structure_.pairs(), base = structure_.rock_nodes();
    DynamicOperator::Free free;
    free.dam = VectorXd::Zero(state_.v.size());
    free.interface = VectorXd::Zero(2 * structure_.interface());
    free.mean = VectorXd::Zero(structure_.planes().count());
    VectorXd tilde;
    op_->finish(free, jumps.force, VectorXd::Zero(2 * m), jumps.displacement, tilde);
    op_->factor().backward(free.dam);
    Change change{std::move(free.dam), VectorXd(2 * base)};
    if (structure_.matching()) {
        const VectorXd rock = structure_.planes().gaps() * free.interface - jumps.displacement;
        change.rock << rock.head(base), rock.segment(m, base);
    } else if (structure_.has_rock()) {
        change.rock = -op_->rock_share() * (structure_.rock_flexibility() * (trace_.transpose() * tilde));
    }
    return change;
}

/// Velocities of held gaps become zero by impulses; what kinetic energy they take counts as numerical. After a flight
/// accelerations follow.
void DynamicContact::land(const ContactStates& before, const ContactLaw& law)
{
    JointSolver& solver = *problems_[op_].solver;
    ContactStates& states = state_.contact.states;
    if (!solver.lands(before, states)) return;
    const bool shuts = solver.shuts(before, states);
    const Index m = structure_.pairs();
    ContactSolution jumps{states, {}, {}};
    const VectorXd rate = gap_values(state_.v, state_.rock_v, rate_t_);
    if (!(shuts ? solver.land(law, rate, jumps) : solver.hold(law, rate, jumps))) return;
    states = jumps.states;
    ++counts_.landings;
    const VectorXd& jump = jumps.displacement;
    const auto [change, rock_change] = change_by(jumps);
    state_.v += change;
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
    if (structure_.gyrates()) landed_.dam += structure_.gyration() * change;
    structure_.clear_water(landed_.dam);
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
    if (shuts && !structure_.water()) settle(solver, law);
    gather_forces(forces_);
}

/// A gap v Δt wide that shuts within a step leaves its end with an acceleration of up to v/(β Δt) away from the plane,
/// and a force as large: the next steps would throw the body back, and friction would have met the force, not the
/// impulse m v. Held gaps stand still: their accelerations become zero, forces on the pairs with them, M δa = w Bᵀδλ.
/// Through the step's operator that holds but for (w/a0)(a1 C + K) δa, which the ledger of the next step knows.
void DynamicContact::settle(JointSolver& solver, const ContactLaw& law)
{
    const StepConstants& c = op_->constants();
    const Index m = structure_.pairs();
    const double w = 1.0 + c.scheme.alpha;
    ContactSolution jumps{state_.contact.states, {}, {}};
    if (!solver.hold(law, gap_values(state_.a, state_.rock_a, accel_t_), jumps)) return;
    const auto [change, rock_change] = change_by(jumps);
    state_.a += change;
    state_.rock_a += rock_change;
    accel_t_ += jumps.displacement.tail(m);
    for (Index i = 0; i < m; ++i)
        if (holds(state_.contact.states, m + i)) accel_t_[i] = 0.0;
    const VectorXd force = jumps.force / c.a0;
    state_.contact.force += force;

    VectorXd stiffness_change, mass_change;
    operators_->products().multiply(change, stiffness_change, mass_change);
    products_.mass_2 += mass_change;
    products_.stiffness_2 += damping_.constants.stiffness * w * c.a5 * stiffness_change;
    landed_.dam += mass_change / w;
    landed_.dam.tail(2 * structure_.interface()) -= structure_.planes().gaps().transpose() * force;
    structure_.leave_dam_mass(mass_change, change);
    products_.dam_mass_2 += mass_change;
    if (structure_.has_rock()) landed_.rock += trace_.transpose() * force;
}

} // namespace damslip::fe2d
