#pragma once

#include "analysis/fragility/fragility_estimate.hpp"
#include "probability/estimate/multi_fidelity.hpp"

#include <functional>

namespace damslip {

/// One model of the chain, at one level.
struct MfmcModel {
    std::string method;     ///< "fe", "fe-reduced", "rigid"
    double seconds = 0.0;   ///< processor time of a run [s]
    double rho = 1.0;       ///< correlation of its prediction with the dear model's answer, of the pilot [-]
    double weight = 0.0;    ///< alpha; 0: not used
    std::uint64_t runs = 0; ///< that stand
};

/// One limit at one level by multifidelity Monte Carlo.
struct MfmcAtLevel {
    double x = 0.0;    ///< intensity [SI]
    bool used = false; ///< else `why_not`, and the plain estimate stands
    std::string why_not;
    std::vector<MfmcModel> models;       ///< the dear one first
    probability::MfmcEstimate low, high; ///< missing dear runs as survivals, as failures; equal where none is missing
    double spent = 0.0;                  ///< processor time of all runs of the level, the pilot's too [s]
    double speed_up = 1.0;               ///< variance of plain Monte Carlo for the same seconds over se^2
};

struct MfmcLimit {
    LimitInput limit;
    std::vector<MfmcAtLevel> levels;
};

struct MfmcFragility {
    std::vector<MfmcLimit> limits;
    std::vector<std::string> left_out; ///< models too dear for the pilot, a sentence each
    std::size_t pilot = 0;             ///< runs per level whose answers are thrown away
    double seconds = 0.0;              ///< processor time of the pilot and of the cheap models [s]
};

/// A plan of so many samples per level that shares no draw with plans of another stream (FragilitySizes).
using PlanOfStream = std::function<FragilityPlan(std::size_t samples, std::uint32_t stream)>;

struct MfmcOptions {
    std::string dear;                  ///< method of the dear runs: "fe"
    std::vector<std::string> cheap;    ///< methods of the others, the dearest first: "fe-reduced", "rigid-v"
    std::size_t pilot = 40;            ///< runs of all models per level, whose answers are thrown away
    std::size_t most_cheap = 20'000;   ///< samples of the cheapest model per level, at most
    std::optional<double> cheap_price; ///< of a cheap run over a dear one; none: as measured by the pilot
    int jobs = 1;
};

/// Multifidelity Monte Carlo (Peherstorfer, Willcox & Gunzburger 2016; probability::plan_mfmc) with the dear runs of a plan. A pilot of
/// draws of its own gives each cheap model a calibration (Calibration: a prediction of the dear answer, 0 ... 1), its correlation, its
/// price and so its weight; one between the dear and the cheapest model that costs more than half of a dear run in its first few is left
/// out before. How many samples each model gets follows from these, at all levels the most that any needs. A level where no cheap model is
/// sure to pay (probability::decide_on_pilot()) keeps the plain estimate. No sample that counts was used for a calibration, a weight or
/// that decision, so that the estimate has no bias. Samples are runs, or with lack of knowledge all runs of an epistemic draw.
/// @param dear  complete runs of `plan` by options.dear
/// @param plan_of  makes the pilot's plan and that of further cheap samples
MfmcFragility run_mfmc(const FragilityPlan& plan, const FragilityRuns& dear, const PlanOfStream& plan_of,
                       const SceneText& text, const MfmcOptions& options, Watch& watch);

} // namespace damslip
