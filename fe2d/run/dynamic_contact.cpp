#include "fe2d/run/dynamic_contact.hpp"

#include "core/defect.hpp"
#include "core/stopwatch.hpp"

#include <cmath>

namespace damslip::fe2d {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

constexpr double update_share = 0.01; ///< slip after which P is made anew, of the smallest element [-]

} // namespace

void DynamicCounts::add(const ContactReport& report, double residual)
{
    ++steps;
    largest_iterations = std::max(largest_iterations, report.iterations);
    ++by_path[static_cast<int>(report.path)];
    unresolved += !report.resolved();
    largest_residual = std::max(largest_residual, residual);
}

LargestSlips::LargestSlips(const ContactPlanes& planes, VectorXd start)
    : planes_(planes), start_(std::move(start)), largest_(VectorXd::Zero(planes.count()))
{
}

void LargestSlips::look(const VectorXd& slip)
{
    const VectorXd since = slip - start_;
    for (Index k = 0; k < planes_.count(); ++k) largest_[k] = std::max(largest_[k], std::abs(planes_.mean(k, since)));
}

DynamicContact::DynamicContact(const ContactStructure& structure, const RunDamping& damping, const Scheme& scheme,
                               SplitLoad load, const StaticState& start, const ContactMemory& memory,
                               const ContactOptions& options)
    : DynamicContact(std::make_shared<StepOperators>(structure, damping, scheme), std::move(load), start, memory,
                     options)
{
}

DynamicContact::DynamicContact(std::shared_ptr<StepOperators> operators, SplitLoad load, const StaticState& start,
                               const ContactMemory& memory, const ContactOptions& options)
    : operators_(std::move(operators)), structure_(operators_->structure()), damping_(operators_->damping()),
      slip_damping_(operators_->slip_damping()), load_(std::move(load)), options_(options),
      trace_(structure_.trace(0.0)), // as the statics have it
      largest_slips_(structure_.planes(), memory.slip)
{
    const Index n = structure_.dam_unknowns(), m = structure_.pairs(), rock = 2 * structure_.rock_nodes();
    state_.u = start.dam;
    state_.v = state_.a = VectorXd::Zero(n);
    state_.rock = structure_.has_rock() ? start.rock : VectorXd();
    state_.rock_v = state_.rock_a = VectorXd::Zero(rock);
    state_.contact = memory;
    normal_force_ = memory.force.head(structure_.plane().pairs()).sum();
    rock_load_ = structure_.rock_load(load_, trace_);
    rock_rest_ = rock_force_ = load_jump_ = VectorXd::Zero(rock);
    if (structure_.slides_far()) {
        geometric_rest_ = VectorXd::Zero(m);
        geometric_rest_ = opening_at(base_slip()) - memory.opening;
    }
    if (structure_.has_rock()) {
        rock_rest_ = structure_.rock_flexibility() * rock_load_;
        rock_force_ = structure_.rock_stiffness() * state_.rock;
    }
    rate_t_ = accel_t_ = VectorXd::Zero(m);
    multiply(step_constants(operators_->scheme(), 1.0)); // at rest the step size does not matter
    start_ledger();
}

const DynamicOperator& DynamicContact::operator_of(double dt)
{
    const DynamicOperator& op = operators_->at(dt);
    problems_[&op];
    counts_.factorisations = static_cast<int>(problems_.size());
    return op;
}

const StepContact& DynamicContact::step_contact(const DynamicOperator& op, const PairProblem& problem) const
{
    return problem.place > 0 ? problem.own : op.contact();
}

DynamicContact::PairProblem& DynamicContact::problem_of(const DynamicOperator& op)
{
    PairProblem& problem = problems_[&op];
    if (problem.solver && problem.place == place_) return problem;
    problem.place = place_;
    if (place_ > 0) problem.own = op.contact_at(trace_);
    problem.solver =
        std::make_unique<JointSolver>(step_contact(op, problem).stiffness, structure_.planes().area(), options_);
    return problem;
}

bool DynamicContact::within_reach() const
{
    return !structure_.slides_far() || structure_.pairing().reaches(base_slip());
}

/// What displacements and place make the opening, less what statics leave out (the slip of the static stages).
VectorXd DynamicContact::opening_at(double slip) const
{
    const Index m = structure_.pairs(), base = structure_.plane().pairs();
    VectorXd gap = structure_.planes().gaps() * state_.u.tail(2 * structure_.interface());
    gap.head(base) -= structure_.pairing().weights(slip) * state_.rock.head(structure_.rock_nodes());
    return gap.head(m) - geometric_rest_;
}

