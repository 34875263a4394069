#pragma once

#include "probability/fit/binary.hpp"
#include "probability/fit/interval.hpp"

#include <span>
#include <string>

namespace damslip::probability {

/// Fragility P(D > d | x) = Phi(ln(x / median) / beta).
struct LognormalCurve {
    double median = 1.0; ///< theta, unit of the intensity
    double beta = 0.4;   ///< standard deviation of ln x at failure, > 0; 0: a step at the median
    double probability(double x) const;
    double level(double p) const; ///< x with that probability
};

/// What one stripe gave. Real numbers are allowed (weighted runs, expected counts).
struct StripeCount {
    double x = 0.0; ///< intensity, > 0
    double n = 0.0; ///< runs with an answer
    double z = 0.0; ///< those with D > d
};

enum class FitMethod {
    likelihood, ///< maximum likelihood (Baker 2015)
    firth,      ///< penalised: the likelihood has no maximum for these counts
    none        ///< no lognormal curve; `why` says it
};

struct LognormalFit {
    FitMethod method = FitMethod::none;
    std::string why;                                ///< of firth and none, a sentence
    LognormalCurve curve;                           ///< of likelihood and firth
    double b0 = 0.0, b1 = 0.0;                      ///< Phi(b0 + b1 ln x): median = e^(-b0/b1), beta = 1 / b1
    double var_b0 = 0.0, cov_b = 0.0, var_b1 = 0.0; ///< inverse of the expected information
    int iterations = 0;
    double deviance = 0.0;   ///< 2 sum z ln(z / np) + (n - z) ln((n - z) / (n (1 - p)))
    int degrees = 0;         ///< levels - 2
    double deviance_p = 1.0; ///< P(chi^2 > deviance); 1 without degrees of freedom
    bool lognormal() const { return method != FitMethod::none && deviance_p >= 0.01; } ///< else the raw curve is shown

    /// Pointwise interval of the curve: Phi(eta +- k sqrt(var eta)). Of independent runs; clusters: bootstrap fit_lognormal.
    Interval interval(double x, double confidence = 0.95) const;
};

/// The likelihood has a maximum with b1 > 0 only where the lowest level with a failure lies below the highest with a survival (and the lowest
/// with a survival below the highest with a failure). Else Firth's penalty; none: all survive, all fail, one level, or a curve that falls.
/// @throws ParameterError for x <= 0, n < 0, z outside 0 ... n
LognormalFit fit_lognormal(std::span<const StripeCount> stripes);

} // namespace damslip::probability
