#pragma once

#include "analysis/modes/calibrate.hpp"
#include "core/csv.hpp"
#include "pages/report/answer.hpp"

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

/// A calibrated dam as tables, object, text and scene file.
namespace damslip::pages {

/// Laws of the moduli as tables of a scene file that `fragility` reads.
std::string fragility_laws(const Calibration& c);

Answer calibration_answer(const Scene& given, const Calibration& c);

/// The calibrated scene with all defaults, as a file.
void write_calibrated(const std::filesystem::path& file, const Calibration& c);

} // namespace damslip::pages
