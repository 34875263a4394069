#include "probability/distribution.hpp"

#include "core/text.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gsl/gsl_cdf.h>
#include <limits>
#include <numbers>
#include <utility>

namespace damslip::probability {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

double above_zero(const char* name, double value)
{
    if (!(value > 0.0) || !std::isfinite(value)) throw ParameterError(name, shortest(value), "a number > 0");
    return value;
}

double finite(const char* name, double value)
{
    if (!std::isfinite(value)) throw ParameterError(name, shortest(value), "a number");
    return value;
}

void check_order(const char* low, double a, const char* high, double b)
{
    finite(low, a);
    finite(high, b);
    if (!(a < b)) throw ParameterError(high, shortest(b), fmt::format("more than {} = {}", low, shortest(a)));
}

/// The point of [low, high] where the rising function f reaches 0, to the last bits: halving, as the incomplete beta function's inverse of
/// libraries is not reliable for small a and b.
template <class Function>
double root_of_rising(Function&& f, double low, double high)
{
    for (int k = 0; k < 200; ++k) {
        const double mid = low + 0.5 * (high - low);
        if (mid <= low || mid >= high) break;
        (f(mid) < 0.0 ? low : high) = mid;
    }
    return high;
}

} // namespace

ParameterError::ParameterError(std::string parameter, std::string value, std::string expected)
    : std::invalid_argument(fmt::format("{} = {} is not allowed; expected: {}", parameter, value, expected)),
      parameter_(std::move(parameter)), value_(std::move(value)), expected_(std::move(expected))
{
}

Distribution::Distribution(Law law) : law_(std::move(law)), min_(-infinite), max_(infinite)
{
    if (const auto* u = std::get_if<Uniform>(&law_)) min_ = u->min, max_ = u->max;
    if (const auto* t = std::get_if<Triangular>(&law_)) min_ = t->min, max_ = t->max;
    if (const auto* b = std::get_if<Beta>(&law_)) min_ = b->min, max_ = b->max;
    if (std::get_if<Lognormal>(&law_)) min_ = 0.0;
    if (const auto* d = std::get_if<Discrete>(&law_)) min_ = 0.0, max_ = static_cast<double>(d->below.size() - 1);
}

Distribution Distribution::lognormal(double median, double beta)
{
    return Distribution(Lognormal{std::log(above_zero("median", median)), above_zero("beta", beta)});
}

Distribution Distribution::lognormal_of_mean(double mean, double cov)
{
    above_zero("mean", mean);
    const double variance = std::log1p(above_zero("cov", cov) * cov);
    return Distribution(Lognormal{std::log(mean) - 0.5 * variance, std::sqrt(variance)});
}

Distribution Distribution::normal(double mean, double sd)
{
    return Distribution(Normal{finite("mean", mean), above_zero("sd", sd)});
}

Distribution Distribution::uniform(double min, double max)
{
    check_order("min", min, "max", max);
    return Distribution(Uniform{min, max});
}

Distribution Distribution::triangular(double min, double mode, double max)
{
    check_order("min", min, "max", max);
    if (!(mode >= min && mode <= max))
        throw ParameterError("mode", shortest(mode), fmt::format("min = {} to max = {}", shortest(min), shortest(max)));
    return Distribution(Triangular{min, mode, max});
}

Distribution Distribution::beta(double a, double b, double min, double max)
{
    above_zero("a", a);
    above_zero("b", b);
    check_order("min", min, "max", max);
    return Distribution(Beta{a, b, min, max});
}

Distribution Distribution::discrete(std::vector<double> weights)
{
    if (weights.empty()) throw ParameterError("weights", "[]", "a number > 0 for each value");
    double sum = 0.0;
    for (const double w : weights) sum += above_zero("weights", w);
    double below = 0.0;
    for (double& w : weights) w = (below += w) / sum;
    weights.back() = 1.0;
    return Distribution(Discrete{std::move(weights)});
}

Distribution Distribution::truncated(double min, double max) const
{
    if (is_discrete()) throw ParameterError("min, max", "given", "no bounds of a discrete variable");
    if (std::isnan(min) || std::isnan(max) || !(min < max))
        throw ParameterError("max", shortest(max), fmt::format("more than min = {}", shortest(min)));
    Distribution part = *this;
    part.min_ = std::max(min, min_);
    part.max_ = std::min(max, max_);
    if (part.min_ < part.max_) {
        part.from_above_ = whole_cdf(part.min_) > 0.5;
        part.below_ = whole_cdf(part.min_);
        part.above_ = whole_upper(part.max_);
        part.share_ = part.from_above_ ? whole_upper(part.min_) - part.above_ : whole_cdf(part.max_) - part.below_;
    } else {
        part.share_ = 0.0;
    }
    if (!(part.share_ > 0.0))
        throw ParameterError("min, max", fmt::format("{}, {}", shortest(min), shortest(max)),
                             "bounds with some probability between them");
    return part;
}

