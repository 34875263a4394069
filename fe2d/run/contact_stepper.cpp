#include "fe2d/run/contact_stepper.hpp"

#include "core/parallel.hpp"
#include "fe2d/run/step_passes.hpp"
#include "fe2d/solver/dense_product.hpp"

#include <cmath>

namespace damslip::fe2d {

using Eigen::Index;
using Eigen::VectorXd;

ContactStepper::ContactStepper(StepOperators& operators, const Contact& joint, const ContactOptions& options)
    : operators_(operators), structure_(operators.structure()), slip_damping_(operators.slip_damping()), joint_(joint),
      options_(options)
{
}

const DynamicOperator& ContactStepper::take(double dt)
{
    op_ = &operators_.at(dt);
    problems_[op_];
    return *op_;
}

const StepContact& ContactStepper::contact_at(const StepRock& rock)
{
    PairProblem& problem = problems_[op_];
    const bool own = rock.place() > 0;
    if (!problem.solver || problem.place != rock.place()) {
        problem.place = rock.place();
        if (own) problem.own = op_->contact_at(rock.trace());
        problem.solver = std::make_unique<JointSolver>((own ? problem.own : op_->contact()).stiffness,
                                                       structure_.planes().area(), joint_, options_);
        problem.with_laws.reset();
    }
    return own ? problem.own : op_->contact();
}

/// b_d, the rock's free motion and the known contact-like forces.
void ContactStepper::begin(const StepState& state, const GroundAcceleration& ground, StepDam& dam, StepRock& rock)
{
    const StepConstants& c = op_->constants();
    const double alpha = c.scheme.alpha, w = 1.0 + alpha, cv = alpha + w * c.a4, ca = w * c.a5;
    dam.right_hand_side(c, state, ground, free_.dam);
    known_ = alpha * state.contact.force;
    if (slip_damping_.active()) {
        on_pairs_ = cv * state.rate_t + ca * state.accel_t;
        slip_.noalias() = slip_damping_.weights.transpose() * on_pairs_;
        motion_ = cv * state.v + ca * state.a;
        mean_.noalias() = slip_damping_.momentum.transpose() * motion_;
        free_.dam.noalias() -= slip_damping_.momentum * slip_;
        drag_.noalias() = slip_damping_.drag * slip_;
        drag_ -= mean_;
        on_pairs_.noalias() = slip_damping_.weights * drag_;
        known_.tail(state.rate_t.size()) -= on_pairs_;
    }
    rock.begin_step(*op_, state);
    rock.load_water(*op_, free_.dam);
}

ContactReport ContactStepper::solve(const ContactLaw& law, const StepState& state, StepRock& rock,
                                    DynamicCounts& counts)
{
    const StepContact& contact = contact_at(rock);
    JointSolver& solver = *problems_[op_].solver;
    op_->solve_free(free_, rock.free_gap());
    op_->stuck_force(contact, free_, known_, stuck_);
    const ContactMemory& memory = state.contact;
    subtract_columns(solver.stiffness(), memory.opening, stuck_); // Δg = x - (opening at the start, 0)

    const Stopwatch before_contact;
    solution_.states = memory.states;
    solution_.force = memory.force;
    elastic_ = memory.elastic;
    const ContactReport report =
        memory.laws.active() ? solve_laws(law, state) : solver.solve(stuck_, law, elastic_, solution_);
    counts.contact_seconds += before_contact.seconds();
    counts.contact_iterations += report.iterations;
    return report;
}

/// The same with laws beside hard contact and friction.
ContactReport ContactStepper::solve_laws(const ContactLaw& law, const StepState& state)
{
    PairProblem& problem = problems_[op_];
    const ContactMemory& memory = state.contact;
    if (!problem.with_laws) problem.with_laws = law_solver(problem.solver->shared_stiffness(), memory.laws, options_);
    const StepConstants& c = op_->constants();
    laws_ = memory.laws;
    JointStart start{c.dt,          memory.opening, memory.slip,
                     memory.states, c.a1,           -c.a4 * state.rate_t - c.a5 * state.accel_t};
    return laws_.solve(*problem.with_laws, stuck_, start, law, solution_);
}

/// The gaps' step and what the backward pass needs.
void ContactStepper::accept(const StepState& state)
{
    const Index m = structure_.pairs();
    VectorXd& gap = change_.gap;
    gap = solution_.displacement;
    gap.head(m) -= state.contact.opening;
    gap.tail(m) += elastic_ - state.contact.elastic;
    op_->finish(free_, solution_.force, known_, gap, tilde_);
}

const StepChange& ContactStepper::end(const GroundAcceleration& ground, StepRock& rock, StepState& state)
{
    const StepConstants& c = op_->constants();
    const Index m = structure_.pairs();
    change_.dam.swap(free_.dam);
    rock.step(*op_, free_, change_.gap, tilde_, change_.rock);

    move_on(c, change_.dam, state.u, state.v, state.a);
    move_on(c, change_.rock, state.rock, state.rock_v, state.rock_a);
    for (Index i = 0; i < m; ++i) {
        const double step = change_.gap[m + i], v = state.rate_t[i], a = state.accel_t[i];
        state.rate_t[i] = c.a1 * step - c.a4 * v - c.a5 * a;
        state.accel_t[i] = c.a0 * step - c.a2 * v - c.a3 * a;
    }
    ContactMemory& memory = state.contact;
    state.force_before = memory.force;
    if (laws_.active()) state.law_force_before = memory.laws.force();
    memory.force = solution_.force;
    memory.states = solution_.states;
    memory.opening = solution_.displacement.head(m);
    memory.slip += solution_.displacement.tail(m);
    memory.elastic = elastic_;
    if (laws_.active()) {
        laws_.end();
        std::swap(memory.laws, laws_);
    }
    state.time += c.dt;
    state.ground = ground;
    return change_;
}

/// Local error of the slips' area means, the largest of all planes [m]: (1/6 - β) Δt² (s̈₁ - s̈₀), what Newmark's formula
/// leaves of a linear acceleration (Zienkiewicz & Xie 1991), over the pairs that are not held all the step. It sees a
/// slide that begins or ends within the step once its contact is solved.
double ContactStepper::slip_error(const StepState& state)
{
    const StepConstants& c = op_->constants();
    const Index m = structure_.pairs();
    const ContactMemory& memory = state.contact;
    VectorXd& change = on_pairs_;
    change.setZero(m);
    for (Index i = 0; i < m; ++i) {
        if (holds(memory.states, m + i) && holds(solution_.states, m + i)) continue;
        const double step = solution_.displacement[m + i] + elastic_[i] - memory.elastic[i];
        change[i] = c.a0 * step - c.a2 * state.rate_t[i] - (c.a3 + 1.0) * state.accel_t[i];
    }
    mean_.noalias() = structure_.planes().weights().transpose() * change;
    return std::abs(1.0 / 6.0 - c.scheme.beta) * c.dt * c.dt * mean_.cwiseAbs().maxCoeff();
}

/// The same of the dam's displacements, root mean square over its mass [m].
double ContactStepper::dam_error(const StepState& state) const
{
    const StepConstants& c = op_->constants();
    const VectorXd &mass_x = structure_.dam_inertia_x(), &mass_y = structure_.dam_inertia_y();
    double sum = 0.0;
    for (Index i = 0; i < mass_x.size(); ++i) {
        const double change = c.a0 * free_.dam[i] - c.a2 * state.v[i] - (c.a3 + 1.0) * state.a[i];
        sum += (mass_x[i] + mass_y[i]) * change * change;
    }
    return std::abs(1.0 / 6.0 - c.scheme.beta) * c.dt * c.dt * std::sqrt(sum / mass_x.sum());
}

std::size_t ContactStepper::bytes() const
{
    std::size_t sum = 0;
    for (const auto& [op, problem] : problems_) sum += op->bytes();
    return sum;
}

} // namespace damslip::fe2d
