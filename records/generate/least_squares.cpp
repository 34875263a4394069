#include "records/generate/least_squares.hpp"

#include <cmath>

namespace damslip::records {

namespace {

/// x := A^-1 x for a positive definite A, lower triangle by rows, overwritten by its factor. Written out, since a BLAS library may sum
/// in another order on another processor: the same seed must give the same record.
void cholesky_solve(std::vector<double>& a, std::vector<double>& x)
{
    const std::size_t n = x.size();
    const auto row = [&](std::size_t i) { return a.data() + i * n; };
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j <= i; ++j) {
            double sum = row(i)[j];
            for (std::size_t k = 0; k < j; ++k) sum -= row(i)[k] * row(j)[k];
            row(i)[j] = i == j ? std::sqrt(sum) : sum / row(j)[j];
        }
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t k = 0; k < i; ++k) x[i] -= row(i)[k] * x[k];
        x[i] /= row(i)[i];
    }
    for (std::size_t i = n; i-- > 0;) {
        for (std::size_t k = i + 1; k < n; ++k) x[i] -= row(k)[i] * x[k];
        x[i] /= row(i)[i];
    }
}

} // namespace

void RegularisedLeastSquares::add(std::span<const double> coefficients, double value)
{
    for (std::size_t i = 0; i < unknowns_; ++i) {
        if (coefficients[i] == 0.0) continue;
        double* row = normal_.data() + i * unknowns_;
        for (std::size_t j = 0; j <= i; ++j) row[j] += coefficients[i] * coefficients[j];
        right_[i] += coefficients[i] * value;
    }
}

std::vector<double> RegularisedLeastSquares::solve(double regularisation) const
{
    std::vector<double> matrix = normal_, x = right_;
    double trace = 0.0;
    for (std::size_t i = 0; i < unknowns_; ++i) trace += matrix[i * unknowns_ + i];
    const double lambda = regularisation * trace / static_cast<double>(unknowns_);
    for (std::size_t i = 0; i < unknowns_; ++i) matrix[i * unknowns_ + i] += lambda; // positive definite
    cholesky_solve(matrix, x);
    return x;
}

} // namespace damslip::records
