#pragma once

#include "analysis/fe/variants.hpp"

#include <optional>
#include <string>
#include <vector>

/// The scenes of an ablation: the dam with all effects of its plan, and without each of them in turn.
namespace damslip {

/// The scene without one effect.
struct Ablation {
    Effect effect;
    std::string name;    ///< of the effect, as in the effect plan
    std::string instead; ///< what takes its place
    std::optional<Effect>
        part_of; ///< the effect that takes this one with it, where that is removed in a row of its own
    Scene scene;
};

/// An effect that is on and has no run of its own.
struct KeptEffect {
    std::string name, why;
};

struct AblationPlan {
    Method method = Method::rigid_block;
    Scene full;                     ///< with all effects
    std::vector<Ablation> removals; ///< one for each effect that is on and can be removed, in the order of Effect
    std::vector<KeptEffect> kept;   ///< the others that are on
    std::optional<Scene> simplest;  ///< with all removals at once; none: fewer than two
};

/// One removal for each effect of the scene's plan that is on; effects that are off do not appear.
/// @param scene  reservoir.model is not "auto" for the FE method: the removals must not choose another water each
/// @param seepage_points  see EffectRow::remove
AblationPlan make_ablations(const Scene& scene, Method method, const std::vector<Point>& seepage_points);

/// The runs of an ablation, as data.

/// The one time step of all FE runs of an ablation, so that changes are not those of the step.
struct AblationStep {
    int halvings = 0;        ///< steps dt / 2^k of every run
    int other = 0;           ///< k of the runs that tell the error of the step: one less, or 1 beside 0
    bool chosen = false;     ///< by time.slip_tolerance on the full scene; else the scene's time.substeps
    double largest_dt = 0.0; ///< of the steps, over the motions [s]
    bool missed = false;     ///< chosen, but time.slip_tolerance is not met by it for some motion
};

/// Error of a difference that is linear in slips, from the same difference at the other step, by first order, the worst
/// that contact with moving edges shows [m]. @param at_step, at_other  the difference at both steps [m]
double difference_error(const AblationStep& step, double at_step, double at_other);

struct AblationRuns {
    std::vector<MotionName> motions;     ///< that every scene is run with
    std::vector<VariantRuns> scenes;     ///< the full one, each removal, the simplest if there is one
    std::vector<VariantRuns> other_step; ///< the same of FE runs with AblationStep::other
    std::optional<AblationStep> step;    ///< of FE runs
    int jobs = 1;
};

/// Runs all scenes on all records. Figures other than seconds do not depend on the number of threads.
/// @param jobs  threads, one scene each; 0: all cores
AblationRuns run_ablations(const AblationPlan& plan, const Records& records, int jobs, Watch& watch);

/// Base profile of uplift.model = "seepage" as uplift.points_m, p over that of the heel; empty: another model, or no
/// head at the heel. @throws InputError, NotConverged as the seepage
std::vector<Point> seepage_points(const Scene& scene);

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
    Change slip = {};   ///< final [m]
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
