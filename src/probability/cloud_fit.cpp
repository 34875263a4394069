#include "probability/cloud_fit.hpp"

#include "core/text.hpp"
#include "probability/distribution.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace damslip::probability {

namespace {

/// Truncated normal regression of y = ln(D / d_0) > 0 on x (Cragg 1971), in A = a / sigma, B = b / sigma, g = 1 / sigma:
/// sum ln g - (g y - A - B x)^2 / 2 - ln Phi(A + B x).
struct TruncatedState {
    double value = 0.0;
    Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
    Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
};

TruncatedState truncated_state(std::span<const double> x, std::span<const double> y, const Eigen::Vector3d& c)
{
    TruncatedState s;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double t = c(0) + c(1) * x[i], r = c(2) * y[i] - t, ratio = mills(t), k = ratio * (ratio + t);
        const Eigen::Vector3d dt(1.0, x[i], 0.0), dr(-1.0, -x[i], y[i]), dg(0.0, 0.0, 1.0);
        s.value += std::log(c(2)) - 0.5 * r * r - log_normal_cdf(t);
        s.gradient += dg / c(2) - r * dr - ratio * dt;
        s.second += k * dt * dt.transpose() - dr * dr.transpose() - dg * dg.transpose() / (c(2) * c(2));
    }
    return s;
}

/// P of one binary part over ln x: likelihood where it has a maximum, else Firth's penalty.
BinaryFit binary_part(Link link, const std::vector<double>& x, const std::vector<double>& z, bool& penalised)
{
    const std::vector<double> n(x.size(), 1.0);
    const bool exists = likelihood_has_maximum(x, n, z);
    penalised = penalised || !exists;
    return fit_binary(link, exists ? Penalty::none : Penalty::firth, x, n, z);
}

bool any(const std::vector<double>& z)
{
    return std::any_of(z.begin(), z.end(), [](double v) { return v > 0.0; });
}

void fit_truncated(CloudFit& fit, std::vector<double> x, const std::vector<double>& y)
{
    const double n = static_cast<double>(x.size());
    double mean_x = 0.0, mean_y = 0.0, xx = 0.0, xy = 0.0, rest = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) mean_x += x[i] / n, mean_y += y[i] / n;
    for (double& v : x) v -= mean_x;
    for (std::size_t i = 0; i < x.size(); ++i) xx += x[i] * x[i], xy += x[i] * (y[i] - mean_y);
    if (x.size() < 4 || !(xx > 0.0)) {
        fit.why = fmt::format("{} records slide by more than {:.3g} mm: a curve of their slip needs four at different "
                              "intensities",
                              x.size(), 1e3 * fit.smallest_slip);
        return;
    }
    const double b = xy / xx;
    for (std::size_t i = 0; i < x.size(); ++i) rest += std::pow(y[i] - mean_y - b * x[i], 2);
    if (!(rest > 0.0)) {
        fit.why = "the slips lie on one line: they have no spread to fit";
        return;
    }
    const double g = std::sqrt(n / rest);
    Eigen::Vector3d c(mean_y * g, b * g, g);
    TruncatedState state = truncated_state(x, y, c);
    double damping = 0.0;
    while (fit.iterations < 500 && !fit.converged) { // Newton's method, damped where the likelihood is not concave
        ++fit.iterations;
        const Eigen::Matrix3d h = -state.second;
        const Eigen::Matrix3d damped = h + damping * Eigen::Matrix3d(h.diagonal().cwiseAbs().asDiagonal());
        const Eigen::LLT<Eigen::Matrix3d> factor(damped);
        const Eigen::Vector3d step = factor.solve(state.gradient);
        if (factor.info() != Eigen::Success || !step.allFinite() || !(c(2) + step(2) > 0.0)) {
            damping = std::max(1e-6, 10.0 * damping);
            if (damping > 1e12) break;
            continue;
        }
        const TruncatedState next = truncated_state(x, y, c + step);
        if (!(next.value >= state.value - 1e-13 * std::max(1.0, std::abs(state.value)))) {
            damping = std::max(1e-6, 10.0 * damping);
            if (damping > 1e12) break;
            continue;
        }
        fit.converged = damping < 1e-3 && step.dot(state.gradient) < 1e-20 * std::max(1.0, std::abs(state.value));
        c += step;
        state = next;
        damping = damping > 1e-8 ? 0.1 * damping : 0.0;
    }
    fit.sigma = 1.0 / c(2);
    fit.b = c(1) / c(2);
    fit.a = std::log(fit.smallest_slip) + c(0) / c(2) - fit.b * mean_x;
    fit.found = fit.converged;
    if (!fit.found)
        fit.why = fmt::format("the likelihood of the slips above {:.3g} mm has no maximum near: they fall off as an "
                              "exponential tail, not as a part of a normal one",
                              1e3 * fit.smallest_slip);
}

} // namespace

double CloudFit::failure_probability(double x) const
{
    const double l = std::log(x);
    return failure ? failure->probability({&l, 1}) : 0.0;
}

double CloudFit::sliding_probability(double x) const
{
    const double l = std::log(x);
    return slides ? slides->probability({&l, 1}) : 1.0;
}

double CloudFit::probability(double x, double d) const
{
    if (!(d >= smallest_slip))
        throw ParameterError("d", shortest(d),
                             fmt::format("at least {} m: no slip below it was fitted", smallest_slip));
    const double mean = a + b * std::log(x);
    const double q = std::exp(log_normal_cdf((mean - std::log(d)) / sigma) -
                              log_normal_cdf((mean - std::log(smallest_slip)) / sigma));
    const double p_failure = failure_probability(x);
    return p_failure + (1.0 - p_failure) * sliding_probability(x) * q;
}

CloudFit fit_cloud(std::span<const CloudPoint> points, double smallest_slip)
{
    if (!(smallest_slip > 0.0)) throw ParameterError("smallest slip", shortest(smallest_slip), "a length > 0");
    CloudFit fit;
    fit.smallest_slip = smallest_slip;
    std::vector<double> all_x, failed, standing_x, slides, x, y;
    for (const CloudPoint& p : points) {
        if (!(p.x > 0.0) || !std::isfinite(p.x)) throw ParameterError("x", shortest(p.x), "an intensity > 0");
        all_x.push_back(std::log(p.x));
        failed.push_back(p.failed ? 1.0 : 0.0);
        if (p.failed) continue;
        const bool sliding = p.slip > smallest_slip;
        standing_x.push_back(all_x.back());
        slides.push_back(sliding ? 1.0 : 0.0);
        if (!sliding) continue;
        x.push_back(all_x.back());
        y.push_back(std::log(p.slip / smallest_slip));
    }
    fit.sliding = x.size();
    fit.standing = standing_x.size() - x.size();
    fit.failed = points.size() - standing_x.size();
    if (any(failed)) fit.failure = binary_part(Link::logit, all_x, failed, fit.penalised);
    if (fit.standing > 0 && fit.sliding > 0) fit.slides = binary_part(Link::probit, standing_x, slides, fit.penalised);
    fit_truncated(fit, std::move(x), y);
    return fit;
}

} // namespace damslip::probability
