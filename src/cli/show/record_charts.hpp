#pragma once

#include "cli/run/screening.hpp"
#include "core/table.hpp"
#include "report/page.hpp"

/// Records and what the block does under each.
namespace damslip::cli {

/// Response spectra of the horizontal components, pseudo-acceleration, 5 %: each record up to 6, beyond that median, 16/84 %
/// and all records faintly. @param jobs  threads, 0: all cores
report::Chart spectra(const std::vector<GroundMotion>& motions, int jobs);

/// Fewer samples in each chart of a history the more records there are: about 80 000 abscissae in all histories of one
/// kind keep a report of any number of records at a few megabytes. Call it when the chart has its curves.
void thin_for(report::Chart& chart, std::size_t records);

/// Measures of the scaled horizontal components: PGA, PGV, I_A, duration, mean period; vertical PGA.
Table record_table(const std::vector<GroundMotion>& motions);

/// Ground acceleration, slip histories, and (with a vertical component) yield against ground acceleration as
/// Goldgruber (2015), fig. 4-7, of one record; regressions beside the slip. The charts share cursor and zoom.
/// @param motion   of record `number`  @param records  how many there are: the more, the fewer samples each chart keeps
std::vector<report::Part> record_parts(const Scene& scene, const Screening& s, const GroundMotion& motion,
                                       std::size_t number, std::size_t records);

} // namespace damslip::cli
