#pragma once

#include "fe2d/run/node_order.hpp"

#include <Eigen/Core>

#include <vector>

namespace damslip::fe2d {

/// A large matrix of which few rows are not empty: a product visits these alone.
class FewRows {
public:
    FewRows() = default; ///< empty
    explicit FewRows(const SparseMatrix& matrix);

    /// y -= A x; each row's sum runs by ascending columns.
    void subtract_product(const Eigen::VectorXd& x, Eigen::VectorXd& y) const;

private:
    std::vector<int> row_, begin_, column_; ///< entries of row_[k]: begin_[k] ... begin_[k+1]-1
    std::vector<double> value_;
};

} // namespace damslip::fe2d
