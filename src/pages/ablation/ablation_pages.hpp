#pragma once

#include "analysis/ablation/ablation.hpp"
#include "core/status.hpp"
#include "pages/report/answer.hpp"
#include "pages/report/page.hpp"

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace damslip::pages {

/// One bar from zero.
struct Bar {
    std::string name;
    std::optional<double> value;
    double error = 0.0;    ///< drawn as a whisker on both sides of the end; 0: none
    std::string words;     ///< beside the bar: its figure; in its place where there is no value
    bool doubtful = false; ///< drawn hollow: not larger than its error
};

/// Bars to both sides of zero, the longest on top; those without a value at the bottom.
/// @param unit  of the values, for the axis
Drawing tornado(std::string title, std::vector<Bar> bars, const std::string& axis, const std::string& note);

/// An ablation as tables.

struct Ablations {
    const AblationPlan& plan;
    const std::vector<RecordPair>& records;
    const AblationRuns& runs;
    std::string water; ///< what reservoir.model = "auto" became, and why; empty: the scene says it
};

/// Every effect that is on: what takes its place, or why it stays.
Table removal_table(const Ablations& in);
/// Slip and crest motion of every scene under one motion, and their changes; with the sum of the changes.
Table change_table(const Ablations& in, std::size_t motion);
/// The same of all motions, with columns that name them.
Table change_table_of_all(const Ablations& in);
/// Yield acceleration and critical friction of every scene, rigid block.
Table yield_change_table(const Ablations& in);
/// Seconds of every scene and those saved; unknowns of FE models. Differs from call to call.
Table seconds_table(const Ablations& in);

/// What has to be known to read the tables, a sentence each; the same at each call.
std::vector<std::string> ablation_notes(const Ablations& in);

/// Runs without an answer, by their status; one more where the step that all runs share misses time.slip_tolerance.
StatusCount unanswered_runs(const AblationRuns& runs);

/// The page of an ablation: bars of the slip changes by motion, of the seconds saved, and the tables. Seconds differ
/// from call to call, all else is the same.
/// @param given  the scene as read
Page ablation_page(const Ablations& in, const Scene& given, const EffectPlan& effects);

Answer ablation_answer(const Ablations& in, const Scene& given, const EffectPlan& effects);

} // namespace damslip::pages
