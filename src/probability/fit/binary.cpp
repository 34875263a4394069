#include "probability/fit/binary.hpp"

#include "probability/laws/normal.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace damslip::probability {

namespace {

/// One observation at eta: log-likelihood, its derivative, minus its second derivative, expected information w and dw / d eta.
struct LinkTerms {
    double value, score, curvature, information, information_slope;
};

LinkTerms probit_terms(double eta, double n, double z)
{
    const double up = mills(eta), down = mills(-eta); // phi / Phi(eta), phi / Phi(-eta)
    LinkTerms t{};
    if (z > 0.0) t.value += z * log_normal_cdf(eta);
    if (n > z) t.value += (n - z) * log_normal_cdf(-eta);
    t.score = z * up - (n - z) * down;
    t.curvature = z * up * (up + eta) + (n - z) * down * (down - eta);
    t.information = n * up * down;
    t.information_slope = t.information * (-2.0 * eta - up + down);
    return t;
}

LinkTerms logit_terms(double eta, double n, double z)
{
    const double p = 1.0 / (1.0 + std::exp(-eta)), q = 1.0 / (1.0 + std::exp(eta));
    LinkTerms t{};
    if (z > 0.0) t.value -= z * (eta > 0.0 ? std::log1p(std::exp(-eta)) : std::log1p(std::exp(eta)) - eta);
    if (n > z) t.value -= (n - z) * (eta > 0.0 ? eta + std::log1p(std::exp(-eta)) : std::log1p(std::exp(eta)));
    t.score = z * q - (n - z) * p;
    t.curvature = t.information = n * p * q;
    t.information_slope = t.information * (q - p);
    return t;
}

/// The design in columns of mean 0 and standard deviation 1 that are independent of one another; b = back c.
struct StandardDesign {
    Eigen::MatrixXd columns, back;
};

StandardDesign standardise(std::span<const double> x, Eigen::Index rows, Eigen::Index k)
{
    Eigen::MatrixXd kept = Eigen::MatrixXd::Ones(rows, 1), orthogonal = kept / std::sqrt(static_cast<double>(rows));
    std::vector<std::pair<double, double>> scale; // mean, standard deviation
    std::vector<Eigen::Index> which;
    for (Eigen::Index j = 0; j < k; ++j) {
        Eigen::VectorXd column(rows);
        for (Eigen::Index i = 0; i < rows; ++i) column(i) = x[static_cast<std::size_t>(i * k + j)];
        const double mean = column.mean();
        const double size = column.cwiseAbs().maxCoeff();
        column.array() -= mean;
        const double deviation = column.norm() / std::sqrt(static_cast<double>(rows));
        if (!(deviation > 1e-12 * size)) continue;
        column /= deviation;
        Eigen::VectorXd rest = column;
        for (int pass = 0; pass < 2; ++pass) rest -= orthogonal * (orthogonal.transpose() * rest);
        if (rest.norm() < 1e-9 * column.norm()) continue;
        kept.conservativeResize(Eigen::NoChange, kept.cols() + 1);
        kept.col(kept.cols() - 1) = column;
        orthogonal.conservativeResize(Eigen::NoChange, orthogonal.cols() + 1);
        orthogonal.col(orthogonal.cols() - 1) = rest.normalized();
        scale.emplace_back(mean, deviation);
        which.push_back(j);
    }
    Eigen::MatrixXd back = Eigen::MatrixXd::Zero(k + 1, kept.cols());
    back(0, 0) = 1.0;
    for (std::size_t c = 0; c < which.size(); ++c) {
        const Eigen::Index column = static_cast<Eigen::Index>(c) + 1;
        back(which[c] + 1, column) = 1.0 / scale[c].second;
        back(0, column) = -scale[c].first / scale[c].second;
    }
    return {kept, back};
}

/// Likelihood, its gradient and matrices at one c.
struct BinaryState {
    double value = -std::numeric_limits<double>::infinity(), likelihood = 0.0;
    Eigen::VectorXd gradient;
    Eigen::MatrixXd curvature, information;
};

BinaryState binary_state(Link link, Penalty penalty, const Eigen::MatrixXd& x, std::span<const double> n,
                         std::span<const double> z, const Eigen::VectorXd& c)
{
    BinaryState s;
    s.gradient = Eigen::VectorXd::Zero(x.cols());
    s.curvature = s.information = Eigen::MatrixXd::Zero(x.cols(), x.cols());
    const Eigen::VectorXd eta = x * c;
    Eigen::VectorXd slope(x.rows());
    for (Eigen::Index i = 0; i < x.rows(); ++i) {
        const std::size_t k = static_cast<std::size_t>(i);
        const LinkTerms t = link == Link::probit ? probit_terms(eta(i), n[k], z[k]) : logit_terms(eta(i), n[k], z[k]);
        s.likelihood += t.value;
        s.gradient += t.score * x.row(i).transpose();
        s.curvature += t.curvature * x.row(i).transpose() * x.row(i);
        s.information += t.information * x.row(i).transpose() * x.row(i);
        slope(i) = t.information_slope;
    }
    s.value = s.likelihood;
    if (penalty == Penalty::firth) { // + ln det I / 2; its derivative is half the sum of w' times the leverages
        const Eigen::LLT<Eigen::MatrixXd> factor(s.information);
        if (factor.info() != Eigen::Success) return BinaryState{};
        s.value += factor.matrixLLT().diagonal().array().log().sum();
        const Eigen::MatrixXd inverse = factor.solve(Eigen::MatrixXd::Identity(x.cols(), x.cols()));
        for (Eigen::Index i = 0; i < x.rows(); ++i)
            s.gradient += 0.5 * slope(i) * (x.row(i) * inverse * x.row(i).transpose()).value() * x.row(i).transpose();
        s.curvature = s.information;
    }
    return s;
}

/// Minus the second derivative of the penalised likelihood, by central differences of its gradient; `otherwise` where that is not positive
/// definite.
Eigen::MatrixXd penalised_curvature(Link link, const Eigen::MatrixXd& x, std::span<const double> n,
                                    std::span<const double> z, const Eigen::VectorXd& c,
                                    const Eigen::MatrixXd& otherwise)
{
    Eigen::MatrixXd h(c.size(), c.size());
    for (Eigen::Index k = 0; k < c.size(); ++k) {
        const double width = 1e-5 * std::max(1.0, std::abs(c(k)));
        Eigen::VectorXd up = c, down = c;
        up(k) += width;
        down(k) -= width;
        const BinaryState above = binary_state(link, Penalty::firth, x, n, z, up);
        const BinaryState below = binary_state(link, Penalty::firth, x, n, z, down);
        if (above.gradient.size() == 0 || below.gradient.size() == 0) return otherwise;
        h.col(k) = (below.gradient - above.gradient) / (2.0 * width);
    }
    h = (0.5 * (h + h.transpose())).eval();
    return Eigen::LLT<Eigen::MatrixXd>(h).info() == Eigen::Success ? h : otherwise;
}

} // namespace

