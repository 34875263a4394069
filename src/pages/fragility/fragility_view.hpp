#pragma once

#include "analysis/fragility/fragility_study.hpp"

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
    const FragilityCauses* causes = nullptr;      ///< nullptr: none
    const ConditionedPlan* conditioned = nullptr; ///< nullptr: friction is drawn
    std::vector<std::pair<LimitInput, std::vector<NeededYield>>> needed_yields = {}; ///< of limits of slip
    std::vector<std::string> notes = {};
    /// Half-width over runs of this run's own first draws at the level with P nearest to 0.1, one estimator a limit; empty: not known.
    std::vector<IntervalPoint> own_cost = {};
};

/// Of a study that was answered; all of it outlives the view.
inline FragilityView view_of(const FragilityStudy& study, const FragilityPlan& plan, const FragilityRuns& runs,
                             const FragilityAnswer& answer)
{
    const IntensityInput& intensity = study.input.intensity;
    return {study.scene,
            plan,
            runs,
            answer.estimate,
            study.method.id,
            intensity.level_unit,
            intensity.level_unit_text,
            answer.causes ? &*answer.causes : nullptr,
            answer.conditioned,
            answer.needed_yields,
            answer.notes,
            answer.own_cost};
}

} // namespace damslip::pages
