#include "pages/fe/water_notes.hpp"

#include "scene/mesh_sizes.hpp"
#include "scene/rock_mass.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace damslip::pages {

std::vector<std::string> reservoir_warnings(const Scene& scene, double highest)
{
    const Reservoir& water = *scene.reservoir;
    const double c = std::sqrt(water.bulk_modulus / water.density), first = c / (4.0 * water.level),
                 ratio = water.length / water.level;
    std::vector<std::string> warnings;
    if (water.far_end == FarEnd::damper && highest > first)
        warnings.push_back(
            fmt::format("reservoir.far_end = \"damper\" is exact for waves along the axis only: above the reservoir's "
                        "first frequency, {:.3g} Hz, its "
                        "force may err by a factor of 2 with a rigid bottom; \"absorbing\" is right there",
                        first));
    if (water.far_end == FarEnd::damper && ratio < 2.0)
        warnings.push_back(fmt::format(
            "the reservoir is {:.3g} depths long; a damper wants 2 at least (Goldgruber 2015, 3.5.3.2)", ratio));
    if ((water.far_end == FarEnd::closed || water.far_end == FarEnd::open) && ratio < 4.0)
        warnings.push_back(
            fmt::format("the reservoir is {:.3g} depths long; a reflecting end wants 4 at least", ratio));
    if ((water.far_end == FarEnd::closed || water.far_end == FarEnd::open) && highest > first)
        warnings.push_back(fmt::format(
            "waves above the reservoir's first frequency, {:.3g} Hz, come back from a reflecting far end after "
            "{:.3g} s",
            first, 2.0 * water.length / c));
    if (water.far_end == FarEnd::absorbing && ratio < 0.5)
        warnings.push_back(
            fmt::format("the reservoir is {:.3g} depths long; the absorbing end wants half a depth at least", ratio));
    if (floor_on_rock(scene) && ratio < 2.0)
        warnings.push_back(fmt::format(
            "the reservoir is {:.3g} depths long; a floor that is the rock's wants 2 at least: the rock beyond "
            "does not feel the water, the slip may change by some 5 %",
            ratio));
    if (water.bottom_motion == BottomMotion::ground && !floor_on_rock(scene) && scene.motion.vertical &&
        water.bottom_reflection == 1.0 && !water.bottom_density && highest > first)
        warnings.push_back(
            fmt::format("a rigid bottom that moves (bottom_reflection = 1) has no damping of the water's vertical "
                        "resonance at {:.3g} Hz: vertical motion may raise the slip several times; give the bottom its "
                        "bottom_reflection",
                        first));
    const double size = water_mesh_size(water), resolved = c / (10.0 * std::max(size, water.level / 12.0));
    if (highest > resolved)
        warnings.push_back(
            fmt::format("the water's mesh resolves waves up to {:.3g} Hz (ten elements a wave)", resolved));
    return warnings;
}

std::string water_counts(const fe2d::FluidModel& water)
{
    std::string text = fmt::format("acoustic water: {} elements, {} pressures", water.reservoir.mesh.element_count(),
                                   water.mesh_unknowns);
    if (water.layer_pressures > 0)
        text += fmt::format(", absorbing end of {} layers with {} pressures and {} momenta",
                            water.options.layers.cosines.size() + water.options.layers.decays.size(),
                            water.layer_pressures, water.layer_momenta);
    return text + fmt::format("; {} non-zeros in its matrices",
                              water.mass.nonZeros() + water.damping.nonZeros() + water.stiffness.nonZeros());
}

} // namespace damslip::pages
