#include "fe2d/time/central_difference.hpp"

#include <cassert>
#include <cmath>

namespace damslip::fe2d {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

constexpr int steps_between_products = 256; ///< of K u; the sums in between lose less than 1e-13 of it

/// Inverse of a symmetric matrix that couples each unknown with one other at most.
SparseMatrix inverse_of_blocks(const SparseMatrix& matrix)
{
    const VectorXd diagonal = matrix.diagonal();
    std::vector<Eigen::Triplet<double>> entries;
    for (Index k = 0; k < matrix.outerSize(); ++k) {
        Index other = k;
        double off = 0.0;
        for (SparseMatrix::InnerIterator it(matrix, k); it; ++it)
            if (it.row() != k && it.value() != 0.0) {
                assert(other == k && "blocks of two unknowns at most");
                other = it.row();
                off = it.value();
            }
        const double det = other == k ? diagonal[k] : diagonal[k] * diagonal[other] - off * off;
        entries.emplace_back(k, k, other == k ? 1.0 / det : diagonal[other] / det);
        if (other != k) entries.emplace_back(other, k, -off / det);
    }
    SparseMatrix inverse(matrix.rows(), matrix.cols());
    inverse.setFromTriplets(entries.begin(), entries.end());
    return inverse;
}

} // namespace

SparseMatrix lumped_mass(const DofMap& dofs, const VectorXd& inertia_x, const VectorXd& inertia_y, Index size)
{
    std::vector<Eigen::Triplet<double>> entries;
    std::vector<char> seen(static_cast<std::size_t>(size),
                           0); // nodes of a joint that does not open share their unknowns
    for (std::size_t node = 0; node < dofs.dofs.size() / 2; ++node) {
        const int x = dofs(static_cast<int>(node), 0), y = dofs(static_cast<int>(node), 1);
        const auto take = [&](int dof) {
            if (dof == no_dof || dof >= size || seen[static_cast<std::size_t>(dof)]) return false;
            return seen[static_cast<std::size_t>(dof)] = 1, true;
        };
        const bool has_x = take(x), has_y = take(y);
        if (has_x) entries.emplace_back(x, x, inertia_x[x]);
        if (has_y) entries.emplace_back(y, y, inertia_y[y]);
        if (!has_x || !has_y) continue;
        const double coupling = 0.5 * (inertia_y[x] + inertia_x[y]);
        if (coupling == 0.0) continue;
        entries.emplace_back(x, y, coupling);
        entries.emplace_back(y, x, coupling);
    }
    SparseMatrix mass(size, size);
    mass.setFromTriplets(entries.begin(), entries.end());
    return mass;
}

double central_difference_limit(double highest_frequency, double stiffness_damping)
{
    const double ratio = 0.5 * stiffness_damping * highest_frequency;
    return 2.0 / (highest_frequency * (std::sqrt(1.0 + ratio * ratio) + ratio)); // without cancellation
}

CentralDifference::CentralDifference(ExplicitSystem system, double dt)
    : system_(std::move(system)), dt_(dt),
      inverse_(inverse_of_blocks(SparseMatrix(system_.mass + 0.5 * dt * system_.mass_damping)))
{
    assert(dt > 0.0);
}

StepConstants CentralDifference::constants() const
{
    StepConstants c;
    c.scheme = {0.0, 0.5, 0.0};
    c.dt = dt_;
    return c;
}

State CentralDifference::start(const VectorXd& displacement, const VectorXd& velocity, const VectorXd& load) const
{
    State s;
    s.displacement = displacement;
    s.velocity = velocity;
    s.load = load;
    s.interface_force = VectorXd::Zero(displacement.size());
    s.stiffness_force = system_.stiffness * displacement;
    s.damping_force = system_.mass_damping * velocity + system_.stiffness_damping * (system_.stiffness * velocity);
    s.unbalanced = s.damping_force + s.stiffness_force - load;
    s.unbalanced_before = s.unbalanced;
    s.acceleration = -(inverse_of_blocks(system_.mass) * s.unbalanced);
    s.momentum = system_.mass * velocity;
    s.inertia_force = system_.mass * s.acceleration;
    return s;
}

void CentralDifference::step(const State& before, const VectorXd& load_after, State& after)
{
    assert(&before != &after);
    after.time = before.time + dt_;
    after.load = load_after;
    if (after.interface_force.size() == 0) after.interface_force = before.interface_force;
    middle_ = before.velocity + 0.5 * dt_ * before.acceleration;
    after.displacement = before.displacement + dt_ * middle_;
    product_.noalias() = system_.stiffness.transpose() * middle_; // symmetric: rows are read one after the other
    if (++since_product_ == steps_between_products) {
        since_product_ = 0;
        after.stiffness_force.noalias() = system_.stiffness.transpose() * after.displacement;
    } else {
        after.stiffness_force = before.stiffness_force + dt_ * product_;
    }
    after.damping_force.noalias() = system_.mass_damping * middle_;
    if (system_.stiffness_damping != 0.0) after.damping_force += system_.stiffness_damping * product_;
    product_ = load_after - after.stiffness_force - after.damping_force;
    after.acceleration.noalias() = inverse_ * product_;
    after.velocity = middle_ + 0.5 * dt_ * after.acceleration;
    after.damping_force += system_.mass_damping * (0.5 * dt_ * after.acceleration);
    after.momentum.noalias() = system_.mass * after.velocity;
    after.inertia_force.noalias() = system_.mass * after.acceleration;
    after.unbalanced_before = before.unbalanced;
    after.unbalanced = after.damping_force + after.stiffness_force - load_after;
}

} // namespace damslip::fe2d
