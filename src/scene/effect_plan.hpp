#pragma once

#include "scene/scene.hpp"

#include <string>
#include <vector>

namespace damslip {

/// What a computation can take into account beyond weight and friction: the place of its row in effect_rows()
/// (effect_row.hpp). Named here are those the program asks for by name.
enum class Effect {
    hydrostatic_thrust,
    tailwater,
    silt,
    ice,
    user_forces,
    uplift,
    seepage,
    base_crack,
    drains,
    hydrodynamic_mass,
    acoustic_water,
    water_compressibility,
    bottom_absorption,
    moving_bottom,
    wave_radiation,
    surface_waves,
    floor_pressure,
    cohesion,
    strength_loss,
    inclined_base,
    vertical_motion,
    lift_off,
    upstream_sliding,
    run_out,
    rock_flexibility,
    curtain_stiffness,
    curtain_sealing,
    rock_inertia,
    rock_radiation,
    structural_damping,
    separation,
    finite_sliding,
    yielding_contact,
    lift_joints,
    lift_joint_water
};

enum class Method { rigid_block, finite_elements };

struct PlannedEffect {
    Effect effect;
    std::string name; ///< as printed: "uplift"
    bool on = false;
    std::string reason; ///< the key, or its absence, that decides
    std::string cost;   ///< what it adds when on; empty when off
};

/// The one object that says which effects a run takes into account. It is made from the scene before anything is
/// computed; `called_for` hands the rest of the program a scene that no longer holds the others, so they cannot be
/// assembled or stored.
struct EffectPlan {
    Method method = Method::rigid_block;
    std::vector<PlannedEffect> effects; ///< all effects, in the order of effect_rows()
    std::string scene_hash = {};        ///< of the scene that a command was given, before anything was chosen for it (prepare)

    bool on(Effect effect) const;
};

EffectPlan make_effect_plan(const Scene& scene, Method method);

/// The scene without what the plan leaves off.
Scene called_for(const EffectPlan& plan, Scene scene);

} // namespace damslip
