#pragma once

#include "pages/sweep/sweep_rows_view.hpp"

namespace damslip::pages {

/// The friction from which on no slip of a sweep is above the allowable one, for every variant and method, between the two frictions
/// of the grid that bracket it. Without rows where there is no allowable slip or only one friction. An FE slip counts with its
/// error of the step added; a row without a slip, or without an answer, slips more than any.
/// @param allowable  [m]
Table needed_friction_table(const SweepView& view, const std::optional<double>& allowable);

} // namespace damslip::pages
