#include "fe2d/fluid/water_boundary.hpp"

#include "scene/rock_mass.hpp"

#include <cassert>
#include <cmath>

namespace damslip::fe2d {

double FluidOptions::sound_speed() const
{
    return std::sqrt(bulk_modulus / density);
}

FluidOptions fluid_options(const Scene& scene)
{
    assert(scene.reservoir);
    const Reservoir& water = *scene.reservoir;
    FluidOptions options;
    options.density = water.density;
    options.bulk_modulus = water.bulk_modulus;
    options.gravity = scene.gravity;
    options.surface = water.surface;
    options.far_end = water.far_end;
    options.bottom_motion = water.bottom_motion;
    options.bottom_reflection =
        water.bottom_density && water.bottom_modulus
            ? reflection_of_bottom(water.density, options.sound_speed(), *water.bottom_density, *water.bottom_modulus)
            : water.bottom_reflection;
    if (water.floor == ReservoirFloor::rock && scene.foundation) options.bottom_reflection = rock_reflection(scene);
    options.floor_on_rock = floor_on_rock(scene);
    return options;
}

double wave_admittance(double density, double sound_speed, double reflection)
{
    return (1.0 - reflection) / ((1.0 + reflection) * density * sound_speed);
}

double reflection_of_bottom(double density, double sound_speed, double bottom_density, double bottom_modulus)
{
    const double impedance = std::sqrt(bottom_modulus * bottom_density), water = density * sound_speed;
    return (impedance - water) / (impedance + water);
}

} // namespace damslip::fe2d
