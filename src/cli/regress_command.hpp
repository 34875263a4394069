#pragma once

#include "cli/terminal/streams.hpp"

#include <optional>

namespace damslip::cli {

/// What is known of an earthquake without its record. In the units of the flags.
struct RegressArguments {
    double yield_g = 0.0, pga_g = 0.0;
    std::optional<double> pgv_cm_s, arias_m_s, mean_period_s, magnitude, period_s, sa_13_g, sa_15_g, cycles;
    std::optional<double> allowable_mm; ///< then k(d*) of each
};

/// Slips by the regressions from given measures of the motion.
int regress(const RegressArguments& arguments, const Streams& streams);

} // namespace damslip::cli
