#include "fe2d/time/symmetric_factor.hpp"

#include <Eigen/SparseCholesky>

#include <cassert>

namespace damslip::fe2d {

struct SymmetricFactor::Factor {
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> ldlt;
};

SymmetricFactor::SymmetricFactor(const Eigen::SparseMatrix<double>& matrix) : factor_(std::make_unique<Factor>())
{
    factor_->ldlt.compute(matrix);
}

SymmetricFactor::~SymmetricFactor() = default;
SymmetricFactor::SymmetricFactor(SymmetricFactor&&) noexcept = default;
SymmetricFactor& SymmetricFactor::operator=(SymmetricFactor&&) noexcept = default;

Eigen::Index SymmetricFactor::size() const
{
    return factor_->ldlt.rows();
}

bool SymmetricFactor::regular() const
{
    return factor_->ldlt.info() == Eigen::Success;
}

Eigen::VectorXd SymmetricFactor::solve(const Eigen::VectorXd& right_hand_side) const
{
    assert(regular());
    return factor_->ldlt.solve(right_hand_side);
}

Eigen::MatrixXd SymmetricFactor::solve_block(const Eigen::MatrixXd& right_hand_sides) const
{
    assert(regular());
    return factor_->ldlt.solve(right_hand_sides);
}

} // namespace damslip::fe2d
