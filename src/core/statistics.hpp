#pragma once

#include <vector>

namespace damslip {

/// Value below which the share q of the sorted samples lies, linear between order statistics (Hyndman & Fan 1996, type 7).
double percentile(std::vector<double> samples, double q);

} // namespace damslip
