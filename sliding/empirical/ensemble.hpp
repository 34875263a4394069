#pragma once

#include "sliding/empirical/regression.hpp"

namespace damslip::sliding {

/// Weight of one regression, by its id.
struct RegressionWeight {
    std::string id;
    double weight = 1.0; ///< >= 0, relative to the others
};

/// Several regressions as one: each a distribution of D (log-normal with its sigma; a step where none is published; the
/// share P(D = 0) at zero), weighted.
struct Ensemble {
    std::vector<std::string_view> members; ///< ids of the valid ones, in table order
    std::vector<double> weights;           ///< of the members, sum 1
    std::optional<double> median_cm;       ///< of the weighted distribution [cm]; no member: none
    std::optional<double> low_cm, high_cm; ///< its 16 and 84 % [cm]; none of one member alone that publishes no sigma
    double weight_left_out = 0.0;          ///< share of the given weights on regressions that are not valid here [-]
};

/// Members are the valid results, see valid(). Without weights: all of EnsembleUse::estimate, equally; with weights:
/// those named with a weight above zero. No valid one: no values.
/// @param results  evaluate_all of one record
/// Precondition: ids known (find_regression), weights finite and not negative.
Ensemble weighted_ensemble(std::span<const RegressionResult> results, std::span<const RegressionWeight> weights = {});

} // namespace damslip::sliding
