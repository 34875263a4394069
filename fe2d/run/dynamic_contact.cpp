#include "fe2d/run/dynamic_contact.hpp"

#include <chrono>
#include <cmath>

namespace damslip::fe2d {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start)
{
    return std::chrono::duration<double>(Clock::now() - start).count();
}

} // namespace

DynamicContact::DynamicContact(const ContactStructure& structure, RunDamping damping, const Scheme& scheme,
                               SplitLoad load, const StaticState& start, const ContactMemory& memory,
                               const ContactOptions& options)
    : structure_(structure), damping_(damping), scheme_(scheme), load_(std::move(load)), options_(options),
      slip_damping_(structure, damping), block_products_(structure.stiffness(), structure.mass())
{
    const Index n = structure.dam_unknowns(), m = structure.plane().pairs();
    state_.u = start.dam;
    state_.v = state_.a = VectorXd::Zero(n);
    const Index rock = 2 * structure.rock_nodes();
    state_.rock = structure.has_rock() ? start.rock : VectorXd::Zero(rock);
    state_.rock_v = state_.rock_a = VectorXd::Zero(rock);
    state_.contact = memory;
    normal_force_ = memory.force.head(m).sum();
    rock_load_ = load_.rock;
    rock_rest_ = rock_force_ = load_jump_ = VectorXd::Zero(rock);
    if (structure.slides_far()) {
        trace_ = structure.pairing().trace(trace_slip_); // as the statics have it
        rock_load_ = structure.rock_load(load_, trace_);
        geometric_rest_ = VectorXd::Zero(m);
        geometric_rest_ = opening_at(structure.plane().weights().dot(memory.slip)) - memory.opening;
    }
    if (structure.has_rock()) {
        rock_rest_ = structure.rock_flexibility() * rock_load_;
        rock_force_ = structure.rock_stiffness() * state_.rock;
    }
    rate_t_ = accel_t_ = VectorXd::Zero(m);
    multiply(step_constants(scheme, 1.0)); // at rest the step size does not matter
    stored_ = stored_energy(options_, structure.plane().area, memory.opening);
    energy_.strain = 0.5 * (deformation_.dot(products_.stiffness_1) + state_.rock.dot(rock_force_)) + stored_;
    energy_start_ = energy_;
    energy_scale_ = 0.0;
    gather_forces(forces_);
    forces_before_ = forces_before2_ = forces_;
}

DynamicOperator& DynamicContact::operator_of(double dt)
{
    auto& slot = operators_[dt];
    if (!slot) {
        slot = std::make_unique<DynamicOperator>(structure_, damping_, slip_damping_, step_constants(scheme_, dt),
                                                 options_);
        ++counts_.factorisations;
    }
    return *slot;
}

namespace {

constexpr double update_share = 0.01; ///< slip after which P is made anew, of the smallest element [-]

}

bool DynamicContact::within_reach() const
{
    return !structure_.slides_far() ||
           structure_.pairing().reaches(structure_.plane().weights().dot(state_.contact.slip));
}

/// What displacements and place make the opening, less what statics leave out (the slip of the static stages).
VectorXd DynamicContact::opening_at(double slip) const
{
    const Index m = structure_.plane().pairs();
    const VectorXd dam = structure_.plane().to_plane(VectorXd(state_.u.tail(2 * m)));
    const VectorXd rock = structure_.pairing().weights(slip) * state_.rock.head(structure_.rock_nodes());
    return dam.head(m) - rock - geometric_rest_;
}

/// The opening at the present slip, and P where it is too old.
void DynamicContact::follow_slip(DynamicOperator& op)
{
    const double slip = structure_.plane().weights().dot(state_.contact.slip);
    state_.contact.opening = opening_at(slip);
    if (std::abs(slip - trace_slip_) > update_share * structure_.pairing().smallest_element())
        slide_to(slip, structure_.pairing().trace(slip));
    if (slid_operators_.insert(&op).second) op.slide_to(trace_);
}

