#pragma once

#include "core/table.hpp"
#include "pages/report/page.hpp"
#include "records/record.hpp"

/// Records as tables and spectra.
namespace damslip::pages {

/// Sections of records that a report shows unfolded.
inline constexpr std::size_t open_records = 3;

/// Response spectra of the horizontal components, pseudo-acceleration, 5 %: each record up to 6, beyond that median, 16/84 %
/// and all records faintly. @param jobs  threads, 0: all cores
Chart spectra(const std::vector<GroundMotion>& motions, int jobs);

/// Fewer samples in each chart of a history the more records there are: about 80 000 abscissae in all histories of one
/// kind keep a report of any number of records at a few megabytes. Call it when the chart has its curves.
void thin_for(Chart& chart, std::size_t records);

/// Measures of the scaled horizontal components: PGA, PGV, I_A, duration, mean period; vertical PGA.
Table record_table(const std::vector<GroundMotion>& motions);

} // namespace damslip::pages
