#include "probability/fit/capacity_fit.hpp"

#include "core/number.hpp"
#include "probability/laws/distribution.hpp"
#include "probability/laws/normal.hpp"

#include <Eigen/Core>
#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <vector>

namespace damslip::probability {

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
        fit.why = "fewer than two different levels are reached: no curve";
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

} // namespace damslip::probability