double Distribution::whole_cdf(double x) const
{
    struct {
        double x;
        double operator()(const Lognormal& l) const
        {
            return x > 0.0 ? normal_cdf((std::log(x) - l.log_median) / l.beta) : 0.0;
        }
        double operator()(const Normal& n) const { return normal_cdf((x - n.mean) / n.sd); }
        double operator()(const Uniform& u) const { return std::clamp((x - u.min) / (u.max - u.min), 0.0, 1.0); }
        double operator()(const Triangular& t) const
        {
            if (x <= t.min) return 0.0;
            if (x >= t.max) return 1.0;
            const double width = t.max - t.min;
            if (x <= t.mode) return (x - t.min) * (x - t.min) / (width * (t.mode - t.min));
            return 1.0 - (t.max - x) * (t.max - x) / (width * (t.max - t.mode));
        }
        double operator()(const Beta& b) const
        {
            return gsl_cdf_beta_P(std::clamp((x - b.min) / (b.max - b.min), 0.0, 1.0), b.a, b.b);
        }
        double operator()(const Discrete& d) const
        {
            if (!(x >= 0.0)) return 0.0;
            return d.below[std::min(d.below.size() - 1, static_cast<std::size_t>(std::min(x, 1e9)))];
        }
    } const at{x};
    return std::visit(at, law_);
}

double Distribution::whole_upper(double x) const
{
    if (const auto* l = std::get_if<Lognormal>(&law_))
        return x > 0.0 ? normal_cdf((l->log_median - std::log(x)) / l->beta) : 1.0;
    if (const auto* n = std::get_if<Normal>(&law_)) return normal_cdf((n->mean - x) / n->sd);
    if (const auto* t = std::get_if<Triangular>(&law_); t && x > t->mode && x < t->max)
        return (t->max - x) * (t->max - x) / ((t->max - t->min) * (t->max - t->mode));
    if (const auto* b = std::get_if<Beta>(&law_))
        return gsl_cdf_beta_Q(std::clamp((x - b->min) / (b->max - b->min), 0.0, 1.0), b->a, b->b);
    return 1.0 - whole_cdf(x);
}

double Distribution::whole_quantile(double u) const
{
    struct {
        double u;
        double operator()(const Lognormal& l) const { return std::exp(l.log_median + l.beta * normal_quantile(u)); }
        double operator()(const Normal& n) const { return n.mean + n.sd * normal_quantile(u); }
        double operator()(const Uniform& d) const { return d.min + u * (d.max - d.min); }
        double operator()(const Triangular& t) const
        {
            const double width = t.max - t.min;
            if (u * width <= t.mode - t.min) return t.min + std::sqrt(u * width * (t.mode - t.min));
            return t.max - std::sqrt((1.0 - u) * width * (t.max - t.mode));
        }
        double operator()(const Beta& b) const
        {
            const double y = root_of_rising([&](double t) { return gsl_cdf_beta_P(t, b.a, b.b) - u; }, 0.0, 1.0);
            return b.min + y * (b.max - b.min);
        }
        double operator()(const Discrete& d) const
        {
            return static_cast<double>(std::lower_bound(d.below.begin(), d.below.end() - 1, u) - d.below.begin());
        }
    } const at{u};
    return std::visit(at, law_);
}

double Distribution::whole_upper_quantile(double v) const
{
    if (const auto* l = std::get_if<Lognormal>(&law_)) return std::exp(l->log_median - l->beta * normal_quantile(v));
    if (const auto* n = std::get_if<Normal>(&law_)) return n->mean - n->sd * normal_quantile(v);
    if (const auto* t = std::get_if<Triangular>(&law_); t && v * (t->max - t->min) < t->max - t->mode)
        return t->max - std::sqrt(v * (t->max - t->min) * (t->max - t->mode));
    if (const auto* b = std::get_if<Beta>(&law_))
        return b->min + root_of_rising([&](double t) { return v - gsl_cdf_beta_Q(t, b->a, b->b); }, 0.0, 1.0) *
                            (b->max - b->min);
    return whole_quantile(1.0 - v);
}

double Distribution::cdf(double x) const
{
    if (x < min_) return 0.0;
    if (x >= max_) return 1.0;
    return from_above_ ? 1.0 - (whole_upper(x) - above_) / share_ : (whole_cdf(x) - below_) / share_;
}

double Distribution::quantile(double u) const
{
    if (!(u > 0.0)) return min_;
    if (u >= 1.0) return max_;
    const double x =
        from_above_ ? whole_upper_quantile(above_ + (1.0 - u) * share_) : whole_quantile(below_ + u * share_);
    return std::clamp(x, min_, max_);
}

namespace {

/// phi(z) = exp(-z^2/2) / sqrt(2 pi)
double normal_density(double z)
{
    return std::exp(-0.5 * z * z) * (0.5 * std::numbers::sqrt2 * std::numbers::inv_sqrtpi);
}

/// phi(z) / (1 - Phi(z)) for z >= 5 by Laplace's continued fraction z + 1/(z + 2/(z + 3/(z + ...))); 60 terms are exact to round-off.
double upper_mills(double z)
{
    double tail = z;
    for (int k = 60; k > 0; --k) tail = z + k / tail;
    return tail;
}

} // namespace

double normal_cdf(double z)
{
    return 0.5 * std::erfc(-z / std::numbers::sqrt2);
}

double log_normal_cdf(double z)
{
    if (z > 5.0) return std::log1p(-normal_cdf(-z));
    if (z > -5.0) return std::log(normal_cdf(z));
    return -0.5 * z * z - 0.5 * std::log(2.0 * std::numbers::pi) - std::log(upper_mills(-z));
}

double mills(double z)
{
    return z > -5.0 ? normal_density(z) / normal_cdf(z) : upper_mills(-z);
}

double normal_quantile(double u)
{
    if (!(u >= 0.0 && u <= 1.0)) return std::numeric_limits<double>::quiet_NaN();
    if (u == 0.0) return -std::numeric_limits<double>::infinity();
    if (u == 1.0) return std::numeric_limits<double>::infinity();
    return gsl_cdf_ugaussian_Pinv(u);
}

} // namespace damslip::probability
