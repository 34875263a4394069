#pragma once

#include "fe2d/run/earthquake_run.hpp"
#include "fe2d/run/step_error.hpp"

namespace damslip::fe2d {

/// One strength of several that are run together: its static state, and the result so far.
struct EarthquakeRun::Lane {
    Strength strength;
    ContactMemory memory;
    StaticState start = {};
    RunResult result = {};
    int next = 0;                                    ///< halvings of the next pass; 0: none
    std::vector<std::vector<SlipAtStep>> slips = {}; ///< of the passes, by plane
    double local_error = 0.0;                        ///< of the worst steps of the first pass, for adaptive steps [m]
    std::optional<ChosenSteps> steps = {};           ///< in place of the options'

    /// Do the static stages end in equilibrium?
    bool stands() const { return !result.stages.empty() && result.stages.back().status == StageStatus::ok; }
    void note_slips()
    {
        slips.resize(1 + result.lifts.size());
        slips.front().push_back({result.halvings, result.slip});
        for (std::size_t k = 0; k < result.lifts.size(); ++k)
            slips[k + 1].push_back({result.halvings, result.lifts[k].slip});
    }
};

} // namespace damslip::fe2d