/// Takes the contact to another place. What moves on the rock is no motion of it: the work ledger's forces of the two
/// last instants are kept as they were, and the jump of the present ones counts with the next step.
void DynamicContact::slide_to(double slip, const Pairing::Matrix& trace)
{
    const Pairing::Matrix change = trace - trace_;
    load_jump_ = change.transpose() * state_.contact.force;
    if (load_.joint.size() > 0) load_jump_ -= change.transpose() * load_.joint;
    forces_before_.rock -= change.transpose() * forces_before_.contact;
    trace_ = trace;
    trace_slip_ = slip;
    rock_load_ = structure_.rock_load(load_, trace_);
    rock_rest_ = structure_.rock_flexibility() * rock_load_;
    forces_.rock = rock_force_ - rock_load_;
    slid_operators_.clear();
}

/// K u, M v, M a, and K y for the next step.
void DynamicContact::multiply(const StepConstants& c)
{
    const double w = 1.0 + c.scheme.alpha, b = damping_.constants.stiffness;
    combined_ = (b * (c.scheme.alpha + w * c.a4)) * state_.v + (b * w * c.a5) * state_.a;
    // Elastic forces do not feel a translation; taken off, metres of slip cost no digits of them.
    const Index first = structure_.inner_unknowns();
    const Eigen::Vector2d shift = state_.u.segment<2>(first);
    deformation_.resize(state_.u.size());
    for (Index k = 0; k < deformation_.size(); k += 2) deformation_.segment<2>(k) = state_.u.segment<2>(k) - shift;
    block_products_.multiply({deformation_, combined_, state_.v, state_.a}, products_);
}

/// b_d on free_.dam, the rock's free gap and the known contact-like forces.
void DynamicContact::right_hand_side(const StepConstants& c, const GroundAcceleration& ground)
{
    const double alpha = c.scheme.alpha, w = 1.0 + alpha, cv = alpha + w * c.a4, ca = w * c.a5;
    const double a_m = damping_.constants.mass, b_k = damping_.constants.stiffness;
    const double h = w * ground.h - alpha * state_.ground.h, v = w * ground.v - alpha * state_.ground.v;
    // Relative to the ground, which accelerates by (-a_h, +a_v), the load is -M r_x (-a_h) - M r_y a_v.
    free_.dam = load_.dam + h * structure_.inertia_x() - v * structure_.inertia_y() - products_.stiffness_1 +
                products_.stiffness_2 + (c.a2 + a_m * cv) * products_.mass_1 + (c.a3 + a_m * ca) * products_.mass_2;
    known_ = alpha * state_.contact.force;
    if (slip_damping_.active()) {
        const double slip = slip_damping_.weights.dot(cv * rate_t_ + ca * accel_t_);
        const double mean = cv * slip_damping_.momentum.dot(state_.v) + ca * slip_damping_.momentum.dot(state_.a);
        free_.dam -= (slip_damping_.coefficient * slip) * slip_damping_.momentum;
        known_.tail(rate_t_.size()) -= (slip_damping_.coefficient * (slip - mean)) * slip_damping_.weights;
    }
    if (structure_.has_rock())
        rock_gap_ = (rock_rest_ - state_.rock + (b_k * cv) * state_.rock_v + (b_k * ca) * state_.rock_a) /
                    (w * (1.0 + c.a1 * b_k));
    else
        rock_gap_.setZero(state_.rock.size());
}

