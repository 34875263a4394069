#pragma once

#include <Eigen/SparseCore>

#include <memory>

namespace damslip::fe2d {

/// L D Lᵀ of a symmetric sparse matrix, factorised once and solved with many times.
class SymmetricFactor {
public:
    explicit SymmetricFactor(const Eigen::SparseMatrix<double>& matrix);
    ~SymmetricFactor();
    SymmetricFactor(SymmetricFactor&&) noexcept;
    SymmetricFactor& operator=(SymmetricFactor&&) noexcept;

    Eigen::Index size() const;
    bool regular() const; ///< false: a pivot vanished, solve() must not be called
    Eigen::VectorXd solve(const Eigen::VectorXd& right_hand_side) const;
    Eigen::MatrixXd solve_block(const Eigen::MatrixXd& right_hand_sides) const;

private:
    struct Factor;
    std::unique_ptr<Factor> factor_;
};

} // namespace damslip::fe2d
