#pragma once

#include "analysis/modes/modes.hpp"
#include "core/csv.hpp"
#include "pages/report/answer.hpp"

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

/// Natural modes as tables, object, text and files.
namespace damslip::pages {

/// Natural modes, or with acoustic water every coupled one, with its effective masses.
Table frequency_table(const ModesResult& result);
Table damping_table(const ModesResult& result);
Table transfer_table(const ModesResult& result);

/// @param given  the scene as read
Answer modes_answer(const Scene& given, const ModesResult& result);

/// Shapes for ParaView, and the transfer functions as a CSV file.
void write_modes(const std::filesystem::path& folder, const Scene& given, const ModesResult& result);

} // namespace damslip::pages