ContactReport DynamicContact::advance(double dt, const GroundAcceleration& ground, const ContactLaw& law)
{
    DynamicOperator& op = operator_of(dt);
    const StepConstants& c = op.constants();
    const Index m = structure_.plane().pairs();
    if (dt != last_dt_) {
        if (last_dt_ != 0.0) multiply(c);
        last_dt_ = dt;
    }
    if (structure_.slides_far()) follow_slip(op);
    right_hand_side(c, ground);
    op.solve_free(free_, structure_.slides_far() ? VectorXd(trace_ * rock_gap_) : rock_gap_);
    op.stuck_force(free_, known_, stuck_);
    ContactMemory& memory = state_.contact;
    const Eigen::MatrixXd& stiffness = op.contact().stiffness();
    for (Index i = 0; i < m; ++i) // Δg = x - (opening at the start, 0)
        if (memory.opening[i] != 0.0) stuck_ -= memory.opening[i] * stiffness.col(i);

    const auto before_contact = Clock::now();
    solution_.states = memory.states;
    solution_.force = memory.force;
    elastic_ = memory.elastic;
    const ContactReport report = op.contact().solve(stuck_, law, memory.elastic, solution_);
    counts_.contact_seconds += seconds_since(before_contact);

    gap_ = solution_.displacement;
    gap_.head(m) -= memory.opening;
    gap_.tail(m) += memory.elastic - elastic_;
    const VectorXd& tilde = op.finish(free_, solution_.force, known_, gap_, dam_interface_);
    du_.swap(free_.dam);
    if (structure_.slides_far())
        dr_ = rock_gap_ - op.rock_share() * (structure_.rock_flexibility() * (trace_.transpose() * tilde));
    else if (structure_.has_rock())
        dr_ = dam_interface_ - gap_;
    else
        dr_.setZero(state_.rock.size());

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
    const VectorXd force_before = memory.force;
    memory.force = solution_.force;
    memory.states = solution_.states;
    memory.opening = solution_.displacement.head(m);
    memory.slip += solution_.displacement.tail(m);
    state_.time += dt;
    ground_before_ = state_.ground;
    state_.ground = ground;

    std::swap(before_, products_);
    multiply(c);
    add_energy(c, gap_, force_before);

    ++counts_.steps;
    counts_.contact_iterations += report.iterations;
    counts_.largest_iterations = std::max(counts_.largest_iterations, report.iterations);
    ++counts_.by_path[static_cast<int>(report.path)];
    counts_.unresolved += !report.resolved();
    counts_.largest_residual =
        std::max(counts_.largest_residual, report.residual * stuck_.cwiseAbs().maxCoeff() / normal_force_);
    return report;
}

void DynamicContact::gather_forces(Forces& f) const
{
    const double h = state_.ground.h, v = state_.ground.v;
    f.dam = damping_.constants.mass * products_.mass_1 + products_.stiffness_1 - load_.dam -
            h * structure_.inertia_x() + v * structure_.inertia_y();
    f.v = state_.v;
    f.a = state_.a;
    f.rock = rock_force_ - rock_load_;
    f.rock_v = state_.rock_v;
    f.contact = state_.contact.force;
    if (!slip_damping_.active()) return;
    f.slip_rate = slip_damping_.weights.dot(rate_t_);
    f.mean_velocity = slip_damping_.momentum.dot(state_.v);
}

