#pragma once

#include "scene/scene.hpp"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
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
    std::vector<PlannedEffect> effects; ///< all that concern the scene, in the order of effect_rows()
    std::string scene_hash = {}; ///< of the scene that a command was given, before anything was chosen for it (prepare)

    bool on(Effect effect) const;
};

EffectPlan make_effect_plan(const Scene& scene, Method method);

/// The scene without what the plan leaves off.
Scene called_for(const EffectPlan& plan, Scene scene);

/// The table of effects: one row each, which says all that the program knows of it.

/// Why an effect is on or off, and what it costs when on.
struct Decision {
    bool on;
    std::string reason;
    std::string cost;
};

/// On for one reason at a cost, or off for another.
inline Decision decided(bool on, std::string yes, std::string no, std::string cost)
{
    return on ? Decision{true, std::move(yes), std::move(cost)} : Decision{false, std::move(no), ""};
}

/// A scene without an effect, and what it has in its place: "uplift.model = "curtain", the printed profile".
struct Removal {
    Scene scene;
    std::string instead;
};

/// The effect cannot be taken out of a scene and leave the same dam.
struct Stays {
    std::string why;
};

using RemovalAnswer = std::variant<Removal, Stays>;
using SeepagePoints = std::vector<Point>; ///< as uplift.points_m; empty: there is none

struct EffectRow {
    std::string name; ///< as printed: "uplift"
    /// Does a run of this method take the effect into account?
    Decision (*decide)(const Scene&, Method);
    /// Takes the effect out of a scene that has it, every other key as it was; a file could hold the scene that is left.
    void (*take_out)(Scene&) = nullptr;
    const char* instead = ""; ///< what that scene has in its place: "no [silt]"
    /// In place of these two where the answer depends on the scene. Points: the profile of uplift.model = "seepage", for a base
    /// without rock.
    RemovalAnswer (*answer)(Scene, const SeepagePoints&) = nullptr;
    bool taken_out_when_off = false; ///< take_out is what called_for() asks for, too
    /// Takes what belongs to an effect that is off out of the scene, for called_for(); null: nothing more to take out.
    void (*leave_out)(Scene&, const EffectPlan&) = nullptr;
    std::vector<Effect> part_of =
        {}; ///< it goes with the first of them that is on, else with the last; empty: with none
    /// The enumerator, for effects the program asks for by name.
    std::optional<Effect> named = {};
    /// Has the scene what the effect belongs to? Plans of other scenes do not list it. null: every plan does.
    bool (*concerns)(const Scene&) = nullptr;

    RemovalAnswer remove(Scene scene, const SeepagePoints& points) const; ///< asked only where the effect is on
    std::optional<Effect> whole(const EffectPlan& plan) const;            ///< the effect it goes with; none: with none
};

/// All rows; the place of a row is the value of its Effect.
std::span<const EffectRow> effect_rows();
const EffectRow& effect_row(Effect effect);

/// Another model of the same dam. The model spread of `fe` and `assess` runs those that a scene does not have already, and
/// `accuracy` those with a word on a model level of its own; where it is the scene without an effect, the row of that effect
/// has `explain --ablate` run it, too.
struct OtherModel {
    const char* name;               ///< as printed: "massless rock"
    std::string_view level_word;    ///< in the name of a model level: "rock=massless"; empty: no word of its own
    std::optional<Effect> without;  ///< the effect that it leaves out; none: it adds one
    bool (*concerns)(const Scene&); ///< is it another than the scene's?
    Scene (*change)(Scene);
};
std::span<const OtherModel> other_models();
const OtherModel* find_other_model(std::string_view level_word); ///< null: none has that word

// Rows that a wedge shares with a dam.
Decision decide_vertical_motion(const Scene& scene, const char* cost);
Decision decide_run_out(const Scene& scene, Method method);

/// EffectRow::decide for a scene of a rock wedge. @pre scene.wedge
Decision decide_of_wedge(Effect effect, const Scene& scene);

} // namespace damslip
