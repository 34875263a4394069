#pragma once

#include "core/vector_level.hpp"

#include <Eigen/Core>

namespace damslip::fe2d {

/// y += A x of a dense matrix. Each row sums its columns in blocks: all of them below 128 columns, else 16, or 4 where a
/// column takes more than 32 kB.
/// @param level  the same bits on every level
void add_product(const Eigen::MatrixXd& matrix, const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::VectorXd& y,
                 VectorLevel level = vector_level());

/// y = A x in the same order.
void set_product(const Eigen::MatrixXd& matrix, const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::VectorXd& y);

/// y -= x_j A_j, column by column in their order, of those whose x_j is not zero.
void subtract_columns(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& x, Eigen::VectorXd& y,
                      VectorLevel level = vector_level());

} // namespace damslip::fe2d