double BinaryFit::eta(std::span<const double> x) const
{
    double sum = coefficients[0];
    for (std::size_t k = 0; k < x.size(); ++k) sum += coefficients[k + 1] * x[k];
    return sum;
}

double BinaryFit::probability(std::span<const double> x) const
{
    const double e = eta(x);
    return link == Link::probit ? normal_cdf(e) : 1.0 / (1.0 + std::exp(-e));
}

BinaryFit fit_binary(Link link, Penalty penalty, std::span<const double> x, std::span<const double> n,
                     std::span<const double> z)
{
    BinaryFit fit;
    fit.link = link;
    const Eigen::Index rows = static_cast<Eigen::Index>(n.size());
    const Eigen::Index k = static_cast<Eigen::Index>(x.size() / n.size());
    const StandardDesign design = standardise(x, rows, k);
    double all = 0.0, failed = 0.0;
    for (std::size_t i = 0; i < n.size(); ++i) all += n[i], failed += z[i];
    const double share = (failed + 0.5) / (all + 1.0);
    Eigen::VectorXd c = Eigen::VectorXd::Zero(design.columns.cols());
    c(0) = link == Link::probit ? normal_quantile(share) : std::log(share / (1.0 - share));
    BinaryState state = binary_state(link, penalty, design.columns, n, z, c);
    constexpr int most_iterations = 200, scoring_iterations = 8;
    constexpr double most_change = 4.0;
    while (fit.iterations < most_iterations && !fit.converged) {
        ++fit.iterations;
        // The expected information stands for the curvature of the penalty, too; where that is slow, the curvature itself.
        if (penalty == Penalty::firth && fit.iterations > scoring_iterations)
            state.curvature = penalised_curvature(link, design.columns, n, z, c, state.information);
        Eigen::VectorXd step = state.curvature.ldlt().solve(state.gradient);
        const double change =
            (design.columns * step).cwiseAbs().maxCoeff(); // of eta; where nearly nothing is known, steps are huge
        if (change > most_change) step *= most_change / change;
        const double decrement = step.dot(state.gradient), scale = std::max(1.0, std::abs(state.value));
        if (!std::isfinite(decrement)) break;
        fit.converged = decrement < 1e-20 * scale;
        double length = 1.0;
        BinaryState next = binary_state(link, penalty, design.columns, n, z, c + step);
        while (!(next.value >= state.value - 1e-13 * scale) && length > 1e-6) {
            length *= 0.5;
            next = binary_state(link, penalty, design.columns, n, z, c + length * step);
        }
        if (length <= 1e-6) { // no step rises: the maximum, to round-off, or none found
            fit.converged = decrement < 1e-12 * scale;
            break;
        }
        c += length * step;
        state = std::move(next);
    }
    const Eigen::VectorXd b = design.back * c;
    const Eigen::MatrixXd covariance = design.back * state.information.inverse() * design.back.transpose();
    fit.coefficients.assign(b.begin(), b.end());
    for (Eigen::Index i = 0; i <= k; ++i)
        for (Eigen::Index j = 0; j <= k; ++j) fit.covariance.push_back(covariance(i, j));
    fit.log_likelihood = state.likelihood;
    return fit;
}

bool likelihood_has_maximum(std::span<const double> x, std::span<const double> n, std::span<const double> z)
{
    constexpr double none = std::numeric_limits<double>::infinity();
    double lowest_failure = none, highest_failure = -none, lowest_survival = none, highest_survival = -none;
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (z[i] > 0.0)
            lowest_failure = std::min(lowest_failure, x[i]), highest_failure = std::max(highest_failure, x[i]);
        if (z[i] < n[i])
            lowest_survival = std::min(lowest_survival, x[i]), highest_survival = std::max(highest_survival, x[i]);
    }
    return lowest_failure < highest_survival && lowest_survival < highest_failure;
}

} // namespace damslip::probability
