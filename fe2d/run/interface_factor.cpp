#include "fe2d/run/interface_factor.hpp"

#include <Eigen/SparseCholesky>

#include <cassert>

namespace damslip::fe2d {

using Eigen::Index;

InterfaceFactor::InterfaceFactor(const SparseMatrix& matrix, int inner_nodes) : inner_(inner_nodes)
{
    // The interface part may be singular; with a multiple of the identity added it is not, and taking it off again
    // costs one rounding because it is of the size of the diagonal.
    const Index n = matrix.rows(), inner = 2 * inner_, rest = n - inner;
    const double shift = matrix.diagonal().tail(rest).mean();
    SparseMatrix shifted = matrix;
    for (Index k = inner; k < n; ++k) shifted.coeffRef(k, k) += shift;
    Eigen::SimplicialLDLT<SparseMatrix, Eigen::Lower, Eigen::NaturalOrdering<int>> ldlt(shifted);
    if (ldlt.info() != Eigen::Success) return;
    const Eigen::VectorXd d = ldlt.vectorD();
    if (!(d.minCoeff() > 0.0)) return;
    regular_ = true;
    const auto& lower = ldlt.matrixL().nestedExpression(); // CSC without the unit diagonal, rows ascending

    begin_.assign(1, 0);
    pivot_.reserve(static_cast<std::size_t>(inner_));
    for (int j = 0; j < inner_; ++j) {
        double l = 0.0; // L(2j+1, 2j)
        SparseMatrix::InnerIterator a(lower, 2 * j), b(lower, 2 * j + 1);
        while (a && a.row() <= 2 * j) ++a;
        if (a && a.row() == 2 * j + 1) {
            l = a.value();
            ++a;
        }
        while (b && b.row() <= 2 * j + 1) ++b;
        while (a || b) {
            const Index node = std::min(a ? a.row() : n, b ? b.row() : n) / 2;
            double v[4] = {0, 0, 0, 0};
            for (; a && a.row() / 2 == node; ++a) v[a.row() % 2] = a.value();
            for (; b && b.row() / 2 == node; ++b) v[2 + b.row() % 2] = b.value();
            row_.push_back(static_cast<int>(node));
            block_.push_back({{v[0] - l * v[2], v[1] - l * v[3], v[2], v[3]}}); // times the inverse of [1 0; l 1]
        }
        begin_.push_back(static_cast<int>(row_.size()));
        const double first = 1.0 / d[2 * j], second = 1.0 / d[2 * j + 1];
        pivot_.push_back({first + l * l * second, -l * second, second});
    }
    Eigen::MatrixXd corner = Eigen::MatrixXd::Identity(rest, rest);
    for (Index j = 0; j < rest; ++j)
        for (SparseMatrix::InnerIterator it(lower, static_cast<int>(inner + j)); it; ++it)
            if (it.row() > inner + j) corner(it.row() - inner, j) = it.value();
    corner = (corner * d.tail(rest).cwiseSqrt().asDiagonal()).eval();
    schur_.setZero(rest, rest);
    schur_.selfadjointView<Eigen::Lower>().rankUpdate(corner);
    schur_.diagonal().array() -= shift;
    schur_.triangularView<Eigen::StrictlyUpper>() = schur_.transpose();
}

namespace {

using Pair = Eigen::Array2d; ///< both unknowns of a node; two at a time is what every x86-64 does in one operation
using Values = Eigen::Map<const Pair>;

} // namespace

void InterfaceFactor::forward(Eigen::VectorXd& b) const
{
    double* const x = b.data();
    for (int j = 0; j < inner_; ++j) {
        const double x0 = x[2 * j], x1 = x[2 * j + 1];
        for (int k = begin_[j]; k < begin_[j + 1]; ++k) {
            const double* const l = block_[k].v;
            Eigen::Map<Pair> y(x + 2 * row_[k]);
            y -= Values(l) * x0 + Values(l + 2) * x1;
        }
    }
}

void InterfaceFactor::backward(Eigen::VectorXd& b) const
{
    double* const x = b.data();
    for (int j = inner_ - 1; j >= 0; --j) {
        Pair first = Pair::Zero(), second = first, first_odd = first, second_odd = first;
        int k = begin_[j];
        for (const int end = begin_[j + 1]; k + 1 < end; k += 2) { // two sums each: they do not wait for each other
            const double *const l = block_[k].v, *const m = block_[k + 1].v;
            const Values y(x + 2 * row_[k]), z(x + 2 * row_[k + 1]);
            first += Values(l) * y;
            second += Values(l + 2) * y;
            first_odd += Values(m) * z;
            second_odd += Values(m + 2) * z;
        }
        if (k < begin_[j + 1]) {
            const Values y(x + 2 * row_[k]);
            first += Values(block_[k].v) * y;
            second += Values(block_[k].v + 2) * y;
        }
        first += first_odd;
        second += second_odd;
        const double b0 = x[2 * j], b1 = x[2 * j + 1];
        const Pivot& p = pivot_[j];
        x[2 * j] = p.xx * b0 + p.xy * b1 - (first[0] + first[1]);
        x[2 * j + 1] = p.xy * b0 + p.yy * b1 - (second[0] + second[1]);
    }
}

double InterfaceFactor::inner_product(const Eigen::VectorXd& a, const Eigen::VectorXd& b) const
{
    double sum = 0.0;
    for (int j = 0; j < inner_; ++j) {
        const Pivot& p = pivot_[j];
        sum +=
            a[2 * j] * (p.xx * b[2 * j] + p.xy * b[2 * j + 1]) + a[2 * j + 1] * (p.xy * b[2 * j] + p.yy * b[2 * j + 1]);
    }
    return sum;
}

std::size_t InterfaceFactor::bytes() const
{
    return block_.size() * sizeof(Block) + (row_.size() + begin_.size()) * sizeof(int) + pivot_.size() * sizeof(Pivot) +
           static_cast<std::size_t>(schur_.size()) * sizeof(double);
}

} // namespace damslip::fe2d
