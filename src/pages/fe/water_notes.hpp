#pragma once

#include "fe2d/fluid/fluid_model.hpp"
#include "scene/scene.hpp"

#include <string>
#include <vector>

namespace damslip::pages {

/// What to know about length, end and mesh of the scene's water where the ground excites frequencies up to `highest` [Hz].
std::vector<std::string> reservoir_warnings(const Scene& scene, double highest);

/// Unknowns of the water: "1 020 pressures, 12 layers ...".
std::string water_counts(const fe2d::FluidModel& water);

} // namespace damslip::pages
