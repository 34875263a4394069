#include "fe2d/modes/flexibility_operator.hpp"

namespace damslip::fe2d {

FlexibilityOperator::FlexibilityOperator(const LinearSolver& solver, const SparseMatrix& mass)
    : solver_(solver), unknowns_(mass.rows())
{
    std::vector<int> place(static_cast<std::size_t>(mass.rows()), no_dof);
    for (int i = 0; i < mass.rows(); ++i)
        if (mass.coeff(i, i) > 0.0) {
            place[i] = static_cast<int>(massive_.size());
            massive_.push_back(i);
        }
    std::vector<Eigen::Triplet<double>> entries;
    for (int j = 0; j < mass.cols(); ++j)
        for (SparseMatrix::InnerIterator it(mass, j); it; ++it)
            if (place[it.row()] != no_dof && place[j] != no_dof)
                entries.emplace_back(place[it.row()], place[j], it.value());
    SparseMatrix reduced(rows(), rows());
    reduced.setFromTriplets(entries.begin(), entries.end());
    factor_.compute(reduced);
    if (valid()) lower_ = factor_.matrixL();
}

Eigen::VectorXd FlexibilityOperator::displacement(const Eigen::VectorXd& y) const
{
    const Eigen::VectorXd force = factor_.permutationPinv() * (lower_ * y);
    Eigen::VectorXd full = Eigen::VectorXd::Zero(unknowns_);
    for (std::size_t i = 0; i < massive_.size(); ++i) full[massive_[i]] = force[static_cast<Eigen::Index>(i)];
    return solver_.solve(full);
}

void FlexibilityOperator::perform_op(const double* in, double* out) const
{
    ++applications_;
    const Eigen::VectorXd u = displacement(Eigen::Map<const Eigen::VectorXd>(in, rows()));
    Eigen::VectorXd massive(rows());
    for (std::size_t i = 0; i < massive_.size(); ++i) massive[static_cast<Eigen::Index>(i)] = u[massive_[i]];
    Eigen::Map<Eigen::VectorXd>(out, rows()) = lower_.transpose() * (factor_.permutationP() * massive);
}

} // namespace damslip::fe2d
