#pragma once

#include "analysis/modes/modes.hpp"
#include "analysis/spectrum/spectrum_level.hpp"
#include "pages/report/answer.hpp"
#include "pages/report/page.hpp"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>

namespace damslip::pages {

/// Natural modes, or with acoustic water every coupled one, damping, transfer functions. @param given  the scene as read
Answer modes_answer(const Scene& given, const ModesResult& result);

/// Shapes for ParaView, and the transfer functions as a CSV file.
void write_modes(const std::filesystem::path& folder, const Scene& given, const ModesResult& result);

Answer calibration_answer(const Scene& given, const Calibration& c);

/// The calibrated scene with all defaults, as a file.
void write_calibrated(const std::filesystem::path& file, const Calibration& c);

/// Base shear, stresses and factors of every spectrum.
Table spectrum_table(const SpectrumLevel& level);

nlohmann::ordered_json spectrum_json(const SpectrumLevel& level);
std::string spectrum_text(const SpectrumLevel& level);
/// The spectrum of the largest base shear in one sentence; empty without spectra.
std::string spectrum_sentence(const SpectrumLevel& level);
Section spectrum_section(const SpectrumLevel& level);

} // namespace damslip::pages
