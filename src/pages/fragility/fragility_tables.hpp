#pragma once

#include "core/table.hpp"
#include "pages/fragility/fragility_view.hpp"

#include <limits>

namespace damslip::pages {

/// Of the levels, its key and heading with their unit.
Column intensity_column(const FragilityView& view);
/// One row a run: draw, record, level, answer. The same whatever the number of threads, parts and stops.
/// @param first, end  the runs first ... end - 1 alone
Table sample_table(const FragilityView& view, std::size_t first = 0,
                   std::size_t end = std::numeric_limits<std::size_t>::max());
enum class Readers { files, people };
/// One row for each limit and level: counts, P, intervals, bands. @param readers  people: columns of missing runs only where there are any, no bands
Table fragility_table(const FragilityView& view, Readers readers = Readers::files);
/// One row for each limit and level: percentiles of P by lack of knowledge. Without epistemic variables no rows.
Table band_table(const FragilityView& view);
/// One row for each limit: the lognormal curve, or why there is none.
Table curve_table(const FragilityView& view);
/// The levels, "0.15 to 0.4 g", where the median of the limit's curve lies apart from them: it is extrapolated; else empty.
std::string levels_apart_from_median(const FragilityView& view, const LimitEstimate& limit);
/// One row for each limit: rates per year and their intervals. Without hazard no rows.
Table rate_table(const FragilityView& view);
/// The same for people: a table for each limit, from ... to.
std::vector<Table> rate_tables(const FragilityView& view);
/// One row for each limit and part of the intensities: its share of the rate.
Table rate_part_table(const FragilityView& view);
/// One row for each limit and level where friction was conditioned on: P, its error, the runs, what that gained.
Table conditioned_table(const FragilityView& view);
/// One row a variable: shares of the variance of P, and P at its ends.
Table cause_table(const FragilityView& view);
/// One row for each limit and level: the yield that a slip needs.
Table needed_yield_table(const FragilityView& view);

} // namespace damslip::pages
