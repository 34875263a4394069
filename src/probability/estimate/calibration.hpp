#pragma once

#include "probability/fit/binary.hpp"

#include <span>
#include <vector>

/// What a cheap model's answers are worth: a prediction of the dear one's, and the scatter of what is left.
namespace damslip::probability {

/// h: P(f = 1 | what the cheap model says), a logit with Firth's penalty. Where the cheap run is missing, and where nothing can be fitted, the
/// mean of f among the samples it was fitted on.
struct Calibration {
    BinaryFit fit;
    double constant = 0.5;
    bool fitted = false;

    double operator()(const std::vector<double>& cheap) const;
};

/// @param cheap  what the cheap model says of each sample; one NaN: its run is missing @param f  0 ... 1, of the dear model
Calibration calibrate(std::span<const std::vector<double>* const> cheap, std::span<const double> f);

double mean_of(std::span<const double> values);
double variance_of(std::span<const double> values); ///< n - 1; of fewer than two values 0

/// Degrees of freedom of the sample variance of these values: var(s^2) = s^4 (kurtosis - 1) / n = 2 s^4 / degrees (Satterthwaite 1946). Within
/// 3 ... n - 1. Few surprises among many zeros: few degrees.
double degrees_of_variance(std::span<const double> values);

} // namespace damslip::probability
