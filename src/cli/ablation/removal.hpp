#pragma once

#include "scene/effect_plan.hpp"

#include <string>
#include <variant>
#include <vector>

namespace damslip::cli {

/// A scene without an effect, and what it has in its place: "uplift.model = "curtain", the printed profile".
struct Removal {
    Scene scene;
    std::string instead;
};

/// The effect cannot be taken out of a scene and leave the same dam.
struct Stays {
    std::string why;
};

/// Bulk modulus of water that counts as incompressible over the given one: waves a hundred times as fast, so pressures of
/// frequencies up to the reservoir's first differ from incompressible water's by less than (1/100)^2 [-].
inline constexpr double stiff_water_factor = 1e4;

/// The scene without the effect, every other key as it was; a scene that a file could hold.
/// @param seepage_points  the profile of uplift.model = "seepage" as uplift.points_m, for a base without rock; empty:
/// there is none
std::variant<Removal, Stays> remove_effect(const Scene& scene, Effect effect, const std::vector<Point>& seepage_points);

} // namespace damslip::cli
