#pragma once

#include "core/table.hpp"
#include "pages/report/page.hpp"

#include <optional>

namespace damslip::pages {

/// What the rules for water in the opening base are worth: largest slips on the way under each rule side by side, and how
/// far they are apart. None where the rows of a sweep have fewer than two rules.
/// @param rows  columns by their keys, as `sweep` writes them
std::optional<Table> opening_water_table(const Table& rows);
std::optional<Section> opening_water_section(const Table& rows);

} // namespace damslip::pages
