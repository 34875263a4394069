#pragma once

#include "analysis/spectrum/spectrum_level.hpp"
#include "pages/report/page.hpp"

#include <nlohmann/json_fwd.hpp>

/// The response spectrum's answer as tables.
namespace damslip::pages {

/// Base shear, stresses and factors of every spectrum.
Table spectrum_table(const SpectrumLevel& level);

nlohmann::ordered_json spectrum_json(const SpectrumLevel& level);
std::string spectrum_text(const SpectrumLevel& level);
/// The spectrum of the largest base shear in one sentence; empty without spectra.
std::string spectrum_sentence(const SpectrumLevel& level);
Section spectrum_section(const SpectrumLevel& level);

} // namespace damslip::pages
