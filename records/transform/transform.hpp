#pragma once

#include "records/record.hpp"

#include <optional>
#include <vector>

namespace damslip::records {

/// Every sample times `factor`; -1 flips the polarity. @param factor  finite
Record scaled(Record record, double factor);

/// The factor that makes max |a| = pga. @param pga  [m/s^2], > 0   @throws InputError for a record of zeros.
double factor_to_pga(const Record& record, double pga);

/// Scaled, with its sign kept, so that max |a| = pga. @param pga  [m/s^2], > 0
/// @throws InputError for a record of zeros.
Record scaled_to_pga(const Record& record, double pga);

/// Each interval cut into `parts` equal ones: the same motion exactly (acceleration is linear between samples).
/// @param parts  >= 1. @throws InputError when more than max_samples would result.
Record subdivided(const Record& record, int parts);

/// Linear interpolation at multiples of `dt`. Exact where the old dt is a whole multiple of the new; else corners of
/// the polygon are cut and the result carries a warning with both PGA. The end is dropped where the duration is no
/// multiple of dt.
/// @param dt  [s], > 0   @throws InputError when fewer than 2 or more than max_samples samples would result.
Record resampled(const Record& record, double dt);

inline constexpr std::size_t max_samples = 5'000'000; ///< of one component; readers refuse more

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

struct MotionOptions {
    double scale = 1.0; ///< both components [-], finite
    std::optional<double>
        scale_to_pga; ///< horizontal peak made equal to this before `scale` [m/s^2], > 0; vertical by the same factor
    int polarity = 1; ///< +1, or -1: flips the horizontal component
};

/// Both components on one grid, ready to shake a model.
///
/// Steps of both that share a common part (dt_h/m = dt_v/n with m, n <= 16) are subdivided to it, which changes
/// nothing; otherwise the coarser is interpolated at the finer step. The shorter component is filled up with zeros.
/// Where a component does not start at zero, both get a zero sample one dt earlier. Everything that was changed is in
/// `notes`.
/// @param horizontal, vertical  as read; @throws InputError for a scale_to_pga on a horizontal record of zeros
GroundMotion make_ground_motion(const Record& horizontal, const std::optional<Record>& vertical,
                                const MotionOptions& options = {});

/// Several motions as the events of one, on one grid: steps that share a common part (dt_1/m = dt_2/n with m, n <= 16) are
/// subdivided to it, which changes nothing; else all are interpolated at the finest step, and `notes` says so. A motion
/// without a vertical component beside one with it gets zeros.
/// @param motions  two at least for a sequence  @param pause  at rest between two of them [s]
GroundMotion one_after_the_other(const std::vector<GroundMotion>& motions, double pause);

/// The same motion as it was played: with the zero samples between events. @param starts  of the events [s]
GroundMotion as_played(const GroundMotion& sequence, const std::vector<double>& starts);

} // namespace damslip::records
