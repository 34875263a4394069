#pragma once

#include "probability/fit/lognormal_fit.hpp"

#include <span>
#include <string>

namespace damslip::probability {

/// Lognormal capacities of an incremental dynamic analysis.
struct CapacityFit {
    bool found = false;
    std::string why; ///< where not found
    LognormalCurve curve;
    std::size_t reached = 0, censored = 0;
    double se_log_median = 0.0, se_beta = 0.0; ///< standard errors by the information matrix
    int iterations = 0;                        ///< 0: by moments
};

/// @param reached      levels at which a record first has D > d, > 0
/// @param censored_at  highest level tried of each record that never has it
/// None censored: mean and standard deviation (n - 1) of the logarithms. Else the maximum of
///     sum ln[phi(z_r) / (beta x_r)] + sum ln[1 - Phi(z_c)],   z = ln(x / theta) / beta       Baker (2015), eq. (5)-(6),
/// concave in 1 / beta and ln(theta) / beta. Not found with fewer than two different levels reached.
CapacityFit fit_capacities(std::span<const double> reached, std::span<const double> censored_at);

} // namespace damslip::probability
