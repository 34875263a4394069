#pragma once

#include "pages/report/chart.hpp"

#include <string>
#include <vector>

namespace damslip::pages {

/// One column of values over the common abscissae; NaN where the curve has none.
using Values = std::vector<double>;

/// Curves of one chart over common abscissae.
struct ChartData {
    std::vector<double> x;
    std::vector<Values> columns; ///< y, then low and high where the curve has them, curve after curve
    std::size_t samples = 0;     ///< abscissae before thinning
    bool joined = false;         ///< abscissae of the curves differ, so a NaN may mean "not sampled here"
};

/// All curves over the union of their abscissae. @pre x of each curve is ascending
ChartData common_abscissae(const Chart& chart);

/// The lowest and highest value of each column in each of `buckets` equal parts of the samples, first and last sample;
/// as it is up to `above` samples.
ChartData thinned(ChartData data, std::size_t above, std::size_t buckets);

/// What page.js draws, as one JSON object: numbers with 6 significant digits, NaN and infinity as null, "<" as \u003c.
std::string chart_json(const Chart& chart, const ChartData& data);

} // namespace damslip::pages
