#include "probability/fit.hpp"

#include "core/statistics.hpp"
#include "core/text.hpp"
#include "probability/distribution.hpp"
#include "probability/sampling.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gsl/gsl_cdf.h>
#include <limits>
#include <utility>
#include <vector>

namespace damslip::probability {

namespace {

/// a ln(a / b), 0 at a = 0.
double deviance_term(double a, double b)
{
    return a > 0.0 ? a * std::log(a / b) : 0.0;
}

struct FragilityStripes {
    std::vector<double> log_x, n, z;
    double runs = 0.0, failures = 0.0;
    bool several_levels = false;
};

FragilityStripes checked(std::span<const StripeCount> stripes)
{
    FragilityStripes s;
    for (const StripeCount& c : stripes) {
        if (!(c.x > 0.0) || !std::isfinite(c.x)) throw ParameterError("x", shortest(c.x), "an intensity > 0");
        if (!(c.n >= 0.0) || !std::isfinite(c.n)) throw ParameterError("n", shortest(c.n), "a number of runs");
        if (!(c.z >= 0.0 && c.z <= c.n)) throw ParameterError("z", shortest(c.z), fmt::format("0 to n = {:g}", c.n));
        if (c.n == 0.0) continue;
        s.log_x.push_back(std::log(c.x));
        s.n.push_back(c.n);
        s.z.push_back(c.z);
        s.runs += c.n;
        s.failures += c.z;
        s.several_levels = s.several_levels || s.log_x.back() != s.log_x.front();
    }
    return s;
}

} // namespace

double LognormalCurve::probability(double x) const
{
    if (!(x > 0.0)) return 0.0;
    if (beta == 0.0) return x >= median ? 1.0 : 0.0;
    return normal_cdf(std::log(x / median) / beta);
}

double LognormalCurve::level(double p) const
{
    return median * std::exp(beta * normal_quantile(p));
}

Interval LognormalFit::interval(double x, double confidence) const
{
    const double l = std::log(x), k = normal_quantile(0.5 + 0.5 * confidence);
    const double eta = b0 + b1 * l, deviation = k * std::sqrt(std::max(0.0, var_b0 + 2.0 * cov_b * l + var_b1 * l * l));
    return {normal_cdf(eta - deviation), normal_cdf(eta + deviation)};
}

LognormalFit fit_lognormal(std::span<const StripeCount> stripes)
{
    LognormalFit fit;
    const FragilityStripes s = checked(stripes);
    if (s.failures == 0.0) {
        fit.why = fmt::format("none of {:g} runs exceeds the limit: P is below {:.3g} with 95 %", s.runs,
                              s.runs > 0.0 ? bound_of_none(s.runs) : 1.0);
        return fit;
    }
    if (s.failures == s.runs) {
        fit.why = fmt::format("all of {:g} runs exceed the limit: P is above {:.3g} with 95 %", s.runs,
                              1.0 - bound_of_none(s.runs));
        return fit;
    }
    if (!s.several_levels) {
        fit.why = "all runs are at one level: a curve needs two";
        return fit;
    }
    const bool exists = likelihood_has_maximum(s.log_x, s.n, s.z);
    const BinaryFit b = fit_binary(Link::probit, exists ? Penalty::none : Penalty::firth, s.log_x, s.n, s.z);
    fit.b0 = b.coefficients[0];
    fit.b1 = b.coefficients[1];
    fit.var_b0 = b.covariance[0];
    fit.cov_b = b.covariance[1];
    fit.var_b1 = b.covariance[3];
    fit.iterations = b.iterations;
    if (!b.converged) {
        fit.why = fmt::format("the likelihood did not converge within {} steps", b.iterations);
        return fit;
    }
    // Equal shares leave a slope of round-off, of either sign; a median beyond all numbers is none either.
    const double median = std::exp(-fit.b0 / fit.b1);
    if (!(fit.b1 > 1e-6 * std::sqrt(fit.var_b1)) || !(median > 0.0) || !std::isfinite(median)) {
        fit.why = "the share of failures does not rise with the intensity";
        return fit;
    }
    fit.method = exists ? FitMethod::likelihood : FitMethod::firth;
    if (!exists)
        fit.why = "the lowest level with a failure is not below the highest with a survival: the likelihood has no "
                  "maximum, Firth's penalty is added";
    fit.curve = {median, 1.0 / fit.b1};
    for (std::size_t i = 0; i < s.n.size(); ++i) {
        const double eta = fit.b0 + fit.b1 * s.log_x[i];
        fit.deviance += 2.0 * (deviance_term(s.z[i], s.n[i] * normal_cdf(eta)) +
                               deviance_term(s.n[i] - s.z[i], s.n[i] * normal_cdf(-eta)));
    }
    fit.degrees = static_cast<int>(s.n.size()) - 2;
    if (fit.degrees > 0) fit.deviance_p = gsl_cdf_chisq_Q(std::max(0.0, fit.deviance), fit.degrees);
    return fit;
}

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

namespace {

/// ln likelihood of g = 1 / beta and m = ln(theta) / beta (Olsen 1978), with gradient and second derivatives.
struct CapacityState {
    double value = 0.0;
    Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
    Eigen::Matrix2d second = Eigen::Matrix2d::Zero();
};

CapacityState capacity_state(std::span<const double> reached, std::span<const double> censored, double g, double m)
{
    CapacityState s;
    for (const double y : reached) {
        const double r = g * y - m;
        s.value += std::log(g) - 0.5 * r * r;
        s.gradient += Eigen::Vector2d(1.0 / g - r * y, r);
        s.second -= Eigen::Matrix2d{{1.0 / (g * g) + y * y, -y}, {-y, 1.0}};
    }
    for (const double y : censored) {
        const double t = m - g * y, ratio = mills(t), k = ratio * (ratio + t);
        s.value += log_normal_cdf(t);
        s.gradient += ratio * Eigen::Vector2d(-y, 1.0);
        s.second -= k * Eigen::Matrix2d{{y * y, -y}, {-y, 1.0}};
    }
    return s;
}

std::vector<double> logarithms(std::span<const double> levels)
{
    std::vector<double> y;
    for (const double x : levels) {
        if (!(x > 0.0) || !std::isfinite(x)) throw ParameterError("x", shortest(x), "an intensity > 0");
        y.push_back(std::log(x));
    }
    return y;
}

} // namespace

CapacityFit fit_capacities(std::span<const double> reached, std::span<const double> censored_at)
{
    CapacityFit fit;
    fit.reached = reached.size();
    fit.censored = censored_at.size();
    std::vector<double> y = logarithms(reached), c = logarithms(censored_at);
    double mean = 0.0, square = 0.0;
    for (const double v : y) mean += v / static_cast<double>(y.size());
    for (double& v : y) square += (v - mean) * (v - mean), v -= mean;
    for (double& v : c) v -= mean;
    if (y.size() < 2 || !(square > 0.0)) {
        fit.why = "fewer than two different levels are reached";
        return fit;
    }
    const double n = static_cast<double>(y.size());
    if (c.empty()) {
        fit.curve = {std::exp(mean), std::sqrt(square / (n - 1.0))};
        fit.se_log_median = fit.curve.beta / std::sqrt(n);
        fit.se_beta = fit.curve.beta / std::sqrt(2.0 * (n - 1.0));
        fit.found = true;
        return fit;
    }
    double g = std::sqrt(n / square), m = 0.0;
    CapacityState state = capacity_state(y, c, g, m);
    while (fit.iterations < 100) {
        ++fit.iterations;
        const Eigen::Vector2d step = (-state.second).inverse() * state.gradient;
        const double decrement = step.dot(state.gradient), scale = std::max(1.0, std::abs(state.value));
        double length = 1.0;
        while (g + length * step(0) <= 0.0) length *= 0.5;
        CapacityState next = capacity_state(y, c, g + length * step(0), m + length * step(1));
        while (!(next.value >= state.value - 1e-13 * scale) && length > 1e-9) {
            length *= 0.5;
            next = capacity_state(y, c, g + length * step(0), m + length * step(1));
        }
        g += length * step(0);
        m += length * step(1);
        state = next;
        fit.found = decrement < 1e-20 * scale || (length <= 1e-9 && decrement < 1e-12 * scale);
        if (fit.found || length <= 1e-9) break;
    }
    if (!fit.found) fit.why = "the likelihood of the censored capacities did not converge within 100 steps";
    fit.curve = {std::exp(mean + m / g), 1.0 / g};
    const Eigen::Matrix2d covariance = (-state.second).inverse();
    const Eigen::Vector2d of_median(-m / (g * g), 1.0 / g);
    fit.se_log_median = std::sqrt(of_median.dot(covariance * of_median));
    fit.se_beta = std::sqrt(covariance(0, 0)) / (g * g);
    return fit;
}

namespace {

/// Wilson's interval with a quantile k that is not that of the normal distribution.
Interval wilson_by_quantile(double z, double n, double k)
{
    const double p = z / n, s = k * k / n;
    const double centre = (p + 0.5 * s) / (1.0 + s), half = k / (1.0 + s) * std::sqrt(p * (1.0 - p) / n + 0.25 * s / n);
    return {z <= 0.0 ? 0.0 : std::max(0.0, centre - half), z >= n ? 1.0 : std::min(1.0, centre + half)};
}

} // namespace

Interval wilson(double z, double n, double confidence)
{
    return wilson_by_quantile(z, n, normal_quantile(0.5 + 0.5 * confidence));
}

Interval wilson_of_estimate(double p, double se, double n, double degrees, double confidence)
{
    const double inner = std::clamp(p, 0.5 / n, 1.0 - 0.5 / n); // p (1 - p) of a number of trials is 0 beyond the ends
    const double most = 20.0 * n;
    const double trials = se > 0.0 ? std::min(most, inner * (1.0 - inner) / (se * se)) : most;
    return wilson_by_quantile(std::clamp(p, 0.0, 1.0) * trials, trials,
                              gsl_cdf_tdist_Pinv(0.5 + 0.5 * confidence, degrees));
}

double bound_of_none(double n, double confidence)
{
    return -std::expm1(std::log1p(-confidence) / n);
}

ClusterInterval cluster_bootstrap(std::size_t clusters,
                                  const std::function<double(std::span<const std::uint32_t>)>& statistic,
                                  std::uint64_t seed, double confidence, std::uint32_t draws)
{
    ClusterInterval interval;
    interval.clusters = clusters;
    interval.few = clusters < 10;
    if (clusters < 2) return interval; // one cluster says nothing of the others: 0 ... 1
    const Stream stream(seed, "bootstrap of clusters");
    const std::uint32_t count = static_cast<std::uint32_t>(clusters);
    std::vector<std::uint32_t> multiplicity(clusters, 1u);
    const double whole = statistic(multiplicity);
    const double stretch = std::sqrt(static_cast<double>(clusters) / static_cast<double>(clusters - 1));
    std::vector<double> values;
    for (std::uint32_t d = 0; d < draws; ++d) {
        std::fill(multiplicity.begin(), multiplicity.end(), 0u);
        for (std::uint32_t k = 0; k < count; ++k) ++multiplicity[stream.below(count, k, d)];
        const double value = statistic(multiplicity);
        if (std::isfinite(value)) values.push_back(whole + stretch * (value - whole));
    }
    interval.lower = percentile(values, 0.5 - 0.5 * confidence);
    interval.upper = percentile(values, 0.5 + 0.5 * confidence);
    return interval;
}

EpistemicBands epistemic_bands(std::span<const double> p_hat, std::span<const double> inner)
{
    if (p_hat.size() < 2) throw ParameterError("draws", fmt::format("{}", p_hat.size()), "2 epistemic draws at least");
    if (p_hat.size() != inner.size())
        throw ParameterError("inner", fmt::format("{}", inner.size()), fmt::format("{} numbers", p_hat.size()));
    EpistemicBands bands;
    const double n = static_cast<double>(p_hat.size());
    for (const double p : p_hat) bands.mean += p / n;
    double spread = 0.0, noise = 0.0;
    for (std::size_t e = 0; e < p_hat.size(); ++e) {
        if (inner[e] == 1.0) throw ParameterError("inner", "1", "0 (exact), or 2 samples at least");
        spread += std::pow(p_hat[e] - bands.mean, 2) / (n - 1.0);
        if (inner[e] > 0.0) noise += p_hat[e] * (1.0 - p_hat[e]) / (inner[e] - 1.0) / n;
    }
    bands.variance = std::max(0.0, spread - noise);
    bands.noise_share = spread > 0.0 ? std::min(1.0, noise / spread) : 0.0;
    bands.add_inner = bands.noise_share > 0.2;
    const std::vector<double> values(p_hat.begin(), p_hat.end());
    for (std::size_t k = 0; k < band_levels.size(); ++k) bands.percentiles[k] = percentile(values, band_levels[k]);
    return bands;
}

} // namespace damslip::probability
