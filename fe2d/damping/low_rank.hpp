#pragma once

#include <Eigen/Core>

namespace damslip::fe2d {

/// The symmetric n x n matrix U S Uᵀ of rank k, kept as its factors: it touches many unknowns but never fills a sparse
/// matrix.
struct LowRank {
    Eigen::MatrixXd columns; ///< U, n x k; empty: the zero matrix
    Eigen::MatrixXd core;    ///< S, k x k, symmetric, may be indefinite

    bool empty() const { return columns.cols() == 0; }

    /// result += factor U S Uᵀ x
    void add_product(const Eigen::VectorXd& x, double factor, Eigen::VectorXd& result) const;
};

} // namespace damslip::fe2d
