#pragma once

#include "analysis/modes/calibrate.hpp"
#include "analysis/modes/modes.hpp"
#include "pages/report/answer.hpp"

#include <filesystem>

namespace damslip::pages {

/// Natural modes, or with acoustic water every coupled one, damping, transfer functions. @param given  the scene as read
Answer modes_answer(const Scene& given, const ModesResult& result);

/// Shapes for ParaView, and the transfer functions as a CSV file.
void write_modes(const std::filesystem::path& folder, const Scene& given, const ModesResult& result);

Answer calibration_answer(const Scene& given, const Calibration& c);

/// The calibrated scene with all defaults, as a file.
void write_calibrated(const std::filesystem::path& file, const Calibration& c);

} // namespace damslip::pages
