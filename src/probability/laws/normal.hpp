#pragma once

/// The standard normal distribution, accurate in both tails.
namespace damslip::probability {

double normal_density(double z); ///< phi(z) = exp(-z^2/2) / sqrt(2 pi)
double normal_cdf(double z);     ///< Phi(z); relative accuracy also where it is tiny

/// ln Phi(z), finite down to z = -1e150.
double log_normal_cdf(double z);

/// phi(z) / Phi(z), the inverse Mills ratio: z -> -inf: -z, z -> inf: 0.
double mills(double z);

/// z with Phi(z) = u. u = 0 and u = 1: minus and plus infinity; outside [0, 1]: NaN.
double normal_quantile(double u);

} // namespace damslip::probability
