#pragma once

#include "pages/fe/fe_charts.hpp"

/// What happens along the base of an FE contact run.
namespace damslip::pages {

/// Contact pressure and shear from heel to toe: at the start, when the dam slides fastest, at the end, and at any of about
/// 150 instants by a slider.
std::vector<Chart> base_charts(const RunView& view);

/// Which part of the base sticks, slips and opens at every row of the history.
StateMap base_states(const RunView& view);

} // namespace damslip::pages
