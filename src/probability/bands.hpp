#pragma once

#include "probability/fit.hpp"

#include <array>
#include <span>

namespace damslip::probability {

inline constexpr std::array<double, 5> band_levels{0.05, 0.16, 0.50, 0.84, 0.95};

/// What lack of knowledge leaves open: percentiles over the epistemic draws e of P_e, each estimated with n_e aleatory samples.
struct EpistemicBands {
    std::array<double, 5> percentiles{}; ///< of P_e, at band_levels
    double mean = 0.0;                   ///< E P_e: the curve for rates
    double variance = 0.0;               ///< of P_e: s^2(p_hat) - mean p_hat (1 - p_hat) / (n - 1), not below 0
    double noise_share = 0.0;            ///< what the inner samples add to s^2(p_hat) [-]
    bool add_inner = false;              ///< noise_share > 20 %: the bands are too wide, more inner samples are needed
};

/// @param p_hat  estimate of P_e of each draw
/// @param inner  number of independent aleatory samples behind each; 0: exact
/// @throws ParameterError for fewer than 2 draws, sizes that differ, inner = 1
EpistemicBands epistemic_bands(std::span<const double> p_hat, std::span<const double> inner);

/// Lognormal in both kinds: P_q(x) = Phi((ln(x / theta) + beta_U z_q) / beta_R), mean curve with beta^2 = beta_R^2 + beta_U^2
/// (Kennedy et al. 1980).
struct LognormalBands {
    double median = 1.0, beta_aleatory = 0.4, beta_epistemic = 0.2;
    double probability(double x, double q) const;
    double mean(double x) const;
};

} // namespace damslip::probability
