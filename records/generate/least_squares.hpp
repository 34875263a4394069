#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace damslip::records {

/// Linear equations, more or fewer than unknowns, solved in the least-squares sense with small unknowns preferred.
class RegularisedLeastSquares {
public:
    explicit RegularisedLeastSquares(std::size_t unknowns)
        : unknowns_(unknowns), normal_(unknowns * unknowns, 0.0), right_(unknowns, 0.0)
    {
    }

    /// One equation: sum coefficients[j] x[j] = value.
    void add(std::span<const double> coefficients, double value);

    /// x that minimises |C x - r|^2 + lambda |x|^2, lambda = regularisation * mean diagonal of C^T C. @param
    /// regularisation  > 0
    std::vector<double> solve(double regularisation) const;

private:
    std::size_t unknowns_;
    std::vector<double> normal_; ///< C^T C, lower triangle by rows
    std::vector<double> right_;  ///< C^T r
};

} // namespace damslip::records
