#pragma once

#include "analysis/fragility/fragility_causes.hpp"
#include "analysis/fragility/two_level_runs.hpp"

namespace damslip::pages {

/// All that a fragility's tables and page show.
struct FragilityView {
    const Scene& scene;
    const FragilityPlan& plan;
    const FragilityRuns& runs;
    const FragilityEstimate& estimate;
    std::string method;                           ///< "rigid-v", "fe"
    double unit = 1.0;                            ///< SI value of one unit of the levels
    std::string unit_text = "m/s2";               ///< "g"
    const TwoLevelFragility* two_level = nullptr; ///< nullptr: one model
    const FragilityCauses* causes = nullptr;      ///< nullptr: none
    std::vector<std::pair<LimitInput, std::vector<NeededYield>>> needed_yields = {}; ///< of limits of slip
    std::vector<std::string> notes = {};
};

} // namespace damslip::pages
