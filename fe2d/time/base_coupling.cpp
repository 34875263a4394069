#include "fe2d/time/base_coupling.hpp"

#include <cassert>

namespace damslip::fe2d {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// B, or B' with a floor.
SparseMatrix selection(std::span<const Index> unknowns, Index size, const WaterFloor& floor)
{
    std::vector<Eigen::Triplet<double>> entries;
    for (const Index unknown : unknowns) entries.emplace_back(static_cast<Index>(entries.size()), unknown, 1.0);
    for (const Index unknown : floor.unknowns)
        entries.emplace_back(static_cast<Index>(entries.size()), unknown, floor.scale);
    SparseMatrix map(static_cast<Index>(entries.size()), size);
    map.setFromTriplets(entries.begin(), entries.end());
    return map;
}

} // namespace

BaseCoupling::BaseCoupling(std::unique_ptr<MovingBase> base, const StepOperator& dam, std::span<const Index> unknowns,
                           Index size, WaterFloor floor)
    : base_(std::move(base)), floor_(std::move(floor)), constants_(dam.constants()),
      map_(selection(unknowns, size, floor_)), alpha_(constants_.scheme.alpha), dam_(dam.flexibility(map_)),
      force_(VectorXd::Zero(map_.rows())), force_before_(force_)
{
    const MatrixXd& compliance = base_->compliance();
    assert(compliance.rows() == map_.rows());
    if (floor_.unknowns.empty()) {
        factor_.compute(dam_.delassus + (1.0 + alpha_) * compliance);
        return;
    }
    const Index all = map_.rows(), n = base_->floor(), b = all - n;
    assert(n == static_cast<Index>(floor_.unknowns.size()));
    const double w = 1.0 + alpha_, a1 = constants_.a1;
    to_weighted_ = MatrixXd::Zero(all, all);
    to_weighted_.diagonal().head(b).array() = -w;
    to_weighted_.bottomRows(n) = (w * a1) * dam_.delassus.bottomRows(n);
    const MatrixXd of_base = compliance * to_weighted_;
    MatrixXd matrix(all, all);
    matrix.topRows(b) = dam_.delassus.topRows(b) - of_base.topRows(b);
    matrix.bottomRows(n) = -a1 * of_base.bottomRows(n);
    matrix.bottomRightCorner(n, n).diagonal().array() += 1.0;
    with_floor_.compute(matrix);
    pressure_ = pressure_before_ = VectorXd::Zero(n);
}

InterfaceForces BaseCoupling::step_with_floor(const FreeStep& free, const State& before)
{
    const Index n = base_->floor(), b = map_.rows() - n;
    const double w = 1.0 + alpha_, a1 = constants_.a1, a4 = constants_.a4, a5 = constants_.a5;
    const VectorXd own = base_->begin_step(), of_dam = map_ * free.increment,
                   pressure_rate = (map_ * before.acceleration).tail(n), rate = base_->floor_velocity(),
                   acceleration = base_->floor_acceleration();
    VectorXd known(b + n); // p̃ for x = 0
    known << alpha_ * force_.head(b),
        w * (a1 * of_dam.tail(n) - a4 * pressure_ - a5 * pressure_rate) - alpha_ * pressure_;
    const VectorXd moved = own + base_->compliance() * known;
    VectorXd right(b + n);
    right << moved.head(b) - of_dam.head(b), a1 * moved.tail(n) - a4 * rate - a5 * acceleration;
    const VectorXd x = with_floor_.solve(right);
    const VectorXd weighted = known + to_weighted_ * x;
    base_->end_step(weighted);

    InterfaceForces forces{map_.transpose() * x, dam_.response * x};
    const VectorXd step = map_ * (free.increment + w * forces.displacement);
    const VectorXd pressure = a1 * step.tail(n) - a4 * pressure_ - a5 * pressure_rate;
    const VectorXd volume = (x.tail(n) + a4 * rate + a5 * acceleration) / a1;
    floor_work_ = 0.5 * volume.dot(pressure + pressure_);
    numerical_work_ =
        0.5 * alpha_ * (step.head(b).dot(x.head(b) - force_before_.head(b)) - volume.dot(pressure - pressure_before_)) +
        0.5 * step.tail(n).dot(x.tail(n) + rate) - floor_work_;
    force_before_ = force_;
    force_ = x;
    pressure_before_ = pressure_;
    pressure_ = pressure;
    return forces;
}

InterfaceForces BaseCoupling::step(const FreeStep& free, const State& before)
{
    if (!floor_.unknowns.empty()) return step_with_floor(free, before);
    VectorXd gap = base_->begin_step();
    if (alpha_ != 0.0) gap += alpha_ * (base_->compliance() * force_);
    gap -= map_ * free.increment;
    const VectorXd force = factor_.solve(gap);
    base_->end_step(alpha_ * force_ - (1.0 + alpha_) * force);

    InterfaceForces forces{map_.transpose() * force, dam_.response * force};
    const VectorXd step = map_ * (free.increment + (1.0 + alpha_) * forces.displacement);
    numerical_work_ = 0.5 * alpha_ * step.dot(force - force_before_);
    force_before_ = force_;
    force_ = force;
    return forces;
}

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
