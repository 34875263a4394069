#pragma once

#include "scene/scene.hpp"

namespace damslip {

/// True where the rock below the dam has inertia.
bool rock_has_mass(const Scene& scene);

/// True where the edges of the rock box are dashpots and the ground moves as its free surface would without the dam.
bool rock_edges_are_viscous(const Scene& scene);

/// The scene with rock that only gives way: what statics, natural modes and Rayleigh's constants are taken from.
Scene with_massless_rock(Scene scene);

} // namespace damslip
