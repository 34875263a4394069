#pragma once

#include "probability/fit.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace damslip::probability {

/// One unscaled record.
struct CloudPoint {
    double x = 0.0;      ///< intensity, > 0
    double slip = 0.0;   ///< D [m]; not used of what failed
    bool failed = false; ///< static failure, or still sliding beyond every limit
};

/// P(D > d | x) = P_c + (1 - P_c) pi(x) Q(x, d):
///     P_c  failure without end: logit in ln x
///     pi   P(D > d_0), probit in ln x, of those that did not fail
///     Q    Phi((a + b ln x - ln d) / sigma) / Phi((a + b ln x - ln d_0) / sigma), ln D = a + b ln x + sigma e fitted on D > d_0 as a normal
///          distribution truncated there (Cragg 1971). d >= d_0.
struct CloudFit {
    bool found = false;
    std::string why;                      ///< where not found
    double smallest_slip = 0.0;           ///< d_0 [m]
    std::optional<BinaryFit> failure;     ///< absent: none failed, P_c = 0
    std::optional<BinaryFit> slides;      ///< absent: all slide, pi = 1
    double a = 0.0, b = 0.0, sigma = 0.0; ///< D in m
    bool converged = false;
    int iterations = 0;
    std::size_t sliding = 0, standing = 0, failed = 0; ///< counts of the three parts
    bool penalised = false;                            ///< Firth's penalty in one of the two binary parts

    double failure_probability(double x) const;
    double sliding_probability(double x) const;
    /// @throws ParameterError for d < d_0: below it nothing was fitted
    double probability(double x, double d) const;
};

/// @param smallest_slip  d_0 > 0 [m]: max(0.1 mm, 2 x slip error)
CloudFit fit_cloud(std::span<const CloudPoint> points, double smallest_slip);

} // namespace damslip::probability
