#include "fe2d/run/few_rows.hpp"

namespace damslip::fe2d {

FewRows::FewRows(const SparseMatrix& matrix) : begin_{0}
{
    const Eigen::SparseMatrix<double, Eigen::RowMajor> by_rows = matrix;
    for (int row = 0; row < by_rows.outerSize(); ++row) {
        for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator it(by_rows, row); it; ++it) {
            column_.push_back(static_cast<int>(it.col()));
            value_.push_back(it.value());
        }
        if (static_cast<int>(column_.size()) == begin_.back()) continue;
        row_.push_back(row);
        begin_.push_back(static_cast<int>(column_.size()));
    }
}

void FewRows::subtract_product(const Eigen::VectorXd& x, Eigen::VectorXd& y) const
{
    for (std::size_t k = 0; k < row_.size(); ++k) {
        double sum = 0.0;
        for (int e = begin_[k]; e < begin_[k + 1]; ++e) sum += value_[e] * x[column_[e]];
        y[row_[k]] -= sum;
    }
}

} // namespace damslip::fe2d
