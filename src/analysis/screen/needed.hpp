#pragma once

#include "analysis/prepare/ready.hpp"

#include <optional>
#include <string>
#include <vector>

/// What it takes for the slip to stay within the allowable one.
namespace damslip {

/// One record with one polarity.
struct NeededRow {
    std::string record;
    int polarity = 1;
    double peak = 0.0;      ///< k_max g: largest acceleration that drives it downstream [m/s^2]
    double peak_time = 0.0; ///< of the first such sample [s]
    std::optional<double>
        yield; ///< one-way block, horizontal motion: a_y that slips the allowable (yield_for_slip) [m/s^2]
    std::optional<double>
        friction; ///< of the rigid block, with the vertical component where there is one; see friction_for_slip()
};

/// Least friction from which on the rigid block's largest slip stays at or below `slip`: all frictions above it that were
/// looked at do. Looked at 33 values between the friction that stands and `highest_friction`, the last crossing by bisection
/// to 1e-7. A slip without an end (runs away, still sliding) is more than any. @returns nothing where even the highest slips more
/// @param slip  largest slip allowed [m], >= 0
std::optional<double> friction_for_slip(const Ready& ready, const sliding::SkippingMotion& motion, int polarity,
                                        double slip);

inline constexpr double highest_friction = 3.0; ///< of the search [-]: 72 degrees, more than any joint's

/// Of all records and both polarities. Empty without criteria.allowable_slip, for a wedge and for friction over the slip: they
/// have no single friction or no sense up the slope. @param jobs  threads, 0: all cores
std::vector<NeededRow> needed_rows(const Ready& ready, int jobs);

} // namespace damslip
