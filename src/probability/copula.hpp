#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

namespace damslip::probability {

/// One rank correlation of two variables, by their place in the list.
struct RankCorrelation {
    std::size_t first = 0, second = 0;
    double spearman = 0.0; ///< rho_S [-], -1 < rho_S < 1
};

/// The correlations contradict one another.
class NotPositiveDefinite : public std::invalid_argument {
public:
    explicit NotPositiveDefinite(double smallest_eigenvalue);
    double smallest_eigenvalue() const { return smallest_; } ///< of the matrix of r; <= 1e-10

private:
    double smallest_;
};

/// Gaussian copula: z = Phi^-1(u) of independent u, y = L z with L L^T = R, then Phi(y). R has r = 2 sin(pi rho_S / 6), which gives
/// continuous variables the Spearman correlation rho_S (Kruskal 1958).
///
/// Variable k depends on the u of variables 0 ... k alone. One that is drawn in batches goes last: its u then moves no other variable.
class GaussianCopula {
public:
    /// @throws ParameterError for |rho_S| >= 1, a pair of one variable with itself, a pair named twice; NotPositiveDefinite
    GaussianCopula(std::size_t dimension, std::span<const RankCorrelation> correlations);

    std::size_t dimension() const { return dimension_; }
    bool independent() const { return independent_; }
    double correlation(std::size_t i, std::size_t j) const
    {
        return r_[i * dimension_ + j];
    } ///< r_ij of the normal variables

    /// Dependent uniform numbers from independent ones. Without any correlation they come back bit for bit.
    std::vector<double> dependent(std::span<const double> u) const;

    /// The variables not in `given` (a mask of bits) drawn anew from independent u, those in it kept as they are in `fixed` (dependent uniforms).
    std::vector<double> conditional(std::uint32_t given, std::span<const double> fixed,
                                    std::span<const double> u) const;

private:
    std::size_t dimension_;
    bool independent_;
    std::vector<double> r_, factor_; ///< R and L, row by row
};

} // namespace damslip::probability
