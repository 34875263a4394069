#include "probability/laws/normal.hpp"

#include <cmath>
#include <gsl/gsl_cdf.h>
#include <limits>
#include <numbers>

namespace damslip::probability {

namespace {

/// phi(z) / (1 - Phi(z)) for z >= 5 by Laplace's continued fraction z + 1/(z + 2/(z + 3/(z + ...))); 60 terms are exact to round-off.
double upper_mills(double z)
{
    double tail = z;
    for (int k = 60; k > 0; --k) tail = z + k / tail;
    return tail;
}

} // namespace

double normal_density(double z)
{
    return std::exp(-0.5 * z * z) * (0.5 * std::numbers::sqrt2 * std::numbers::inv_sqrtpi);
}

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
