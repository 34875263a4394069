#include "fe2d/time/linear_integrator.hpp"

#include <algorithm>
#include <cassert>

namespace damslip::fe2d {

namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// Solves M x = f on the unknowns that have mass, 0 elsewhere.
VectorXd solve_mass(const SparseMatrix& mass, const std::vector<char>& massless, const VectorXd& force)
{
    std::vector<Eigen::Triplet<double>> entries;
    for (Index column = 0; column < mass.outerSize(); ++column)
        for (SparseMatrix::InnerIterator entry(mass, column); entry; ++entry)
            if (entry.value() != 0.0) entries.emplace_back(entry.row(), entry.col(), entry.value());
    VectorXd right_hand_side = force;
    for (Index row = 0; row < mass.rows(); ++row)
        if (massless[static_cast<std::size_t>(row)]) {
            entries.emplace_back(row, row, 1.0);
            right_hand_side[row] = 0.0;
        }
    SparseMatrix regular(mass.rows(), mass.cols());
    regular.setFromTriplets(entries.begin(), entries.end());
    LinearSolver factor;
    factor.factorise(regular);
    assert(factor.report().ok() && "mass matrix singular on unknowns that have mass");
    return factor.solve(right_hand_side);
}

} // namespace

LinearIntegrator::LinearIntegrator(LinearSystem system, Scheme scheme, const SolverOptions& solver)
    : system_(std::move(system)), scheme_(scheme), solver_(solver), massless_(massless_unknowns(system_.mass))
{
    assert(system_.mass.rows() == system_.size() && system_.damping.rows() == system_.size());
}

State LinearIntegrator::start(const VectorXd& displacement, const VectorXd& velocity, const VectorXd& load,
                              const VectorXd& interface_force) const
{
    VectorXd force = load - system_.stiffness * displacement;
    if (interface_force.size() > 0) force += interface_force;
    VectorXd damping_force = VectorXd::Zero(system_.size());
    system_.add_damping_product(velocity, damping_force);
    return state(displacement, velocity, solve_mass(system_.mass, massless_, force - damping_force), load,
                 interface_force);
}

State LinearIntegrator::state(const VectorXd& displacement, const VectorXd& velocity, const VectorXd& acceleration,
                              const VectorXd& load, const VectorXd& interface_force) const
{
    assert(displacement.size() == system_.size() && velocity.size() == system_.size() && load.size() == system_.size());
    State state;
    state.displacement = displacement;
    state.velocity = velocity;
    state.acceleration = acceleration;
    state.load = load;
    state.interface_force = interface_force.size() > 0 ? interface_force : VectorXd::Zero(system_.size());
    fill_products(state);
    state.unbalanced_before = state.unbalanced;
    return state;
}

double LinearIntegrator::massless_imbalance(const State& state) const
{
    double largest = 0.0;
    for (Index row = 0; row < system_.size(); ++row)
        if (massless_[static_cast<std::size_t>(row)]) largest = std::max(largest, std::abs(state.unbalanced[row]));
    if (largest == 0.0) return 0.0;
    const double scale =
        std::max({state.stiffness_force.cwiseAbs().maxCoeff(), state.damping_force.cwiseAbs().maxCoeff(),
                  state.load.cwiseAbs().maxCoeff(), state.interface_force.cwiseAbs().maxCoeff()});
    return largest / scale;
}

const StepOperator& LinearIntegrator::step_operator(double dt)
{
    auto& slot = operators_[dt];
    if (!slot) slot = std::make_unique<StepOperator>(system_, step_constants(scheme_, dt), solver_);
    return *slot;
}

FreeStep LinearIntegrator::free_step(const StepOperator& step, const State& before, const VectorXd& load_after) const
{
    const StepConstants& c = step.constants();
    const double alpha = c.scheme.alpha, weight = 1.0 + alpha;
    VectorXd right_hand_side = weight * load_after - alpha * (before.load + before.interface_force) -
                               before.stiffness_force + (alpha + weight * c.a4) * before.damping_force +
                               c.a2 * before.momentum + c.a3 * before.inertia_force;
    if (c.a5 != 0.0) system_.add_damping_product((weight * c.a5) * before.acceleration, right_hand_side);
    return {step.solve(right_hand_side)};
}

void LinearIntegrator::finish_step(const StepOperator& step, const State& before, const VectorXd& load_after,
                                   const FreeStep& free, const InterfaceForces& interface, State& after) const
{
    after.load = load_after;
    after.interface_force = interface.force;
    after.displacement = free.increment + (1.0 + step.constants().scheme.alpha) * interface.displacement;
    update(step, before, after);
}

void LinearIntegrator::finish_step(const StepOperator& step, const State& before, const VectorXd& load_after,
                                   const FreeStep& free, State& after) const
{
    after.load = load_after;
    after.interface_force.setZero(system_.size());
    after.displacement = free.increment;
    update(step, before, after);
}

/// On entry after.displacement holds the increment Δu.
void LinearIntegrator::update(const StepOperator& step, const State& before, State& after) const
{
    assert(&before != &after);
    const StepConstants& c = step.constants();
    after.time = before.time + c.dt;
    after.acceleration = c.a0 * after.displacement - c.a2 * before.velocity - c.a3 * before.acceleration;
    after.velocity = c.a1 * after.displacement - c.a4 * before.velocity - c.a5 * before.acceleration;
    after.displacement += before.displacement;
    after.unbalanced_before = before.unbalanced;
    fill_products(after);
}

void LinearIntegrator::fill_products(State& state) const
{
    state.stiffness_force.noalias() = system_.stiffness * state.displacement;
    state.damping_force.setZero(system_.size());
    system_.add_damping_product(state.velocity, state.damping_force);
    state.momentum.noalias() = system_.mass * state.velocity;
    state.inertia_force.noalias() = system_.mass * state.acceleration;
    state.unbalanced = state.damping_force + state.stiffness_force - state.load - state.interface_force;
}

} // namespace damslip::fe2d
