#pragma once

#include "analysis/spectrum/spectrum_level.hpp"
#include "pages/report/page.hpp"

#include <nlohmann/json_fwd.hpp>

/// The response spectrum's answer as tables.
namespace damslip::pages {

/// Base shear, stresses and factors of every spectrum.
Table spectrum_table(const SpectrumLevel& level);
/// Each component of the earthquake and both together, where the spectra have a vertical one; else without rows.
Table spectrum_component_table(const SpectrumLevel& level);
/// Modes of the vertical component, as spectrum_mode_table().
Table spectrum_vertical_mode_table(const SpectrumLevel& level, const SpectrumDemand& row);
/// Modes, their masses and shares of one spectrum's base shear.
Table spectrum_mode_table(const SpectrumLevel& level, const SpectrumDemand& row);
/// Equivalent lateral forces and sections over the height.
Table spectrum_height_table(const SpectrumDemand& row);

nlohmann::ordered_json spectrum_json(const SpectrumLevel& level);
std::string spectrum_text(const SpectrumLevel& level);
/// The spectrum of the largest base shear in one sentence; empty without spectra.
std::string spectrum_sentence(const SpectrumLevel& level);
Section spectrum_section(const SpectrumLevel& level);

} // namespace damslip::pages
