#pragma once

#include "records/record.hpp"

#include <optional>

namespace damslip::records {

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

} // namespace damslip::records
