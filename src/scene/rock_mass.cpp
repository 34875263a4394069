#include "scene/rock_mass.hpp"

namespace damslip {

bool rock_has_mass(const Scene& scene)
{
    return scene.foundation && scene.foundation->mass == RockMass::with_mass;
}

bool rock_edges_are_viscous(const Scene& scene)
{
    return rock_has_mass(scene) && scene.foundation->boundary == RockBoundary::viscous;
}

Scene with_massless_rock(Scene scene)
{
    if (!scene.foundation) return scene;
    scene.foundation->mass = RockMass::massless;
    scene.foundation->boundary = RockBoundary::fixed;
    return scene;
}

} // namespace damslip
