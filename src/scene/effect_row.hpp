#pragma once

#include "scene/effect_plan.hpp"

#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

/// The table of effects: one row each, which says all that the program knows of it.
namespace damslip {

/// Why an effect is on or off, and what it costs when on.
struct Decision {
    bool on;
    std::string reason;
    std::string cost;
};

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
    /// The scene without the effect, every other key as it was; a scene that a file could hold. Asked only where the
    /// effect is on. Points: the profile of uplift.model = "seepage", for a base without rock.
    RemovalAnswer (*remove)(Scene, const SeepagePoints&);
    /// Takes what belongs to an effect that is off out of the scene, for called_for(); null: nothing to take out.
    void (*leave_out)(Scene&, const EffectPlan&) = nullptr;
    /// The effect this one is part of and goes with; null: none.
    Effect (*part_of)(const EffectPlan&) = nullptr;
    /// The enumerator, for effects the program asks for by name.
    std::optional<Effect> named = {};
};

/// All rows; the place of a row is the value of its Effect.
std::span<const EffectRow> effect_rows();
const EffectRow& effect_row(Effect effect);

/// EffectRow::decide for a scene of a rock wedge. @pre scene.wedge
Decision decide_of_wedge(Effect effect, const Scene& scene);

} // namespace damslip
