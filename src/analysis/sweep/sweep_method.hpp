#pragma once

#include "scene/key_methods.hpp"

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

} // namespace damslip