/// The opening at the present slip, and P where it is too old.
void DynamicContact::follow_slip()
{
    const double slip = base_slip();
    state_.contact.opening = opening_at(slip);
    if (std::abs(slip - trace_slip_) > update_share * structure_.pairing().smallest_element())
        slide_to(slip, structure_.trace(slip));
}

/// All that passes from rock to dam at one instant: contact forces, and the slip damping that acts like them [N/m].
VectorXd DynamicContact::across(const Forces& f) const
{
    VectorXd force = f.contact;
    if (slip_damping_.active())
        force.tail(structure_.pairs()) -= slip_damping_.weights * (slip_damping_.drag * f.slip_rate - f.mean_velocity);
    return force;
}

/// Takes the contact to another place. What moves on the rock is no motion of it: the work ledger's forces of the two
/// last instants are kept as they were, and the jump of the present ones counts with the next step.
void DynamicContact::slide_to(double slip, const Pairing::Matrix& trace)
{
    const Pairing::Matrix change = trace - trace_;
    load_jump_ = change.transpose() * across(forces_);
    if (load_.joint.size() > 0) load_jump_ -= change.transpose() * load_.joint;
    forces_before_.rock -= change.transpose() * across(forces_before_);
    trace_ = trace;
    trace_slip_ = slip;
    ++place_;
    rock_load_ = structure_.rock_load(load_, trace_);
    rock_rest_ = structure_.rock_flexibility() * rock_load_;
    forces_.rock = rock_force_ - rock_load_;
}

/// K u, M v, M a, and K y for the next step.
void DynamicContact::multiply(const StepConstants& c)
{
    const double w = 1.0 + c.scheme.alpha, b = damping_.constants.stiffness;
    combined_ = (b * (c.scheme.alpha + w * c.a4)) * state_.v + (b * w * c.a5) * state_.a;
    structure_.clear_water(combined_);
    structure_.take_off_translations(state_.u, deformation_);
    operators_->products().multiply({deformation_, combined_, state_.v, state_.a}, products_);
    products_.dam_mass_1 = products_.mass_1;
    products_.dam_mass_2 = products_.mass_2;
    structure_.leave_dam_mass(products_.dam_mass_1, state_.v);
    structure_.leave_dam_mass(products_.dam_mass_2, state_.a);
}

/// What the moving ground does to the dam and its added mass. Relative to the ground, which accelerates by (-a_h, +a_v),
/// the load is -M r_x (-a_h) - M r_y a_v; the velocity that damping feels is (-v_h, +v_v), too.
VectorXd DynamicContact::ground_force(const GroundAcceleration& ground) const
{
    VectorXd force = ground.h * structure_.inertia_x() - ground.v * structure_.inertia_y();
    if (ground.drag_h != 0.0 || ground.drag_v != 0.0)
        force += ground.drag_h * structure_.dam_inertia_x() - ground.drag_v * structure_.dam_inertia_y();
    return force;
}

/// b_d on free_.dam, the rock's free gap and the known contact-like forces.
void DynamicContact::right_hand_side(const StepConstants& c, const GroundAcceleration& ground)
{
    const double alpha = c.scheme.alpha, w = 1.0 + alpha, cv = alpha + w * c.a4, ca = w * c.a5;
    const double a_m = damping_.constants.mass, b_k = damping_.constants.stiffness;
    free_.dam = load_.dam + w * ground_force(ground) - alpha * ground_force(state_.ground) - products_.stiffness_1 +
                products_.stiffness_2 + c.a2 * products_.mass_1 + c.a3 * products_.mass_2 +
                (a_m * cv) * products_.dam_mass_1 + (a_m * ca) * products_.dam_mass_2;
    if (structure_.gyrates()) free_.dam += structure_.gyration() * VectorXd(cv * state_.v + ca * state_.a);
    if (structure_.water()) {
        const auto weighted = [&](double GroundAcceleration::*part) {
            return w * ground.*part - alpha * state_.ground.*part;
        };
        free_.dam += weighted(&GroundAcceleration::displacement_v) * structure_.displacement_y() -
                     weighted(&GroundAcceleration::velocity_h) * structure_.velocity_x() +
                     weighted(&GroundAcceleration::velocity_v) * structure_.velocity_y();
    }
    known_ = (defect(Defect::lambda_unweighted) ? 0.0 : alpha) * state_.contact.force;
    if (defect(Defect::stiffness_damping_in_contact)) known_ -= b_k / c.dt * (forces_.contact - forces_before_.contact);
    if (slip_damping_.active()) {
        const VectorXd slip = slip_damping_.weights.transpose() * (cv * rate_t_ + ca * accel_t_);
        const VectorXd mean = slip_damping_.momentum.transpose() * (cv * state_.v + ca * state_.a);
        free_.dam.noalias() -= slip_damping_.momentum * slip;
        known_.tail(rate_t_.size()) -= slip_damping_.weights * (slip_damping_.drag * slip - mean);
    }
    if (structure_.has_rock())
        rock_gap_ = (rock_rest_ - state_.rock + (b_k * cv) * state_.rock_v + (b_k * ca) * state_.rock_a) /
                    (w * (1.0 + c.a1 * b_k));
}

