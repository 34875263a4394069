#pragma once

#include "analysis/fe/variants.hpp"

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

} // namespace damslip
