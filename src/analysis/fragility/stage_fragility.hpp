#pragma once

#include "analysis/fragility/fragility_estimate.hpp"
#include "probability/export/fragility_files.hpp"

namespace damslip {

/// P over the water level, of runs that draw reservoir.level_m from a few values: one place for each limit and intensity.
///
/// At each value P and Wilson's interval of its runs, made non-decreasing (isotonic regression); at each P so reached the most likely stage is where
/// that curve reaches it, its ends where the upper and the lower end of the intervals do: linear between the values, kept within them.
/// Values at which nothing fails have no row, and a place of one row is left out.
/// @returns nothing where no variable, or not a discrete one, is reservoir.level_m, or fewer than two values of it were drawn
std::vector<probability::UsaceLocation> stage_fragility(const FragilityPlan& plan, const FragilityRuns& runs);

/// The nearest non-decreasing values (pool adjacent violators; Barlow et al. 1972). @param weight  > 0, as long as y
std::vector<double> non_decreasing(std::vector<double> y, const std::vector<double>& weight);

} // namespace damslip
