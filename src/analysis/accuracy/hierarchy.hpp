#pragma once

#include "analysis/accuracy/model_level.hpp"

#include <functional>
#include <vector>

/// Which model levels a scene's hierarchy has. Nothing is computed here: the next model level follows from the scene's facts and from what
/// the model levels so far have given.
namespace damslip {

enum class Effort {
    quick, ///< fewer steps, no mesh finer than the scene's, no variants of law and scheme
    full
};

/// What of a scene and its records decides about model levels.
struct HierarchyFacts {
    std::vector<std::string> regressions; ///< ids of the best valid ones, and "ensemble"; none: none is valid
    bool vertical = false;                ///< some record has a vertical component that counts
    bool slammer = false;                 ///< the scene asks for SLAMMER's scheme
    bool rocks = false;                   ///< in some motion the block tips before it slides
    std::vector<ModelLevelWater> waters;        ///< FE models from poor to rich; none: no finite elements
    bool reducible = false;               ///< the first of them can run on few modes
    std::vector<double> alphas;           ///< of HHT, other than the scene's [-]
    bool own_settings = false;            ///< the scene fixes step or contact law otherwise than the hierarchy
    bool corrects_steps = false;          ///< steps that are chosen are corrected, not halved (set_corrector)
    bool radiates = false;                ///< the rock that the model levels stand on
    std::vector<std::string> other_models; ///< OtherModel::level_word of those that are run beside the scene's
    bool quadratic = false;               ///< the scene's elements are linear: quadratic ones are tried beside them
    double coarsest = 1.0;                ///< largest mesh factor that leaves enough elements on the base: 1, 2, 4
    std::vector<std::string> left_out;    ///< a sentence for each kind of model level that this scene has not
};

struct HierarchyOptions {
    Effort effort = Effort::full;
    double tolerance = 0.02; ///< of the deviation from the top model level [-]; steps are halved until a quarter of it is left
};

/// The model levels whose place in the hierarchy is settled by what has been run, in the order in which they run: for each
/// FE model a row of halved steps, refined until the slip is settled, then other meshes, contact laws, schemes and mode
/// counts beside it; fine meshes of all models last, those of the richest until the slip is settled, in the mesh and then
/// in the step; the top model level at the very end.
std::vector<ModelLevel> hierarchy(const HierarchyFacts& facts, const HierarchyOptions& options, const std::vector<ModelLevelResult>& so_far);

/// Is `a` the poorer method, or the coarser model level of the same model?
bool below(const ModelLevel& a, const ModelLevel& b);

/// The finest model level of the richest model among the results; nothing when none is done.
std::optional<std::size_t> top_model_level(const std::vector<ModelLevelResult>& results);

/// Row of one FE model on the scene's mesh: results with dt, dt/2 ... in this order, as far as they are done.
std::vector<const ModelLevelResult*> step_row(const std::vector<ModelLevelResult>& results, ModelLevelWater water);

/// Row of one FE model on the finest mesh that has two steps: the finest steps that follow each other there. The scene's
/// mesh where no other has two.
std::vector<const ModelLevelResult*> fine_row(const std::vector<ModelLevelResult>& results, ModelLevelWater water);

/// Column of one FE model: results on all meshes with the step that has most of them, from coarse to fine.
std::vector<const ModelLevelResult*> mesh_column(const std::vector<ModelLevelResult>& results, ModelLevelWater water);

/// Slips of one motion [m].
std::vector<double> slips_of(const std::vector<const ModelLevelResult*>& model_levels, std::size_t motion);

/// Seconds a model level will take, from the nearest of its model: steps times unknowns^1.25; nothing to go by: nothing.
/// @param corrects_steps  as HierarchyFacts
std::optional<double> expected_seconds(const ModelLevel& model_level, const std::vector<ModelLevelResult>& so_far, bool corrects_steps);

struct HierarchyRunOptions {
    HierarchyOptions hierarchy;
    int repeats = 3;              ///< of a model level at most, >= 1; see repeated_enough
    std::optional<double> budget; ///< processor time for all model levels and repeats together [s]; none: no end
};

/// What the run asks for and tells.
struct HierarchyCalls {
    std::function<ModelLevelResult(const ModelLevel&)> run;               ///< once
    std::function<double(const ModelLevel&)> least_seconds = {};    ///< of a model level whose neighbours say nothing; empty: 0 [s]
    std::function<bool()> interrupted;                        ///< empty: never
    std::function<void(const ModelLevel&)> begins;                  ///< empty: nobody listens
    std::function<void(const std::vector<ModelLevelResult>&)> ends; ///< after each model level, all results so far; may be empty
};

/// A model level is repeated while it has taken less than this in all, so one of a second is run three times and one of two
/// seconds once.
inline constexpr double repeat_seconds = 3.5;

/// Runs the hierarchy of a scene. Model levels that would exceed the budget by what they are expected to take, or that it ends, are `skipped` and
/// stay in the list; so do those that fail. An interrupt ends the run; what was finished is kept, the model level under way is
/// not.
std::vector<ModelLevelResult> run_hierarchy(const HierarchyFacts& facts, const HierarchyRunOptions& options, const HierarchyCalls& calls);

/// One model level, repeated: the seconds are the median.
ModelLevelResult run_repeatedly(const ModelLevel& model_level, int repeats, const HierarchyCalls& calls);

} // namespace damslip
