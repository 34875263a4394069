#pragma once

#include "analysis/fragility/fragility_study.hpp"
#include "core/csv.hpp"
#include "pages/report/answer.hpp"
#include "pages/report/page.hpp"

#include <limits>

namespace damslip::pages {

/// All that a fragility's tables and page show.
struct FragilityView {
    const FragilityStudy& study;
    const FragilityPlan& plan;
    const FragilityRuns& runs;
    const FragilityAnswer& answer;

    double unit() const { return study.input.intensity.level_unit; } ///< SI value of one unit of the levels
    const std::string& unit_text() const { return study.input.intensity.level_unit_text; } ///< "g"
};

Answer fragility_answer(const FragilityView& view);
/// Curves with stripes and bands, rate by intensity, what P comes from, the tables.
Page fragility_page(const FragilityView& view);
/// OpenQuake's model (NRML 0.5): lognormal curves; P at the levels where a curve does not hold or two of them cross. Of a cloud: empty.
std::string fragility_nrml(const FragilityView& view);
/// P over the water level as the USACE library fragility-curves reads it; empty: the level is not drawn from a list of values.
std::string fragility_usace(const FragilityView& view);

/// What an interval of P costs.
Answer interval_cost_answer(const FragilityStudy& study, const IntervalCost& cost);
Page interval_cost_page(const FragilityStudy& study, const IntervalCost& cost);

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
