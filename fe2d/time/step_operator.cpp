#include "fe2d/time/step_operator.hpp"
#include "fe2d/solver/dense_algebra.hpp"

#include <cassert>

namespace damslip::fe2d {

namespace {

SparseMatrix sparse_step_matrix(const LinearSystem& system, const StepConstants& c)
{
    const double weight = 1.0 + c.scheme.alpha;
    SparseMatrix matrix = c.a0 * system.mass + (weight * c.a1) * system.damping;
    matrix += weight * system.stiffness;
    matrix.makeCompressed();
    return matrix;
}

} // namespace

StepOperator::StepOperator(const LinearSystem& system, const StepConstants& constants, const SolverOptions& solver)
    : constants_(constants), factor_(solver)
{
    factor_.factorise(sparse_step_matrix(system, constants));
    const LowRank& low_rank = system.damping_low_rank;
    if (low_rank.empty() || !report().ok()) return;
    columns_ = low_rank.columns;
    response_ = factor_.solve(columns_);
    const Eigen::MatrixXd core = (1.0 + constants.scheme.alpha) * constants.a1 * low_rank.core;
    const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(core.rows(), core.cols());
    small_ = (identity + core * (columns_.transpose() * response_)).partialPivLu().solve(core);
}

void StepOperator::correct_low_rank(Eigen::MatrixXd& solutions) const
{
    if (columns_.cols() > 0) solutions -= response_ * (small_ * (columns_.transpose() * solutions).eval());
}

Eigen::VectorXd StepOperator::solve(const Eigen::VectorXd& right_hand_side) const
{
    Eigen::VectorXd solution = factor_.solve(right_hand_side);
    if (columns_.cols() > 0) solution -= response_ * (small_ * (columns_.transpose() * solution).eval());
    return solution;
}

Eigen::MatrixXd StepOperator::solve_columns(const SparseMatrix& right_hand_sides) const
{
    Eigen::MatrixXd solutions = factor_.solve(Eigen::MatrixXd(right_hand_sides));
    correct_low_rank(solutions);
    return solutions;
}

InterfaceFlexibility StepOperator::flexibility(const SparseMatrix& interface_map) const
{
    assert(report().ok());
    InterfaceFlexibility result;
    result.response = solve_columns(SparseMatrix(interface_map.transpose()));
    result.delassus = (1.0 + constants_.scheme.alpha) * (interface_map * result.response);
    result.delassus = (0.5 * (result.delassus + result.delassus.transpose())).eval();
    return result;
}

} // namespace damslip::fe2d
