#pragma once

#include "scene/effect_plan.hpp"
#include "scene/scene.hpp"

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

} // namespace damslip
