#pragma once

#include "analysis/fragility/fragility_estimate.hpp"
#include "probability/estimate/two_level.hpp"

namespace damslip {

/// One limit at one level by finite elements, with the rigid block as the cheap model.
struct TwoLevelAtLevel {
    double x = 0.0;    ///< intensity [SI]
    bool used = false; ///< else `why_not`, and the plain estimate stands
    std::string why_not;
    probability::TwoLevelEstimate low,
        high;                        ///< missing dear runs as survivals, as failures; equal where none is missing
    std::size_t dear = 0, cheap = 0; ///< samples that stand
    double speed_up = 1.0; ///< variance of plain Monte Carlo for the same processor seconds over that of both models
};

struct TwoLevelLimit {
    LimitInput limit;
    std::vector<TwoLevelAtLevel> levels;
};

struct TwoLevelFragility {
    std::vector<TwoLevelLimit> limits;
    double dear_seconds = 0.0, cheap_seconds = 0.0; ///< processor time of a run of each model [s]
    std::size_t disagree = 0; ///< dear samples that stand by one model alone; they are taken as the finite elements say
};

/// Estimates with cross-fitting (probability::two_level). What the cheap model says of a sample: asinh of its slip over the limit, and its yield
/// acceleration over the factor on the record. Folds are of events; of fewer than 10 events of samples, and the interval is that of the draws
/// under this suite. Levels with fewer than 10 failures or 10 survivals of the dear model keep the plain estimate, and so do those where no fold
/// finds that the rigid block pays.
/// @param dear        plan and runs of finite elements; `dear_rigid` the rigid block's runs of the same plan
/// @param cheap       a plan of other draws (FragilitySizes::stream) by the rigid block
TwoLevelFragility estimate_two_level(const FragilityPlan& plan, const FragilityRuns& dear,
                                     const FragilityRuns& dear_rigid, const FragilityPlan& cheap_plan,
                                     const FragilityRuns& cheap);

} // namespace damslip
