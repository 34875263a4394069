#pragma once

#include "pages/fe/fe_charts.hpp"

/// Water that follows the opening of the base, for people; nothing where the scene's does not.
namespace damslip::pages {

/// One row per run: crack, pressures, work.
Table base_water_table(const Scene& scene, const std::vector<ContactRun>& runs);
/// Energy of the flow along the joint, one row per run; without rows unless opening is reynolds.
Table joint_flow_table(const std::vector<ContactRun>& runs);
/// What a reader must know of a run's crack and water.
std::vector<std::string> base_water_notes(const Scene& scene, const std::vector<ContactRun>& runs);
/// Pressure along the base: before, with the longest crack, at its least and largest, at the end, and at any instant by a
/// slider.
std::optional<Chart> base_water_chart(const RunView& view);

} // namespace damslip::pages