void DynamicContact::begin(double dt, const GroundAcceleration& ground)
{
    op_ = &operator_of(dt);
    if (dt != last_dt_) {
        if (last_dt_ != 0.0) multiply(op_->constants());
        last_dt_ = dt;
    }
    if (structure_.slides_far()) follow_slip();
    right_hand_side(op_->constants(), ground);
}

ContactReport DynamicContact::solve_contact(const ContactLaw& law)
{
    PairProblem& problem = problem_of(*op_);
    const Index m = structure_.pairs();
    if (structure_.matching()) {
        const Index base = structure_.rock_nodes();
        VectorXd rock = VectorXd::Zero(2 * m);
        rock.head(base) = rock_gap_.head(base);
        rock.segment(m, base) = rock_gap_.tail(base);
        op_->solve_free(free_, rock);
    } else {
        op_->solve_free(free_, structure_.has_rock() ? VectorXd(trace_ * rock_gap_) : VectorXd());
    }
    op_->stuck_force(step_contact(*op_, problem), free_, known_, stuck_);
    const ContactMemory& memory = state_.contact;
    const Eigen::MatrixXd& stiffness = problem.solver->stiffness();
    for (Index i = 0; i < m; ++i) // Δg = x - (opening at the start, 0)
        if (memory.opening[i] != 0.0) stuck_ -= memory.opening[i] * stiffness.col(i);

    const Stopwatch before_contact;
    solution_.states = memory.states;
    solution_.force = memory.force;
    elastic_ = memory.elastic;
    const ContactReport report = problem.solver->solve(stuck_, law, elastic_, solution_);
    counts_.contact_seconds += before_contact.seconds();
    counts_.contact_iterations += report.iterations;
    return report;
}

/// The gaps' step and what the backward pass needs.
void DynamicContact::accept()
{
    const Index m = structure_.pairs();
    gap_ = solution_.displacement;
    gap_.head(m) -= state_.contact.opening;
    gap_.tail(m) += elastic_ - state_.contact.elastic;
    op_->finish(free_, solution_.force, known_, gap_, tilde_);
}

void DynamicContact::end(const GroundAcceleration& ground, const ContactReport& report, const ContactLaw& law)
{
    const StepConstants& c = op_->constants();
    const Index m = structure_.pairs(), base = structure_.rock_nodes();
    du_.swap(free_.dam);
    if (structure_.matching()) {
        const VectorXd rock = structure_.planes().gaps() * free_.interface - gap_;
        dr_.resize(2 * base);
        dr_ << rock.head(base), rock.segment(m, base);
    } else if (structure_.has_rock()) {
        dr_ = rock_gap_ - op_->rock_share() * (structure_.rock_flexibility() * (trace_.transpose() * tilde_));
    } else {
        dr_.resize(0);
    }

    const auto update = [&](const auto& step, auto& x, auto& velocity, auto& acceleration) {
        const VectorXd a1 = c.a0 * step - c.a2 * velocity - c.a3 * acceleration;
        velocity = c.a1 * step - c.a4 * velocity - c.a5 * acceleration;
        acceleration = a1;
        x += step;
    };
    update(du_, state_.u, state_.v, state_.a);
    update(dr_, state_.rock, state_.rock_v, state_.rock_a);
    VectorXd slip_total = VectorXd::Zero(m); // x itself is kept in the memory
    update(gap_.tail(m), slip_total, rate_t_, accel_t_);
    ContactMemory& memory = state_.contact;
    const VectorXd force_before = memory.force;
    const ContactStates states_before = memory.states;
    memory.force = solution_.force;
    memory.states = solution_.states;
    memory.opening = solution_.displacement.head(m);
    memory.slip += solution_.displacement.tail(m);
    memory.elastic = elastic_;
    state_.time += c.dt;
    state_.ground = ground;

    std::swap(before_, products_);
    multiply(c);
    add_energy(c, gap_, force_before);
    land(states_before, law);

    counts_.add(report, report.residual * stuck_.cwiseAbs().maxCoeff() / normal_force_);
    largest_slips_.look(memory.slip);
}

std::size_t DynamicContact::bytes() const
{
    std::size_t sum = operators_->products().bytes() + 16 * static_cast<std::size_t>(state_.u.size()) * sizeof(double);
    for (const auto& [op, problem] : problems_) sum += op->bytes();
    return sum;
}

} // namespace damslip::fe2d
