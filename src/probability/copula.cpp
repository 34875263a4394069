#include "probability/copula.hpp"

#include "core/text.hpp"
#include "probability/distribution.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <set>
#include <utility>

namespace damslip::probability {

NotPositiveDefinite::NotPositiveDefinite(double smallest)
    : std::invalid_argument(
          fmt::format("the correlations contradict one another: smallest eigenvalue {:.3g}, expected > 0", smallest)),
      smallest_(smallest)
{
}

GaussianCopula::GaussianCopula(std::size_t dimension, std::span<const RankCorrelation> correlations)
    : dimension_(dimension), independent_(correlations.empty())
{
    const Eigen::Index n = static_cast<Eigen::Index>(dimension);
    Eigen::MatrixXd r = Eigen::MatrixXd::Identity(n, n);
    std::set<std::pair<std::size_t, std::size_t>> named;
    for (const RankCorrelation& c : correlations) {
        if (!(std::abs(c.spearman) < 1.0)) throw ParameterError("spearman", shortest(c.spearman), "-1 < spearman < 1");
        if (c.first == c.second || c.first >= dimension || c.second >= dimension ||
            !named.insert(std::minmax(c.first, c.second)).second)
            throw ParameterError("between", fmt::format("{}, {}", c.first, c.second), "two variables, each pair once");
        const Eigen::Index i = static_cast<Eigen::Index>(c.first), j = static_cast<Eigen::Index>(c.second);
        r(i, j) = r(j, i) = 2.0 * std::sin(std::numbers::pi * c.spearman / 6.0);
    }
    Eigen::MatrixXd l = r;
    if (!independent_) {
        const double smallest =
            Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(r, Eigen::EigenvaluesOnly).eigenvalues()(0);
        if (!(smallest > 1e-10)) throw NotPositiveDefinite(smallest);
        l = r.llt().matrixL();
    }
    for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index j = 0; j < n; ++j) {
            r_.push_back(r(i, j));
            factor_.push_back(j > i ? 0.0 : l(i, j));
        }
}

std::vector<double> GaussianCopula::dependent(std::span<const double> u) const
{
    std::vector<double> out(u.begin(), u.end());
    if (independent_) return out;
    std::vector<double> z(u.size());
    for (std::size_t i = 0; i < dimension_; ++i) {
        z[i] = normal_quantile(u[i]);
        double y = 0.0;
        bool alone = true;
        for (std::size_t j = 0; j <= i; ++j) {
            y += factor_[i * dimension_ + j] * z[j];
            alone = alone && (j == i || factor_[i * dimension_ + j] == 0.0);
        }
        if (!alone) out[i] = normal_cdf(y); // a variable without correlation keeps its bits
    }
    return out;
}

std::vector<double> GaussianCopula::conditional(std::uint32_t given, std::span<const double> fixed,
                                                std::span<const double> u) const
{
    std::vector<double> out(u.begin(), u.end());
    std::vector<Eigen::Index> known, open;
    for (std::size_t i = 0; i < dimension_; ++i) {
        (given >> i & 1u ? known : open).push_back(static_cast<Eigen::Index>(i));
        if (given >> i & 1u) out[i] = fixed[i];
    }
    if (independent_ || open.empty()) return out;
    const Eigen::Index n = static_cast<Eigen::Index>(dimension_);
    const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> r(r_.data(), n, n);
    Eigen::VectorXd z(static_cast<Eigen::Index>(open.size())), y(static_cast<Eigen::Index>(known.size()));
    for (Eigen::Index k = 0; k < z.size(); ++k) z(k) = normal_quantile(u[static_cast<std::size_t>(open[k])]);
    for (Eigen::Index k = 0; k < y.size(); ++k) y(k) = normal_quantile(fixed[static_cast<std::size_t>(known[k])]);
    // Y_open | Y_known is normal: mean R_ok R_kk^-1 y, covariance R_oo - R_ok R_kk^-1 R_ko.
    Eigen::MatrixXd covariance = r(open, open);
    Eigen::VectorXd mean = Eigen::VectorXd::Zero(z.size());
    if (!known.empty()) {
        const Eigen::MatrixXd r_ok = r(open, known), r_kk = r(known, known);
        const Eigen::LLT<Eigen::MatrixXd> solver(r_kk);
        mean = r_ok * solver.solve(y);
        covariance -= r_ok * solver.solve(Eigen::MatrixXd(r_ok.transpose()));
    }
    const Eigen::MatrixXd l = covariance.llt().matrixL();
    const Eigen::VectorXd drawn = mean + l * z;
    for (Eigen::Index k = 0; k < z.size(); ++k) out[static_cast<std::size_t>(open[k])] = normal_cdf(drawn(k));
    return out;
}

} // namespace damslip::probability
