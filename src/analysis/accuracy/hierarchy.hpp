#pragma once

#include "analysis/fe/variants.hpp"

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// A model level of the accuracy hierarchy: one way to compute the slip of a scene.
namespace damslip {

enum class ModelLevelFamily { regression, rigid, finite_elements };
enum class Components { horizontal, both };
enum class RigidScheme { rocking, exact, slammer };              ///< the first: free to rock, too
enum class ModelLevelWater { dry, hydrostatic, added_mass, acoustic }; ///< how the water takes part in the shaking
enum class StepChoice {
    fixed,        ///< dt / 2^halvings
    by_tolerance, ///< chosen so that the slip is within time.slip_tolerance: the default of `fe`
    adaptive,     ///< the same, sub-steps spread by their local error
    as_the_scene  ///< step, contact law and all else as the scene says, where it differs from the hierarchy's settings
};

struct ModelLevel {
    ModelLevelFamily family = ModelLevelFamily::rigid;
    std::string regression; ///< id, or "ensemble": all valid ones, weighted

    // Rigid block.
    Components components = Components::both;
    RigidScheme scheme = RigidScheme::exact;

    // Finite elements; exact contact unless something else is said.
    ModelLevelWater water = ModelLevelWater::dry;
    StepChoice step = StepChoice::fixed;
    int halvings = 0;
    double mesh = 1.0;                          ///< element sizes over the scene's [-]: 2, 0.5
    std::string element;                        ///< mesh.element in place of the scene's: "q8"; empty: the scene's
    std::optional<int> modes;                   ///< reduced run: elastic modes kept
    std::optional<double> tangential_stiffness; ///< penalty [N/m^3]
    std::optional<double> alpha;                ///< of HHT, in place of the scene's scheme [-]
    std::string other_model; ///< OtherModel::level_word; empty: the scene's
    double wave_box = 1.0;   ///< of radiating rock: size of its box over the scene's [-]

    /// Neither other elements, modes, penalty nor scheme: a point of the model's own row of steps and column of meshes.
    bool plain() const
    {
        return element.empty() && !modes && !tangential_stiffness && !alpha && other_model.empty() && wave_box == 1.0 &&
               step == StepChoice::fixed;
    }
    bool operator==(const ModelLevel&) const = default;
};

/// Finite elements with steps of dt/2^halvings. @param mesh  element sizes over the scene's [-]
ModelLevel fe_model_level(ModelLevelWater water, int halvings, double mesh = 1.0);

/// One word without blanks: "regression:jibson-1998", "rigid:h+v", "rigid:h+v,rocking", "fe-acoustic:dt/4,h/2", "fe-acoustic:dt/4,2h,q8",
/// "fe-added-mass:dt/4,modes=12".
std::string model_level_id(const ModelLevel& model_level);
/// The inverse; nothing for a word that is no id.
std::optional<ModelLevel> parse_model_level(std::string_view id);

/// What the model level computes a limit of: model levels of one model tend to one slip as steps, elements and penalties are refined.
/// "rigid:h+v", "fe-acoustic", "fe-acoustic,rock=massless" where that is not the scene's, each regression its own.
std::string model_of(const ModelLevel& model_level);

std::string_view water_word(ModelLevelWater water); ///< "added mass"

/// What a model level gave, without motions where it is not done, and what it cost.
struct ModelLevelResult : VariantRuns {
    ModelLevel model_level;
    Status status = Status::not_resolved; ///< the first that is not at rest; interrupted: nothing of it counts
    bool skipped = false;                 ///< would have exceeded the budget
    std::string remark;                   ///< what the status means here, or why there is none

    // Over all motions, processor time: what a user pays who runs this model level alone: the scene read, models made, records
    // run. The set-up is what comes before the first motion is run.
    double seconds = 0.0; ///< median of the repeats [s]; skipped: expected
    int repeats = 0;
    std::optional<double> bytes; ///< growth of the resident memory to its peak; none: not measured
    bool done() const { return status == Status::at_rest; } ///< there is a slip
    double slip(std::size_t motion) const { return *motions[motion].slip; } ///< done only [m]
    double largest_slip() const; ///< with its sign; done only [m]
    bool ran() const { return !skipped && status != Status::refused && status != Status::interrupted; }
};

/// Which model levels a scene's hierarchy has. Nothing is computed here: the next model level follows from the scene's facts and from what
/// the model levels so far have given.
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
