#pragma once

#include <span>

namespace damslip::sliding {

/// Distribution of a slip D [cm]: D = 0 with a probability of its own, else log-normal. sigma = 0: a step at the median.
struct SlipDistribution {
    double weight; ///< in a mixture; the weights of one sum to 1
    double zero;   ///< P(D = 0)
    double median; ///< of D > 0 [cm]; 0: D = 0 surely
    double sigma;  ///< of ln D

    /// P(D <= d), d > 0 [cm].
    double below(double d) const;
};

/// Smallest D [cm] with P(D' <= D) >= q of the mixture, 0 < q < 1: of one member the (q - P0)/(1 - P0) quantile of its
/// log-normal part, and 0 for q <= P0.
double quantile(std::span<const SlipDistribution> mixture, double q);

/// Distribution function of the standard normal, to round-off in both tails.
double normal_cdf(double z);

} // namespace damslip::sliding
