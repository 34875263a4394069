#pragma once

#include "analysis/ablation/ablation.hpp"

#include <optional>
#include <string>
#include <vector>

/// What the tables and charts of an ablation show, each figure computed once.
namespace damslip {

/// A figure of one scene beside that of the full scene. Empty: one of the two has none.
struct Change {
    std::optional<double> value, change;
    std::optional<double> percent; ///< of the full scene's; empty where that is zero
};
Change change_from(const std::optional<double>& full, const std::optional<double>& value);

/// One scene under one motion, or the sum of the changes.
struct AblationRow {
    MotionName motion;
    std::string name;   ///< of the effect that is removed; "(all effects)", "(all removed)", "(sum of changes)"
    std::string status; ///< of the list, or "sum"
    Change slip = {};                                         ///< final [m]
    std::optional<double> slip_error = {}, change_error = {}; ///< of the time step, FE runs [m]
    Change crest = {};                                        ///< [m], FE runs
    std::vector<Change> lifts = {};                           ///< final slip of each lift joint of the full scene [m]
    bool within_step_error = false;                           ///< the change is not larger than its error, and not zero
    bool still_sliding = false; ///< when the run-out ended: slip and change are lower bounds
    std::string remark = {};
};

inline const char* const full_name = "(all effects)";
inline const char* const simplest_name = "(all removed)";

/// Names of AblationRuns::scenes.
std::vector<std::string> scene_names(const AblationPlan& plan);

/// One row for each scene. @param motion  place in AblationRuns::motions
std::vector<AblationRow> rows_of(const AblationPlan& plan, const AblationRuns& runs, std::size_t motion);

/// Sum of the slip changes of removals that are no part of another; empty where one of them has none, or a
/// lower bound only [m].
std::optional<double> sum_of_changes(const AblationPlan& plan, const std::vector<AblationRow>& rows);

/// Seconds that a scene takes less than the full one; empty where one of them has not run to the end of all motions [s].
std::optional<double> saved_seconds(const VariantRuns& full, const VariantRuns& own);

} // namespace damslip
