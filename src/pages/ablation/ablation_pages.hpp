#pragma once

#include "analysis/ablation/ablation.hpp"
#include "analysis/fe/contact_runs.hpp"
#include "core/status.hpp"
#include "fe2d/fluid/fluid_model.hpp"
#include "fe2d/model/model.hpp"
#include "pages/report/answer.hpp"
#include "pages/report/page.hpp"

#include <string>
#include <vector>

namespace damslip::pages {

struct Ablations {
    const AblationPlan& plan;
    const std::vector<RecordPair>& records;
    const AblationRuns& runs;
    std::string water; ///< what reservoir.model = "auto" became, and why; empty: the scene says it
};

/// Runs without an answer, by their status; one more where the step that all runs share misses time.slip_tolerance.
StatusCount unanswered_runs(const AblationRuns& runs);

/// The page of an ablation: bars of the slip changes by motion, of the seconds saved, and the tables. Seconds differ
/// from call to call, all else is the same.
/// @param given  the scene as read
Page ablation_page(const Ablations& in, const Scene& given, const EffectPlan& effects);

Answer ablation_answer(const Ablations& in, const Scene& given, const EffectPlan& effects);

struct Explained {
    const Scene& given; ///< as read
    std::string method; ///< "rigid" or "fe"
    EffectPlan plan;
    std::optional<fe2d::Model> model;      ///< of an FE run
    std::optional<fe2d::FluidModel> water; ///< acoustic
    std::optional<ContactCost> cost;       ///< of an FE run
    std::vector<std::string> notes;
    std::vector<LiftJoint> lift_joints = {}; ///< of the model
};

Answer explain_answer(const Explained& in);

} // namespace damslip::pages
