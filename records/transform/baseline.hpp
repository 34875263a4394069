#pragma once

#include "records/record.hpp"

#include <vector>

namespace damslip::records {

/// Degree of the polynomial of time that is taken off the acceleration.
enum class BaselineDegree { constant = 0, linear = 1, quadratic = 2 };

/// What the polynomial is fitted to by least squares.
enum class BaselineFit {
    acceleration, ///< smallest sum of a^2 left: removes offset and trend, velocity may still drift
    velocity ///< smallest sum of v^2 left, starting from rest: Berg & Housner (1961), the parabolic correction of the
             ///< early archives
};

struct BaselineOptions {
    BaselineDegree degree = BaselineDegree::quadratic;
    BaselineFit fit = BaselineFit::velocity;
};

struct BaselineResult {
    Record record;                    ///< corrected
    std::vector<double> coefficients; ///< removed: c0 + c1 x + c2 x^2 [m/s^2], x = t / duration in 0 ... 1
};

/// Takes the polynomial off at the samples. The velocity of the fit is that of the piecewise-linear record and
/// polynomial, so a record that is such a polynomial comes out as zero to round-off. It removes drift, not noise: a
/// record with a permanent offset or long-period noise wants the agency's own processing.
/// @param record  at least 4 samples, else @throws InputError
BaselineResult baseline_corrected(const Record& record, const BaselineOptions& options = {});

} // namespace damslip::records
