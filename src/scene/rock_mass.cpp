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

namespace {

/// Horizontal distance from the toe back to the crest [m].
double crest_distance(const RockSlope& s)
{
    return s.height / std::tan(s.face_dip);
}

/// Height of the ground above the toe at the crack [m].
double ground_at_crack(const RockSlope& s)
{
    return s.crack_distance >= 0.0 ? s.height + s.crack_distance * std::tan(s.upper_dip)
                                   : (crest_distance(s) + s.crack_distance) * std::tan(s.face_dip);
}

double heel_height(const RockSlope& s)
{
    return (crest_distance(s) + s.crack_distance) * std::tan(s.plane_dip);
}

} // namespace

double crack_depth(const RockSlope& slope)
{
    return ground_at_crack(slope) - heel_height(slope);
}

Polyline sliding_block(const RockSlope& slope)
{
    const double fall = heel_height(slope);
    Polyline p{{0.0, 0.0}, {crest_distance(slope) + slope.crack_distance, -fall}};
    if (slope.crack_distance > 0.0) p.push_back({slope.crack_distance, slope.height - fall});
    p.push_back({0.0, crack_depth(slope)});
    return p;
}

} // namespace damslip
