#include "fe2d/modes/natural_modes.hpp"

#include "fe2d/modes/flexibility_operator.hpp"
#include "fe2d/solver/dense_algebra.hpp"

#include <Spectra/SymEigsSolver.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace damslip::fe2d {

namespace {

struct EigenPairs {
    Eigen::VectorXd values; ///< 1 / omega^2, largest first
    Eigen::MatrixXd vectors;
};

/// The whole spectrum, for systems too small for a Krylov space.
EigenPairs all_pairs(const FlexibilityOperator& op, int count)
{
    Eigen::MatrixXd dense(op.rows(), op.rows());
    for (Eigen::Index j = 0; j < op.rows(); ++j) {
        const Eigen::VectorXd unit = Eigen::VectorXd::Unit(op.rows(), j);
        op.perform_op(unit.data(), dense.col(j).data());
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(dense);
    return {solver.eigenvalues().reverse().head(count), solver.eigenvectors().rowwise().reverse().leftCols(count)};
}

/// A start vector without symmetry and the same every time: a linear congruential sequence in -1 ... 1.
Eigen::VectorXd start_vector(Eigen::Index n)
{
    Eigen::VectorXd v(n);
    std::uint32_t state = 20150101u;
    for (double& x : v) {
        state = 1664525u * state + 1013904223u;
        x = static_cast<double>(state) / 2147483648.0 - 1.0;
    }
    return v;
}

EigenPairs largest_pairs(FlexibilityOperator& op, int count)
{
    const int n = static_cast<int>(op.rows());
    const int space = std::max(2 * count + 1, 20);
    if (space >= n) return all_pairs(op, count);
    Spectra::SymEigsSolver<FlexibilityOperator> solver(op, count, space);
    solver.init(start_vector(n).data());
    solver.compute(Spectra::SortRule::LargestMagn, 1000, 1e-13);
    return {solver.eigenvalues(), solver.eigenvectors()};
}

/// Mass-normalised, the largest entry positive.
Eigen::VectorXd normalised(const Eigen::VectorXd& shape, const SparseMatrix& mass)
{
    Eigen::Index largest = 0;
    shape.cwiseAbs().maxCoeff(&largest);
    return shape * ((shape[largest] < 0.0 ? -1.0 : 1.0) / std::sqrt(shape.dot(mass * shape)));
}

} // namespace

NaturalModes natural_modes(const Model& model, int count, const SolverOptions& options)
{
    NaturalModes modes;
    const SparseMatrix mass = model.moving_mass();
    LinearSolver solver(options);
    modes.solver = solver.factorise(model.stiffness);
    if (!modes.solver.ok()) {
        modes.status = ModesStatus::solver_failed;
        return modes;
    }
    FlexibilityOperator op(solver, mass);
    if (!op.valid() || op.rows() == 0) {
        modes.status = ModesStatus::no_mass;
        return modes;
    }
    count = static_cast<int>(std::min<Eigen::Index>(count, op.rows()));
    const EigenPairs pairs = largest_pairs(op, count);
    modes.status = pairs.values.size() < count ? ModesStatus::not_converged : ModesStatus::ok;
    modes.operator_applications = op.applications();

    const Eigen::Index found = pairs.values.size();
    modes.frequency.resize(found);
    modes.shape.resize(model.dofs.count, found);
    modes.participation.resize(2, found);
    for (Eigen::Index i = 0; i < found; ++i) {
        modes.frequency[i] = 1.0 / (2.0 * std::numbers::pi * std::sqrt(pairs.values[i]));
        modes.shape.col(i) = normalised(op.displacement(pairs.vectors.col(i)), mass);
        modes.participation.col(i) << modes.shape.col(i).dot(model.inertia_x), modes.shape.col(i).dot(model.inertia_y);
    }
    modes.effective_mass = modes.participation.cwiseAbs2();
    modes.effective_share = model.total_mass.cwiseInverse().asDiagonal() * modes.effective_mass;
    return modes;
}

} // namespace damslip::fe2d
