#pragma once

#include "probability/hazard/hazard_curve.hpp"

#include <optional>
#include <span>
#include <vector>

namespace damslip::probability {

/// A part of the rate: earthquakes with intensities from x_lower to x_upper.
struct RatePart {
    double x_lower = 0.0, x_upper = 0.0;
    double rate = 0.0; ///< [1/a]
};

/// lambda = integral of P |dH| [1/a], with bounds for what lies outside.
struct AnnualRate {
    double inside = 0.0; ///< over the points of the curve (and the tested levels, of raw stripes)
    double above_lower = 0.0, above_upper = 0.0; ///< beyond the last point: P_n H_n ... H_n
    std::optional<double>
        below_upper;             ///< below the first point: 0 ... P_1 (nu - H_1); absent: nu is not known, no bound
    double p_first = 0.0;        ///< P_1, for "unbounded below, P_1 = ..."
    double lower = 0.0;          ///< inside + above_lower
    double upper = 0.0;          ///< inside + above_upper + below_upper, where there is one
    double outside_share = 0.0;  ///< of `upper` that stems from outside the tested levels [-]
    bool mostly_tested = true;   ///< outside_share <= 10 %
    std::vector<RatePart> parts; ///< of `inside`, segment by segment
};

/// Of a lognormal fragility, exact on each segment, k = -ln(H_(i+1) / H_i) / ln(x_(i+1) / x_i), z = ln(x / theta) / beta:
///     P_i H_i - P_(i+1) H_(i+1) + H_i (x_i / theta)^k e^(k^2 beta^2 / 2) [Phi(z_(i+1) + k beta) - Phi(z_i + k beta)].
/// beta = 0: H(theta).
/// @param tested_lower, tested_upper  lowest and highest intensity with runs; the part of the rate outside is told
/// @param nu  annual rate of all earthquakes the curve is made of, if known; >= H_1
/// @throws ParameterError for median not > 0, beta < 0, nu < H_1
AnnualRate annual_rate(const HazardCurve& curve, double median, double beta, double tested_lower, double tested_upper,
                       std::optional<double> nu = {});

/// Of raw stripes: P linear in ln x between them, exact with the curve's segments. Outside the stripes, or the curve, bounds with the P there.
/// @param x, p  stripes, rising x; one at least within the curve
AnnualRate annual_rate(const HazardCurve& curve, std::span<const double> x, std::span<const double> p,
                       std::optional<double> nu = {});

/// H = k_0 x^-k and a lognormal fragility: k_0 theta^-k e^(k^2 beta^2 / 2) (Kennedy & Short 1994; Cornell et al. 2002).
double kennedy_rate(double k0, double k, double median, double beta);

/// 1 - e^(-rate years), accurate for small ones.
double probability_in(double rate, double years);

} // namespace damslip::probability
