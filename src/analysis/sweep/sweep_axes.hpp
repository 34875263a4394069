#pragma once

#include "core/input_error.hpp"
#include "scene/keys.hpp"

#include <optional>
#include <string>
#include <vector>

namespace damslip {

/// How a row of a sweep is computed.
enum class SweepKind { rigid, rigid_vertical, rocking, decoupled, coupled, regression, finite_elements };

/// Of the flexible block.
inline bool is_flexible(SweepKind kind)
{
    return kind == SweepKind::decoupled || kind == SweepKind::coupled;
}

/// Contact law, steps or rock of FE rows, in place of the scene's.
enum class FeLaw {
    scene,
    exact,
    penalty,
    slip_tolerance,
    goldgruber_2015,
    whole_steps, ///< the scene's law, but steps of time.dt without sub-steps
    radiating,   ///< the scene's law, rock that radiates ...
    massless     ///< ... or keeps all waves; as the scene where there is no rock
};

struct SweepMethod {
    std::string id; ///< as typed and printed: "rigid-v", "rocking", "coupled", "fe-exact", "jibson-1998"
    SweepKind kind = SweepKind::rigid;
    FeLaw law = FeLaw::scene;
    bool reduced = false; ///< FE on few modes of the dam
};

/// rigid, rigid-v, rocking, decoupled, coupled, the FE methods, and the regressions by their ids.
const std::vector<SweepMethod>& sweep_method_list();

/// Ids of the list, for messages and completion.
std::vector<std::string> sweep_methods();

/// The method of an id of the list.
const SweepMethod& sweep_method(const std::string& id);

/// As the table of keys and methods knows them.
Methods methods_of(const std::vector<SweepMethod>& list);

/// The scene with the contact law of an FE method. The law says how sticking gives way; exact, penalty and slip tolerance
/// have a hard joint. goldgruber_2015 puts the whole preset in place of what the scene says.
/// @param penalty_stiffness  of the law `penalty`; default: the scene's [N/m^3]
Scene with_law(Scene scene, FeLaw law, std::optional<double> penalty_stiffness);

/// Values of every axis of the grid but the records.
struct Axes {
    std::vector<double> friction;               ///< Coulomb mu [-]
    std::vector<double> level;                  ///< water surface above the heel at size 1 [m]
    std::vector<double> size;                   ///< of section, rock, water and elements (sized), factor [-]
    std::vector<double> scale;                  ///< of the motion, factor [-]
    std::vector<int> polarity;                  ///< signs on the horizontal component as filed: 1, -1
    std::vector<std::string> uplift, reservoir; ///< words as typed
    std::vector<std::string> opening{""};       ///< words of uplift.opening as typed; empty: the scene's
    std::vector<std::string> plane{""};         ///< what the rigid block slides on; empty: the base
    std::vector<double> plane_friction;         ///< of each plane, where `friction` does not vary it; empty: it does [-]
    std::vector<double> period, damping;        ///< T_s [s] and zeta [-] of the flexible block; empty: the scene's
    std::vector<SweepMethod> method;
    std::vector<Diagnostic> notes; ///< of values that are allowed but unusual

    bool finite_elements() const; ///< is there an FE method?
    bool flexible() const;        ///< is there a method of the flexible block?
};

/// The axes that leave the scene as it is: one value each, the polarities_of() the scene, the rigid block.
Axes axes_of(const Scene& scene);

/// Words of the water models an axis may have: "auto", "hydrostatic", "acoustic", and the added masses by their formula.
std::vector<std::string> reservoir_axis_words();

/// Is uplift.opening one of the axes?
inline bool has_opening_axis(const Axes& axes)
{
    return axes.opening.size() != 1 || !axes.opening.front().empty();
}

/// Are there planes to slide on other than the base?
inline bool has_plane_axis(const Axes& axes)
{
    return axes.plane.size() != 1 || !axes.plane.front().empty();
}

/// Peak friction of a plane of the scene by its name; "base" is the base [-]. @pre one of plane_names()
double plane_friction(const Scene& scene, const std::string& plane);

/// The scene with another water level [m], uplift model and water model, words as typed, then another size.
Scene variant(Scene scene, double level, const std::string& uplift, const std::string& reservoir, double size);
/// The same with other water in the opening base. @param opening  empty: the scene's
Scene with_opening_water(Scene scene, const std::string& opening);
/// The same with another mode of the flexible block. @param period, damping  none: the scene's
Scene with_mode(Scene scene, std::optional<double> period, std::optional<double> damping);

/// The axes in words, all digits, in a fixed order: what has to be equal for two sweeps to have the same rows.
std::string text_of(const Axes& axes);

} // namespace damslip
