#pragma once

#include <Eigen/Core>

namespace damslip::fe2d {

/// How the peaks of modes, which do not come at the same instant, make one peak.
enum class ModalRule {
    srss, ///< root of the sum of squares: modes far from each other
    cqc   ///< complete quadratic combination
};

/// Correlation of two modes with the same damping under a broad-banded ground motion [-]; Der Kiureghian (1981), eq. (24)
/// with one damping ratio, r the ratio of the frequencies:
///
///     rho = 8 zeta^2 (1 + r) r^(3/2) / [(1 - r^2)^2 + 4 zeta^2 r (1 + r)^2]
///
/// Equal frequencies: 1. Frequencies far from each other, or no damping: 0.
/// @param f_i, f_j  > 0, in the same unit @param ratio  zeta [-], >= 0
double modal_correlation(double f_i, double f_j, double ratio);

/// Correlations of all modes; for ModalRule::srss the identity.
Eigen::MatrixXd modal_correlations(const Eigen::VectorXd& frequency, double ratio, ModalRule rule);

/// sum_i sum_j rho_ij a_i b_j: the square of a combined peak for a = b; divided by the peak of b, the value of a most
/// likely at the instant of that peak.
double combined_product(const Eigen::VectorXd& a, const Eigen::VectorXd& b, const Eigen::MatrixXd& correlation);

/// Peak of a quantity from those of the modes, >= 0, in its unit.
double combined_peak(const Eigen::VectorXd& modal, const Eigen::MatrixXd& correlation);

} // namespace damslip::fe2d
