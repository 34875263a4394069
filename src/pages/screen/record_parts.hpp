#pragma once

#include "analysis/screen/screening.hpp"
#include "pages/report/page.hpp"

/// What the block does under each record.
namespace damslip::pages {

/// Ground acceleration, slip histories, and (with a vertical component) yield against ground acceleration as
/// Goldgruber (2015), fig. 4-7, of one record; regressions beside the slip. The charts share cursor and zoom.
/// @param motion   of record `number`  @param records  how many there are: the more, the fewer samples each chart keeps
std::vector<Part> record_parts(const Scene& scene, const Screening& s, const GroundMotion& motion, std::size_t number,
                               std::size_t records);

} // namespace damslip::pages
