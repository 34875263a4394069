#pragma once

#include "core/table.hpp"
#include "fe2d/fluid/coupled_modes.hpp"
#include "fe2d/fluid/fluid_model.hpp"
#include "fe2d/harmonic/transfer.hpp"
#include "fe2d/modes/natural_modes.hpp"
#include "scene/scene.hpp"

#include <string>
#include <vector>

namespace damslip::pages {

/// Every coupled mode with its effective masses, what it is a mode of, and which `leading` ones were chosen.
Table coupled_mode_table(const fe2d::CoupledModes& modes, const std::vector<Eigen::Index>& leading);

/// The leading modes as modes of a structure, for tables that know no water.
fe2d::NaturalModes as_natural_modes(const fe2d::CoupledModes& modes, const std::vector<Eigen::Index>& leading);

Table transfer_table(const std::vector<fe2d::TransferPoint>& points, bool water);

/// What to know about length, end and mesh of the scene's water where the ground excites frequencies up to `highest` [Hz].
std::vector<std::string> reservoir_warnings(const Scene& scene, double highest);

/// Unknowns of the water: "1 020 pressures, 12 layers ...".
std::string water_counts(const fe2d::FluidModel& water);

} // namespace damslip::pages
