#include "scene/rock_mass.hpp"

#include "scene/water.hpp"

#include <cmath>

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

bool floor_on_rock(const Scene& scene)
{
    return is_acoustic(scene) && scene.reservoir->floor == ReservoirFloor::rock && rock_radiates(scene);
}

double rock_reflection(const Scene& scene)
{
    const Material& rock = scene.foundation->material;
    const double nu = rock.poisson_ratio, density = radiating_density(*scene.foundation),
                 modulus =
                     rock.young_modulus.value() * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu)); // of compression waves
    const double of_rock = std::sqrt(modulus * density),
                 of_water = std::sqrt(scene.reservoir->density * scene.reservoir->bulk_modulus);
    return (of_rock - of_water) / (of_rock + of_water);
}

bool rock_edges_are_viscous(const Scene& scene)
{
    return rock_is_boxed(scene) && scene.foundation->boundary == RockBoundary::viscous;
}

void let_floor_absorb(Scene& scene)
{
    if (!scene.reservoir || scene.reservoir->floor != ReservoirFloor::rock) return;
    scene.reservoir->floor = ReservoirFloor::absorbing;
    if (scene.foundation && scene.foundation->material.young_modulus)
        scene.reservoir->bottom_reflection = rock_reflection(scene);
}

Scene with_massless_rock(Scene scene)
{
    if (!scene.foundation) return scene;
    let_floor_absorb(scene);
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
