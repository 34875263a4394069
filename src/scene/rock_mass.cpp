#include "scene/rock_mass.hpp"

namespace damslip {

RockKind rock_kind(const Scene& scene)
{
    if (!scene.foundation) return RockKind::rigid;
    if (scene.foundation->mass == RockMass::massless) return RockKind::massless;
    return scene.foundation->boundary == RockBoundary::absorbing ? RockKind::radiating : RockKind::boxed;
}

std::string rock_words(const Scene& scene)
{
    switch (rock_kind(scene)) {
    case RockKind::rigid:
        return "rigid base";
    case RockKind::massless:
        return "massless rock, which keeps all waves";
    case RockKind::boxed:
        return rock_edges_are_viscous(scene) ? "rock with mass in a box with dashpots on its edges"
                                             : "rock with mass in a box with fixed edges, where waves come back";
    case RockKind::radiating:
        break;
    }
    return "radiating rock";
}

bool rock_has_mass(const Scene& scene)
{
    return rock_is_boxed(scene) || rock_radiates(scene);
}

double radiating_density(const Foundation& rock)
{
    constexpr double granite_or_gneiss = 2650.0;
    return rock.material.density > 0.0 ? rock.material.density : granite_or_gneiss;
}

bool rock_edges_are_viscous(const Scene& scene)
{
    return rock_is_boxed(scene) && scene.foundation->boundary == RockBoundary::viscous;
}

Scene with_massless_rock(Scene scene)
{
    if (!scene.foundation) return scene;
    scene.foundation->mass = RockMass::massless;
    scene.foundation->boundary = RockBoundary::fixed;
    return scene;
}

Scene with_radiating_rock(Scene scene)
{
    if (!scene.foundation) return scene;
    scene.foundation->mass = RockMass::with_mass;
    scene.foundation->boundary = RockBoundary::absorbing;
    return scene;
}

} // namespace damslip
