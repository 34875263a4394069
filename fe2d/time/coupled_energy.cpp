#include "fe2d/time/coupled_energy.hpp"

namespace damslip::fe2d {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

/// The corner of `first` size of one matrix and, behind it, another one times a factor.
SparseMatrix corner_and(const SparseMatrix& matrix, Index first, const SparseMatrix& second, double factor)
{
    Triplets entries;
    for (Index j = 0; j < first; ++j)
        for (SparseMatrix::InnerIterator entry(matrix, j); entry; ++entry)
            if (entry.row() < first) entries.emplace_back(entry.row(), j, entry.value());
    for (Index j = 0; j < second.outerSize(); ++j)
        for (SparseMatrix::InnerIterator entry(second, j); entry; ++entry)
            entries.emplace_back(first + entry.row(), first + j, factor * entry.value());
    SparseMatrix result(first + second.rows(), first + second.rows());
    result.setFromTriplets(entries.begin(), entries.end());
    return result;
}

} // namespace

CoupledEnergy::CoupledEnergy(const CoupledSystem& system, const FluidModel& water,
                             const SparseMatrix& structure_damping)
    : structure_(system.structure_unknowns), mesh_(water.mesh_unknowns)
{
    const double s2 = system.scale * system.scale;
    mass_ = corner_and(system.mass, structure_, water.body_mass, s2);
    stiffness_ = corner_and(system.stiffness, structure_, water.body_stiffness, s2);
    damping_ = corner_and(structure_damping, structure_, SparseMatrix(water.unknowns(), water.unknowns()), 1.0);
    coupling_ = system.damping.topRightCorner(structure_, system.water_unknowns); // -sH
    taken_mass_ = s2 * SparseMatrix((water.mass - water.body_mass).topRows(mesh_));
    taken_damping_ = s2 * SparseMatrix(water.damping.topRows(mesh_));
    taken_stiffness_ = s2 * SparseMatrix((water.stiffness - water.body_stiffness).topRows(mesh_));
}

State CoupledEnergy::view(const State& state) const
{
    State view = state;
    const auto turn = [this](VectorXd& values) {
        values.segment(structure_, mesh_) *= -1.0;
        values.tail(values.size() - structure_ - mesh_).setZero();
    };
    view.momentum = mass_ * state.velocity;
    view.inertia_force = mass_ * state.acceleration;
    view.stiffness_force = stiffness_ * state.displacement;
    view.damping_force = damping_ * state.velocity;
    turn(view.load);
    turn(view.unbalanced);
    turn(view.unbalanced_before);
    return view;
}

InterfaceWork CoupledEnergy::work(const State& before, const State& after) const
{
    const Index water = coupling_.cols();
    const VectorXd step = after.displacement - before.displacement;
    const VectorXd velocity = 0.5 * (before.velocity + after.velocity);
    const VectorXd acceleration = 0.5 * (before.acceleration + after.acceleration).tail(water),
                   potential = 0.5 * (before.displacement + after.displacement).tail(water);
    InterfaceWork work;
    work.radiated =
        step.segment(structure_, mesh_)
            .dot(taken_mass_ * acceleration + taken_damping_ * velocity.tail(water) + taken_stiffness_ * potential);
    work.numerical = step.head(structure_).dot(coupling_ * velocity.tail(water)) -
                     velocity.head(structure_).dot(coupling_ * step.tail(water));
    return work;
}

} // namespace damslip::fe2d
