#pragma once

#include "analysis/ablation/ablation.hpp"
#include "core/status.hpp"
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

} // namespace damslip::pages
