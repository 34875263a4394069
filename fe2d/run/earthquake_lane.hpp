#pragma once

#include "fe2d/run/earthquake_run.hpp"
#include "fe2d/run/step_error.hpp"

namespace damslip::fe2d {

/// One motion and strength of several that are run together: its static state, and the result so far.
struct EarthquakeRun::Lane {
    Strength strength;
    ContactMemory memory;
    Contact contact = {}; ///< strength of the base
    const GroundMotion* motion = nullptr;
    StaticState start = {};
    Eigen::VectorXd load = {};   ///< static, on all unknowns, while it shakes [N/m]
    PressureProfile uplift = {}; ///< under the base, part of `load`
    RunResult result = {};
    std::optional<HistoryBefore> before = {};        ///< of a record of a sequence that begins from a static state
    int next = 0;                                    ///< halvings of the next pass; 0: none
    std::vector<std::vector<SlipAtStep>> slips = {}; ///< of the passes, by plane
    double local_error = 0.0;                        ///< of the worst steps of the first pass, for adaptive steps [m]
    std::vector<double> later_errors = {};           ///< the same of the later records of a sequence
    long steps_before = 0, steps_of_all = 0;         ///< of the records before, and of all; 0: of its motion
    std::optional<ChosenSteps> steps = {};           ///< in place of the options'

    /// Do the static stages end in equilibrium?
    bool stands() const { return !result.stages.empty() && result.stages.back().status == StageStatus::ok; }
    double order_in_step() const;           ///< that an estimate of the slip's error relies on at most
    void note_slips(const RunResult& pass); ///< before `pass` becomes `result`
};

} // namespace damslip::fe2d
