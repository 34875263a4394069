#pragma once

#include "core/status.hpp"

#include <cstdint>
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
    by_tolerance, ///< halved until the slip is within time.slip_tolerance: the default of `fe`
    adaptive,     ///< the same, sub-steps spread by their local error
    as_the_scene  ///< step, contact law and all else as the scene says, where it differs from the hierarchy's settings
};
enum class ModelLevelRock { as_the_scene, massless, radiating };

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
    ModelLevelRock rock = ModelLevelRock::as_the_scene;
    double wave_box = 1.0; ///< of radiating rock: size of its box over the scene's [-]

    /// Neither other elements, modes, penalty nor scheme: a point of the model's own row of steps and column of meshes.
    bool plain() const
    {
        return element.empty() && !modes && !tangential_stiffness && !alpha && rock == ModelLevelRock::as_the_scene &&
               wave_box == 1.0 && step == StepChoice::fixed;
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

enum class ModelLevelOutcome {
    done,    ///< there is a slip
    failed,  ///< it ran and has no final slip: see status and remark
    refused, ///< this scene cannot be run so, see the remark
    skipped, ///< would have exceeded the budget
    stopped  ///< Ctrl-C: nothing of it counts
};

/// What a model level gave and what it cost.
struct ModelLevelResult {
    ModelLevel model_level;
    ModelLevelOutcome outcome = ModelLevelOutcome::failed;
    Status status = Status::not_resolved; ///< of what ran, the first motion that does not come to rest
    std::string remark;                   ///< what the status means here, or why there is none
    std::vector<double> slip;      ///< at the end, of each of motion_names(), positive downstream [m]; `done` only
    std::vector<double> low, high; ///< 16 and 84 % of a regression [m]; empty: no band

    // Over all motions, processor time: what a user pays who runs this model level alone: the scene read, models made, records
    // run.
    double seconds = 0.0;        ///< median of the repeats [s]; `skipped`: expected
    double set_up_seconds = 0.0; ///< of them, before the first motion is run [s]
    int repeats = 0;
    std::optional<double> bytes;          ///< growth of the resident memory to its peak; none: not measured
    std::optional<double> time_step;      ///< the smallest used [s]
    std::optional<std::int64_t> unknowns; ///< of the FE model, the water's included; modes of a reduced run
    std::optional<std::int64_t> steps;    ///< of all motions, of the pass that counts
    bool done() const { return outcome == ModelLevelOutcome::done; }
    double largest_slip() const; ///< with its sign; `done` only [m]
    bool ran() const { return outcome == ModelLevelOutcome::done || outcome == ModelLevelOutcome::failed; }
};

} // namespace damslip
