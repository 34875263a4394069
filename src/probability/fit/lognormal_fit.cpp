#include "probability/fit/lognormal_fit.hpp"

#include "core/number.hpp"
#include "probability/laws/distribution.hpp"
#include "probability/laws/normal.hpp"

#include <cmath>
#include <fmt/format.h>
#include <gsl/gsl_cdf.h>
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
        fit.why = fmt::format("none of {:g} runs exceeds the limit: no curve, P is below {:.3g} with 95 %", s.runs,
                              s.runs > 0.0 ? bound_of_none(s.runs) : 1.0);
        return fit;
    }
    if (s.failures == s.runs) {
        fit.why = fmt::format("all of {:g} runs exceed the limit: no curve, P is above {:.3g} with 95 %", s.runs,
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
        fit.why = "the share of failures does not rise with the intensity: no lognormal curve";
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

} // namespace damslip::probability