/// The ledger of EnergyLedger with its products arranged for the split system. K Δu, M Δa, ... are differences of
/// products of the states; vᵀKΔu stands for ΔuᵀKv.
void DynamicContact::add_energy(const StepConstants& c, const VectorXd& gap_step, const VectorXd& force_before)
{
    const double alpha = c.scheme.alpha, gamma = c.scheme.gamma, beta = c.scheme.beta, dt = c.dt;
    const double a_m = damping_.constants.mass, b_k = damping_.constants.stiffness;
    const Index m = structure_.plane().pairs();
    const VectorXd& v1 = state_.v;
    rock_force_before_ = rock_force_;
    if (structure_.has_rock()) rock_force_.noalias() = structure_.rock_stiffness() * state_.rock;
    const VectorXd k_du = products_.stiffness_1 - before_.stiffness_1, k_dr = rock_force_ - rock_force_before_;

    std::swap(forces_before2_, forces_before_);
    std::swap(forces_before_, forces_);
    gather_forces(forces_);
    const VectorXd& v0 = forces_before_.v;

    const double slip = slip_damping_.active() ? slip_damping_.weights.dot(gap_step.tail(m)) : 0.0;
    const double mean = slip_damping_.active() ? slip_damping_.momentum.dot(du_) : 0.0;
    const double s_rate = 0.5 * (forces_.slip_rate + forces_before_.slip_rate);
    const double m_rate = 0.5 * (forces_.mean_velocity + forces_before_.mean_velocity);

    // Over the gap step alone: the opening also changes where the dam has slid to another place on bent rock.
    const VectorXd& area = structure_.plane().area;
    const VectorXd& opening = state_.contact.opening;
    const double stored =
        stored_energy(options_, area, opening) - stored_energy(options_, area, opening - gap_step.head(m));
    stored_ += stored;

    Energy& e = energy_;
    e.kinetic = 0.5 * v1.dot(products_.mass_1);
    e.strain = 0.5 * (deformation_.dot(products_.stiffness_1) + state_.rock.dot(rock_force_)) + stored_;
    e.damping += 0.5 * a_m * du_.dot(products_.mass_1 + before_.mass_1) + 0.5 * b_k * k_du.dot(v1 + v0) +
                 0.5 * b_k * k_dr.dot(forces_.rock_v + forces_before_.rock_v) +
                 slip_damping_.coefficient * (slip * (s_rate - m_rate) - mean * s_rate);
    e.external += du_.dot(load_.dam) + dr_.dot(rock_load_) +
                  0.5 * (state_.ground.h + ground_before_.h) * du_.dot(structure_.inertia_x()) -
                  0.5 * (state_.ground.v + ground_before_.v) * du_.dot(structure_.inertia_y());
    const VectorXd force = 0.5 * (force_before + state_.contact.force);
    e.contact_normal += force.head(m).dot(gap_step.head(m)) + stored; // of soft contact, what is not in `strain`
    if (structure_.slides_far()) {
        e.contact_normal += 0.5 * (1.0 + alpha) * dr_.dot(load_jump_);
        load_jump_.setZero();
    }
    e.friction -= force.tail(m).dot(gap_step.tail(m));

    const double du_m_da = du_.dot(products_.mass_2 - before_.mass_2);
    const double da_m_da = (state_.a - forces_before_.a).dot(products_.mass_2 - before_.mass_2);
    const double half_change = 0.5 * (state_.a.dot(products_.mass_2) - forces_before_.a.dot(before_.mass_2));
    const double half_beta = beta - 0.5 * gamma;
    double numerical =
        -(gamma - 0.5) * du_m_da + (gamma - 0.5) * half_beta * dt * dt * da_m_da + half_beta * dt * dt * half_change;
    if (alpha != 0.0) {
        const auto work = [&](const Forces& f) {
            return du_.dot(f.dam) + b_k * (f.v.dot(k_du) + f.rock_v.dot(k_dr)) + dr_.dot(f.rock) -
                   gap_step.dot(f.contact) +
                   slip_damping_.coefficient * (slip * (f.slip_rate - f.mean_velocity) - mean * f.slip_rate);
        };
        numerical += 0.5 * alpha * (work(forces_) - work(forces_before2_));
    }
    e.numerical += numerical;
    energy_scale_ = std::max({energy_scale_, e.kinetic, std::abs(e.damping), std::abs(e.friction), std::abs(e.external),
                              std::abs(e.contact_normal), std::abs(e.numerical)});
}

std::size_t DynamicContact::bytes() const
{
    std::size_t sum = block_products_.bytes() + 16 * static_cast<std::size_t>(state_.u.size()) * sizeof(double);
    for (const auto& [dt, op] : operators_) sum += op->bytes();
    return sum;
}

} // namespace damslip::fe2d
