#pragma once

#include "analysis/fragility/interval_cost.hpp"
#include "pages/report/page.hpp"

#include <nlohmann/json_fwd.hpp>

namespace damslip::pages {

/// What the price of an interval is shown with.
struct IntervalCostView {
    const Scene& scene;
    const IntervalCost& cost;
    const std::vector<RecordPair>& records;
    std::string measure;            ///< "PGA"
    double unit = 1.0;              ///< SI value of one unit of the levels
    std::string unit_text = "m/s2"; ///< "g"
};

/// One row an estimator and number of runs.
Table interval_cost_table(const IntervalCostView& view);
nlohmann::ordered_json interval_cost_json(const IntervalCostView& view);
std::string interval_cost_text(const IntervalCostView& view);
Page interval_cost_page(const IntervalCostView& view);

enum class CostAxis { seconds, runs };

/// Half-width of the 95 % interval over processor time or over runs, both logarithmic, a line an estimator.
Chart interval_cost_chart(const std::vector<IntervalPoint>& points, CostAxis axis, const std::string& title,
                          const std::string& note);

} // namespace damslip::pages
