#pragma once

#include "core/vector_level.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace damslip::fe2d {

/// y += Aᵀ x of a dense matrix that stays as it is, again and again. Each column sums its even and its odd rows apart, as Eigen
/// does with two numbers at a time; two columns stand side by side, so that four numbers go at once: the same bits.
class TransposedProduct {
public:
    /// @param matrix  an even number of rows, two columns or more (Eigen sums a single one otherwise); copied
    explicit TransposedProduct(const Eigen::MatrixXd& matrix);
    TransposedProduct() = default; ///< of a matrix without columns

    /// @param level  the same bits on every level
    void add(const Eigen::VectorXd& x, Eigen::VectorXd& y, VectorLevel level = vector_level()) const;

private:
    std::size_t twos_ = 0; ///< rows, two at a time
    std::size_t columns_ = 0;
    std::vector<double>
        columns_of_two_; ///< by two columns, by two rows: both rows of the first column, then of the second
};

} // namespace damslip::fe2d
