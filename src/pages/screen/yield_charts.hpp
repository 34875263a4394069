#pragma once

#include "analysis/screen/screening.hpp"
#include "pages/report/chart.hpp"

/// Yield acceleration over friction and water level (Goldgruber 2015, fig. 4-6).
namespace damslip::pages {

/// Yield acceleration over friction for each uplift model the scene has the data for.
Chart yield_over_friction(const Scene& scene, const Screening& s);

/// Yield acceleration over the reservoir level, likewise. @pre scene.reservoir
Chart yield_over_level(const Scene& scene, const Screening& s);

} // namespace damslip::pages
