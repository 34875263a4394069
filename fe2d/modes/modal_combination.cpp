#include "fe2d/modes/modal_combination.hpp"

#include <algorithm>
#include <cmath>

namespace damslip::fe2d {

double modal_correlation(double f_i, double f_j, double ratio)
{
    if (f_i == f_j) return 1.0;
    const double r = f_j / f_i, damping = ratio * ratio, apart = 1.0 - r * r;
    return 8.0 * damping * (1.0 + r) * r * std::sqrt(r) / (apart * apart + 4.0 * damping * r * (1.0 + r) * (1.0 + r));
}

Eigen::MatrixXd modal_correlations(const Eigen::VectorXd& frequency, double ratio, ModalRule rule)
{
    const Eigen::Index n = frequency.size();
    Eigen::MatrixXd rho = Eigen::MatrixXd::Identity(n, n);
    if (rule == ModalRule::srss) return rho;
    for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index j = 0; j < i; ++j)
            rho(i, j) = rho(j, i) = modal_correlation(frequency[i], frequency[j], ratio);
    return rho;
}

double combined_product(const Eigen::VectorXd& a, const Eigen::VectorXd& b, const Eigen::MatrixXd& correlation)
{
    return a.dot(correlation * b);
}

double combined_peak(const Eigen::VectorXd& modal, const Eigen::MatrixXd& correlation)
{
    return std::sqrt(std::max(0.0, combined_product(modal, modal, correlation)));
}

} // namespace damslip::fe2d
